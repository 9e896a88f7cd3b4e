#include "core/pages.h"

#include <sys/mman.h>

#include <algorithm>
#include <cstdint>
#include <mutex>
#include <new>
#include <vector>

namespace arris {
namespace {

constexpr std::size_t kPage = std::size_t{4} << 10;
constexpr std::size_t kLargePage = std::size_t{2} << 20;

constexpr std::size_t whole_pages(std::size_t size_bytes) {
  return (size_bytes + kPage - 1) / kPage * kPage;
}

/// A stretch of address space that begins at a page.
struct Stretch {
  std::uintptr_t begin;
  std::size_t size_bytes;
};

void unmap(const Stretch& stretch) noexcept {
  ::munmap(reinterpret_cast<void*>(stretch.begin), stretch.size_bytes);
}

/// Fresh pages; large ones where they fill whole ones.
std::uintptr_t map(std::size_t size) {
  const bool large = size >= 2 * kLargePage;
  const std::size_t mapped = size + (large ? kLargePage : 0);  // Room to begin at a large page.
  void* const pages = ::mmap(nullptr, mapped, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (pages == MAP_FAILED) throw std::bad_alloc();
  const auto address = reinterpret_cast<std::uintptr_t>(pages);
  if (!large) return address;
  const std::uintptr_t begin = (address + kLargePage - 1) / kLargePage * kLargePage;
  if (begin > address) unmap({address, begin - address});
  if (address + mapped > begin + size) unmap({begin + size, address + mapped - begin - size});
#if defined(MADV_HUGEPAGE)
  // Fewer faults and fewer misses of the address cache; it does not matter if the system refuses. Parts of a large page
  // at the end stay small, so that no more than was asked for is ever resident.
  ::madvise(reinterpret_cast<void*>(begin), size / kLargePage * kLargePage, MADV_HUGEPAGE);
#endif
  return begin;
}

/// What was returned and not taken again. Thread-safe.
class SparePages {
 public:
  /// The smallest stretch that is long enough; what is left of it stays here. 0 if there is none.
  std::uintptr_t take(std::size_t size) {
    const std::lock_guard lock(mutex_);
    auto best = spare_.end();
    for (auto it = spare_.begin(); it != spare_.end(); ++it) {
      if (it->size_bytes >= size && (best == spare_.end() || it->size_bytes < best->size_bytes)) best = it;
    }
    if (best == spare_.end()) return 0;
    const std::uintptr_t begin = best->begin;
    const std::size_t used = size >= 2 * kLargePage ? (size + kLargePage - 1) / kLargePage * kLargePage : size;
    if (best->size_bytes > used) {
      // The rest begins at a large page if this did.
      if (used > size) unmap({begin + size, used - size});
      *best = {begin + used, best->size_bytes - used};
    } else {
      if (best->size_bytes > size) unmap({begin + size, best->size_bytes - size});
      spare_.erase(best);
    }
    return begin;
  }
  bool keep(const Stretch& stretch) noexcept {
    const std::lock_guard lock(mutex_);
    if (spare_.size() == kMost) return false;
    spare_.push_back(stretch);
    return true;
  }
  void drop() noexcept {
    const std::lock_guard lock(mutex_);
    for (const Stretch& stretch : spare_) unmap(stretch);
    spare_.clear();
  }

 private:
  static constexpr std::size_t kMost = 16;
  static std::vector<Stretch> room() {
    std::vector<Stretch> spare;
    spare.reserve(kMost);
    return spare;
  }
  std::mutex mutex_;
  std::vector<Stretch> spare_ = room();
};

SparePages& spare_pages() {
  static SparePages* const pages = new SparePages;  // Outlives whatever returns pages at exit.
  return *pages;
}

}  // namespace

void* take_pages(std::size_t size_bytes) {
  const std::size_t size = whole_pages(size_bytes);
  if (const std::uintptr_t spare = spare_pages().take(size)) return reinterpret_cast<void*>(spare);
  drop_spare_pages();  // What does not fit must not be resident beside what is made anew.
  return reinterpret_cast<void*>(map(size));
}

void return_pages(void* pages, std::size_t size_bytes) noexcept {
  const Stretch stretch{reinterpret_cast<std::uintptr_t>(pages), whole_pages(size_bytes)};
  if (!spare_pages().keep(stretch)) unmap(stretch);
}

void drop_spare_pages() noexcept {
  spare_pages().drop();
}

}  // namespace arris
