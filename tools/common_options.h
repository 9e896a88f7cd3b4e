#pragma once
/// @file Options that several verbs share.

#include <cstdint>
#include <string>

#include "io/point_source.h"
#include "progress_display.h"

namespace CLI {
class App;
}

namespace arris::tools {

struct DisplayOptions {
  std::string progress = "auto";
  bool quiet = false;
  bool verbose = false;
  ProgressMode mode() const;
  int verbosity() const { return quiet ? -1 : verbose ? 1 : 0; }
};
void add_display_options(CLI::App& verb, DisplayOptions& options);

/// How files that do not keep to their format are read.
struct ToleranceOptions {
  bool strict = false;
  bool salvage = false;
  io::Tolerance tolerance() const {
    return strict ? io::Tolerance::kStrict : salvage ? io::Tolerance::kSalvage : io::Tolerance::kUsual;
  }
};
void add_tolerance_options(CLI::App& verb, ToleranceOptions& options);

/// The bytes meant by --memory, or 75 % of what the machine offers if the text is empty. `why` says which, for the log.
std::uint64_t resolve_memory(const std::string& text, std::string& why);

/// --threads: 0 means all.
int resolve_threads(int threads);

/// Writes text to a file that appears whole or not at all, or to stdout for "-".
void write_text(const std::string& path, const std::string& text, bool overwrite);

}  // namespace arris::tools
