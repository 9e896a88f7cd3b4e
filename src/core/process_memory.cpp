#include "core/process_memory.h"

#include <malloc.h>

#include <fstream>
#include <string>

#include "core/pages.h"

namespace arris {
namespace {

std::uint64_t status_bytes(const std::string& key) {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);) {
    if (line.starts_with(key)) return std::stoull(line.substr(key.size())) * 1024;
  }
  return 0;
}

}  // namespace

std::uint64_t peak_resident_bytes() {
  return status_bytes("VmHWM:");
}
std::uint64_t resident_bytes() {
  return status_bytes("VmRSS:");
}

void configure_allocator_for_budget() {
  // A fixed threshold switches off glibc's habit of raising it after the first large free, which would keep tile-sized
  // blocks on the heap where fragments hold them.
  mallopt(M_MMAP_THRESHOLD, 256 * 1024);
  mallopt(M_TRIM_THRESHOLD, 1024 * 1024);
  mallopt(M_ARENA_MAX, 4);
}

void release_free_memory() {
  drop_spare_pages();
  trim_heap();
}

void trim_heap() {
  // Where another allocator (a sanitizer's, a preloaded one) has taken the place of glibc's, the first call sets
  // glibc's heap up, which glibc does not guard against a second thread that trims at the same time. This does.
  static const int first = malloc_trim(0);
  static_cast<void>(first);
  malloc_trim(0);
}

}  // namespace arris
