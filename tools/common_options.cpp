#include "common_options.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>

#include "core/error.h"
#include "core/memory_budget.h"
#include "core/parallel.h"
#include "core/text.h"
#include "core/units.h"
#include "io/output_file.h"

namespace arris::tools {

ProgressMode DisplayOptions::mode() const {
  if (progress == "always") return ProgressMode::kAlways;
  if (progress == "never") return ProgressMode::kNever;
  if (progress == "json") return ProgressMode::kJson;
  return ProgressMode::kAuto;
}

void add_display_options(CLI::App& verb, DisplayOptions& options) {
  verb.add_option("--progress", options.progress,
                  "Progress on stderr: auto (bar on a terminal), always, never, json (one object a line)")
      ->check(CLI::IsMember({"auto", "always", "never", "json"}))
      ->capture_default_str();
  auto* quiet = verb.add_flag("-q,--quiet", options.quiet, "Errors only");
  verb.add_flag("-v,--verbose", options.verbose, "Say more")->excludes(quiet);
}

void add_tolerance_options(CLI::App& verb, ToleranceOptions& options) {
  auto* strict = verb.add_flag("--strict", options.strict,
                               "Refuse files with any problem, also those that are usually reported only");
  verb.add_flag("--salvage", options.salvage, "Read the whole points of files that are cut short or count no points")
      ->excludes(strict);
}

std::uint64_t resolve_memory(const std::string& text, std::string& why) {
  const MachineMemory machine = machine_memory();
  const char* of_what = machine.limited_by_cgroup ? "the control group's limit" : "this machine's memory";
  if (!text.empty()) {
    const std::uint64_t bytes = parse_size_bytes(text, machine.size_bytes);
    why = text.back() == '%' ? fmt::format("{} of {}", text, of_what) : "as given";
    return bytes;
  }
  why = fmt::format("75 % of {}", of_what);
  return machine.size_bytes / 4 * 3;
}

int resolve_threads(int threads) {
  if (threads < 0) throw ConfigError("--threads must not be negative");
  return threads == 0 ? hardware_threads() : threads;
}

void write_text(const std::string& path, const std::string& text, bool overwrite) {
  if (path == "-") {
    if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size() || std::fflush(stdout) != 0) {
      throw IoError("cannot write to standard output");
    }
    return;
  }
  io::OutputFile file(path, overwrite);
  file.write(std::string_view(text));
  file.commit();
}

}  // namespace arris::tools
