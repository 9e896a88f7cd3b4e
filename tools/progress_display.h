#pragma once
/// @file Progress on stderr: a bar for people, JSON lines for programs.

#include <chrono>
#include <cstdint>
#include <mutex>
#include <string>

#include "core/progress.h"

namespace arris::tools {

enum class ProgressMode { kAuto, kAlways, kNever, kJson };

/// Thread-safe. Redraws at most ten times a second. kAuto shows a bar only if stderr is a terminal; notes and warnings
/// are printed in every mode but quiet.
class ProgressDisplay : public ProgressSink {
 public:
  ProgressDisplay(ProgressMode mode, int verbosity);
  ~ProgressDisplay() override;
  void phase(std::string_view name, std::uint64_t total_points) override;
  void advance(std::uint64_t done_points) override;
  void warning(std::string_view code, std::string_view text) override;
  void note(std::string_view text) override;
  /// Wipes the bar; further notes start on a clean line.
  void finish();

 private:
  using Clock = std::chrono::steady_clock;
  void draw(bool last);
  void wipe();

  const bool json_;
  const bool bar_;
  const int verbosity_;  ///< < 0 quiet, 0 normal, > 0 verbose.
  std::mutex mutex_;
  std::string phase_;
  std::uint64_t total_ = 0;
  std::uint64_t done_ = 0;
  Clock::time_point began_;
  Clock::time_point drawn_;
  bool line_open_ = false;
};

}  // namespace arris::tools
