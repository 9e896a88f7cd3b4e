#include "core/pages.h"

#include <sys/mman.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <iterator>
#include <mutex>
#include <new>
#include <vector>

namespace arris {
namespace {

constexpr std::size_t kPage = std::size_t{4} << 10;
constexpr std::size_t kLargePage = std::size_t{2} << 20;

constexpr std::size_t whole(std::size_t size, std::size_t unit) {
  return (size + unit - 1) / unit * unit;
}

/// A stretch of address space that begins at a page.
struct Stretch {
  std::uintptr_t begin;
  std::size_t size_bytes;
  std::uintptr_t end() const { return begin + size_bytes; }
};

void unmap(const Stretch& stretch) noexcept {
  ::munmap(reinterpret_cast<void*>(stretch.begin), stretch.size_bytes);
}

std::uintptr_t map(std::size_t size) {
  void* const pages = ::mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (pages == MAP_FAILED) throw std::bad_alloc();
  return reinterpret_cast<std::uintptr_t>(pages);
}

/// Fresh pages for `size_bytes`, in whole large pages.
std::uintptr_t map_large(std::size_t size_bytes) {
  const std::size_t size = whole(size_bytes, kLargePage);
  const std::uintptr_t address = map(size + kLargePage);  // Room to begin at a large page.
  const std::uintptr_t begin = whole(address, kLargePage);
  if (begin > address) unmap({address, begin - address});
  if (address + kLargePage > begin) unmap({begin + size, address + kLargePage - begin});
#if defined(MADV_HUGEPAGE)
  // Fewer faults and fewer misses of the address cache; it does not matter if the system refuses. The last one stays
  // small pages unless it is full, so that no more than was asked for is resident.
  ::madvise(reinterpret_cast<void*>(begin), size_bytes / kLargePage * kLargePage, MADV_HUGEPAGE);
#endif
  return begin;
}

/// The part of a stretch up to the last large page of which something is resident: arrays fill from the front.
Stretch written_part(const Stretch& stretch) noexcept {
  std::array<unsigned char, kLargePage / kPage> resident;
  std::size_t size = stretch.size_bytes;
  for (; size > 0; size -= kLargePage) {
    void* const last = reinterpret_cast<void*>(stretch.begin + size - kLargePage);
    if (::mincore(last, kLargePage, resident.data()) != 0) break;
    if (std::ranges::any_of(resident, [](unsigned char page) { return (page & 1) != 0; })) break;
  }
  return {stretch.begin, size};
}

/// Stretches that were returned and not taken again, by address; those that touch are one.
class SpareStretches {
 public:
  /// Of the smallest stretch that is long enough, its beginning; 0 if there is none.
  std::uintptr_t take(std::size_t size) {
    auto best = spare_.end();
    for (auto it = spare_.begin(); it != spare_.end(); ++it) {
      if (it->size_bytes >= size && (best == spare_.end() || it->size_bytes < best->size_bytes)) best = it;
    }
    return best == spare_.end() ? 0 : cut(best, size).begin;
  }
  /// At most so much of the largest stretch; empty if there is none.
  Stretch take_some(std::size_t most) {
    const auto largest = std::ranges::max_element(spare_, {}, &Stretch::size_bytes);
    return largest == spare_.end() ? Stretch{0, 0} : cut(largest, std::min(most, largest->size_bytes));
  }
  void keep(Stretch stretch) noexcept {
    if (stretch.size_bytes == 0) return;
    auto after = std::ranges::lower_bound(spare_, stretch.begin, {}, &Stretch::begin);
    if (after != spare_.end() && stretch.end() == after->begin) {
      stretch.size_bytes += after->size_bytes;
      after = spare_.erase(after);
    }
    if (after != spare_.begin() && std::prev(after)->end() == stretch.begin) {
      std::prev(after)->size_bytes += stretch.size_bytes;
    } else if (spare_.size() < kMost) {
      spare_.insert(after, stretch);
    } else {
      unmap(stretch);
    }
  }
  void drop() noexcept {
    for (const Stretch& stretch : spare_) unmap(stretch);
    spare_.clear();
  }
  std::size_t size_bytes() const noexcept {
    std::size_t sum = 0;
    for (const Stretch& stretch : spare_) sum += stretch.size_bytes;
    return sum;
  }

 private:
  static constexpr std::size_t kMost = 64;
  static std::vector<Stretch> room() {
    std::vector<Stretch> spare;
    spare.reserve(kMost);
    return spare;
  }
  Stretch cut(std::vector<Stretch>::iterator from, std::size_t size) {
    const Stretch taken{from->begin, size};
    *from = {from->begin + size, from->size_bytes - size};
    if (from->size_bytes == 0) spare_.erase(from);
    return taken;
  }

  std::vector<Stretch> spare_ = room();
};

/// What was returned and not taken again. Thread-safe.
class SparePages {
 public:
  void* take(std::size_t size_bytes) {
    const std::lock_guard lock(mutex_);
    const bool large = is_large(size_bytes);
    const std::size_t size = whole(size_bytes, large ? kLargePage : kPage);
    std::uintptr_t begin = (large ? large_ : small_).take(size);
    if (begin == 0 && large) begin = gather(size_bytes);
    if (begin == 0) {
      small_.drop();
      begin = map(size);
    }
    return reinterpret_cast<void*>(begin);
  }
  void keep(void* pages, std::size_t size_bytes) noexcept {
    const std::lock_guard lock(mutex_);
    const auto begin = reinterpret_cast<std::uintptr_t>(pages);
    if (!is_large(size_bytes)) return small_.keep({begin, whole(size_bytes, kPage)});
    const Stretch all{begin, whole(size_bytes, kLargePage)};
    const Stretch written = written_part(all);
    if (written.size_bytes < all.size_bytes) unmap({written.end(), all.size_bytes - written.size_bytes});
    large_.keep(written);
  }
  void drop() noexcept {
    const std::lock_guard lock(mutex_);
    small_.drop();
    large_.drop();
  }
  std::size_t size_bytes() const noexcept {
    const std::lock_guard lock(mutex_);
    return small_.size_bytes() + large_.size_bytes();
  }

 private:
  static bool is_large(std::size_t size_bytes) { return size_bytes >= 2 * kLargePage; }

  /// Large pages from all spare stretches under one address, the rest fresh.
  std::uintptr_t gather(std::size_t size_bytes) {
    const std::uintptr_t begin = map_large(size_bytes);
#if defined(MREMAP_FIXED)
    const std::uintptr_t end = begin + std::min(whole(size_bytes, kLargePage), kMostGathered);
    for (std::uintptr_t to = begin; to < end;) {
      const Stretch some = large_.take_some(end - to);
      if (some.size_bytes == 0) break;
      for (std::uintptr_t from = some.begin; from < some.end(); from += kLargePage, to += kLargePage)
        move_large_page(from, to);
    }
    if (large_.size_bytes() > 0) return begin;
#endif
    // What does not fit must not be resident beside what is made anew.
    small_.drop();
    large_.drop();
    return begin;
  }

#if defined(MREMAP_FIXED)
  /// Page by page: what the system moves must come from one mapping.
  static void move_large_page(std::uintptr_t from, std::uintptr_t to) {
    void* const at = reinterpret_cast<void*>(to);
    if (::mremap(reinterpret_cast<void*>(from), kLargePage, kLargePage, MREMAP_MAYMOVE | MREMAP_FIXED, at) == at)
      return;
    unmap({from, kLargePage});
    // The system may have taken away what was there before it refused.
    if (::mmap(at, kLargePage, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_FIXED, -1, 0) == MAP_FAILED)
      throw std::bad_alloc();
  }
#endif
  /// Each page that is moved may be a mapping of its own, of which a process has some ten thousands.
  static constexpr std::size_t kMostGathered = std::size_t{4} << 30;

  mutable std::mutex mutex_;
  SpareStretches small_;  // In pages.
  SpareStretches large_;  // In large pages, aligned to them.
};

SparePages& spare_pages() {
  static SparePages* const pages = new SparePages;  // Outlives whatever returns pages at exit.
  return *pages;
}

}  // namespace

void* take_pages(std::size_t size_bytes) {
  return spare_pages().take(size_bytes);
}

void return_pages(void* pages, std::size_t size_bytes) noexcept {
  spare_pages().keep(pages, size_bytes);
}

void drop_spare_pages() noexcept {
  spare_pages().drop();
}

std::size_t spare_pages_bytes() noexcept {
  return spare_pages().size_bytes();
}

}  // namespace arris
