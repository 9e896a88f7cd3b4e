#include "core/memory_budget.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <string>

#include "core/error.h"
#include "core/text.h"

namespace arris {
namespace {

/// Reads a limit file of the cgroup file system; "max" and absence mean no limit.
std::uint64_t read_limit_bytes(const std::string& path) {
  std::ifstream file(path);
  std::uint64_t value = 0;
  return file >> value ? value : std::numeric_limits<std::uint64_t>::max();
}

std::uint64_t cgroup_limit_bytes() {
  std::uint64_t limit = std::numeric_limits<std::uint64_t>::max();
  std::ifstream groups("/proc/self/cgroup");
  for (std::string line; std::getline(groups, line);) {
    const bool version2 = line.starts_with("0::");
    if (!version2 && line.find(":memory:") == std::string::npos) continue;
    const std::string root = version2 ? "/sys/fs/cgroup" : "/sys/fs/cgroup/memory";
    const char* file = version2 ? "/memory.max" : "/memory.limit_in_bytes";
    std::string group = line.substr(line.rfind(':') + 1);
    // The limit of every ancestor holds as well.
    for (;;) {
      limit = std::min(limit, read_limit_bytes(root + (group == "/" ? "" : group) + file));
      const std::size_t slash = group.rfind('/');
      if (slash == std::string::npos || group.size() <= 1) break;
      group = slash == 0 ? "/" : group.substr(0, slash);
    }
  }
  return limit;
}

}  // namespace

MachineMemory machine_memory() {
  const auto ram =
      static_cast<std::uint64_t>(sysconf(_SC_PHYS_PAGES)) * static_cast<std::uint64_t>(sysconf(_SC_PAGE_SIZE));
  const std::uint64_t cgroup = cgroup_limit_bytes();
  return {std::min(ram, cgroup), cgroup < ram};
}

MemoryBudget::Reservation MemoryBudget::reserve(std::uint64_t size_bytes) {
  if (size_bytes > capacity_bytes_) {
    throw BudgetError(fmt::format("a tile needs {} but only {} of the memory budget are left for tiles; raise --memory",
                                  human_bytes(size_bytes), human_bytes(capacity_bytes_)));
  }
  std::unique_lock lock(mutex_);
  freed_.wait(lock, [&] { return used_bytes_ + size_bytes <= capacity_bytes_; });
  used_bytes_ += size_bytes;
  return Reservation(*this, size_bytes);
}

void MemoryBudget::release(std::uint64_t size_bytes) {
  {
    const std::lock_guard lock(mutex_);
    used_bytes_ -= size_bytes;
  }
  freed_.notify_all();
}

}  // namespace arris
