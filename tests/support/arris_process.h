#pragma once
/// @file Runs the real program.

#include <csignal>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace arris::test {

struct ProcessResult {
  int exit_code = -1;  ///< -signal if it was killed.
  std::string out;
  std::string err;
  std::uint64_t peak_resident_bytes = 0;  ///< As the operating system counts it.
};

/// Runs `arris ARGUMENTS` to its end. If `while_running` is given it is called with the process id right after the
/// start.
ProcessResult run_arris(const std::vector<std::string>& arguments,
                        const std::function<void(int pid)>& while_running = {});

}  // namespace arris::test
