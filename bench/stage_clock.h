#pragma once
/// @file What the stages of a peer cost.

#include <sys/resource.h>

#include <chrono>
#include <cstdio>

namespace arris::bench {

inline double cpu_seconds() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_utime.tv_sec + usage.ru_stime.tv_sec) +
         1e-6 * static_cast<double>(usage.ru_utime.tv_usec + usage.ru_stime.tv_usec);
}

inline double peak_mib() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

/// Prints what a stage took when it ends.
class StageClock {
 public:
  void end_stage(const char* name) {
    const double cpu = cpu_seconds();
    const auto now = std::chrono::steady_clock::now();
    const double wall = std::chrono::duration<double>(now - wall_).count();
    std::printf("%-10s CPU s %.2f, wall s %.2f, peak resident MiB %.0f\n", name, cpu - cpu_, wall, peak_mib());
    cpu_ = cpu;
    wall_ = now;
  }

 private:
  double cpu_ = cpu_seconds();
  std::chrono::steady_clock::time_point wall_ = std::chrono::steady_clock::now();
};

}  // namespace arris::bench
