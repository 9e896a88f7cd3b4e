#pragma once
#include "core/progress.h"

namespace arris::test {

class SilentSink : public ProgressSink {
 public:
  void phase(std::string_view, std::uint64_t) override {}
  void advance(std::uint64_t) override {}
  void note(std::string_view) override {}
  void warning(std::string_view, std::string_view) override {}
};

}  // namespace arris::test
