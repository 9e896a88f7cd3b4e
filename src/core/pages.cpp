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

/// Fresh pages that begin at a large page. What follows in the last large page is nobody's.
std::uintptr_t map_large(std::size_t size) {
  const std::size_t used = whole(size, kLargePage);
  const std::uintptr_t address = map(used + kLargePage);
  const std::uintptr_t begin = whole(address, kLargePage);
  if (begin > address) unmap({address, begin - address});
  unmap({begin + size, address + used + kLargePage - begin - size});
#if defined(MADV_HUGEPAGE)
  // Fewer faults and fewer misses of the address cache; it does not matter if the system refuses. Parts of a large page
  // at the end stay small, so that no more than was asked for is ever resident.
  ::madvise(reinterpret_cast<void*>(begin), size / kLargePage * kLargePage, MADV_HUGEPAGE);
#endif
  return begin;
}

/// The part of a stretch up to the last page that is resident: arrays fill from the front.
Stretch written_part(const Stretch& stretch) noexcept {
  std::array<unsigned char, kLargePage / kPage> resident;
  for (std::size_t size = stretch.size_bytes; size > 0;) {
    const std::size_t looked_at = std::min(size, kLargePage);
    if (::mincore(reinterpret_cast<void*>(stretch.begin + size - looked_at), looked_at, resident.data()) != 0)
      return {stretch.begin, size};
    for (std::size_t page = looked_at / kPage; page > 0; --page, size -= kPage) {
      if ((resident[page - 1] & 1) != 0) return {stretch.begin, size};
    }
  }
  return {stretch.begin, 0};
}

/// What was returned and not taken again: stretches by address; those that touch are one. Thread-safe.
class SparePages {
 public:
  std::uintptr_t take(std::size_t size) {
    const std::lock_guard lock(mutex_);
    const bool large = size >= 2 * kLargePage;
    if (const std::uintptr_t begin = take_stretch(size, large ? kLargePage : kPage)) return begin;
    // As much as is made anew must go of what does not fit.
    if (!large) {
      drop_least(whole(size, kLargePage));
      return begin_of_large_pages(size);
    }
    const std::uintptr_t begin = map_large(size);
    const std::size_t gathered = gather(begin, size / kLargePage) * kLargePage;
    if (gathered < size) drop_least(size - gathered);
    return begin;
  }
  void keep(const Stretch& stretch) noexcept {
    const std::lock_guard lock(mutex_);
    const Stretch written = written_part(stretch);
    if (written.size_bytes < stretch.size_bytes) unmap({written.end(), stretch.size_bytes - written.size_bytes});
    if (written.size_bytes > 0) insert(written);
  }
  void drop() noexcept {
    const std::lock_guard lock(mutex_);
    drop_all();
  }
  /// From the ends of stretches, whole large pages where there are any.
  void trim(std::size_t most_bytes) noexcept {
    const std::lock_guard lock(mutex_);
    for (std::size_t size = sum(); size > most_bytes;) {
      Stretch& last = spare_.back();
      const std::size_t gone = std::min(whole(size - most_bytes, kLargePage), last.size_bytes);
      last.size_bytes -= gone;
      size -= gone;
      unmap({last.end(), gone});
      if (last.size_bytes == 0) spare_.pop_back();
    }
  }
  std::size_t size_bytes() const noexcept {
    const std::lock_guard lock(mutex_);
    return sum();
  }

 private:
  std::size_t sum() const noexcept {
    std::size_t sum = 0;
    for (const Stretch& stretch : spare_) sum += stretch.size_bytes;
    return sum;
  }
  /// Smaller blocks share large pages: what is left of the last one is spare.
  std::uintptr_t begin_of_large_pages(std::size_t size) {
    const std::size_t mapped = whole(size, kLargePage);
    const std::uintptr_t begin = map_large(mapped);
    if (mapped > size) insert({begin + size, mapped - size});
    return begin;
  }
  /// From the smallest stretch that is long enough, its beginning on a multiple of `unit`; 0 if there is none.
  std::uintptr_t take_stretch(std::size_t size, std::size_t unit) {
    auto best = spare_.end();
    for (auto it = spare_.begin(); it != spare_.end(); ++it) {
      if (whole(it->begin, unit) + size > it->end()) continue;
      if (best == spare_.end() || it->size_bytes < best->size_bytes) best = it;
    }
    return best == spare_.end() ? 0 : cut(best, whole(best->begin, unit), size);
  }
  /// Takes part of a stretch; what is before and after it stays.
  std::uintptr_t cut(std::vector<Stretch>::iterator from, std::uintptr_t begin, std::size_t size) {
    const Stretch after{begin + size, from->end() - begin - size};
    from->size_bytes = begin - from->begin;
    if (from->size_bytes == 0) spare_.erase(from);
    if (after.size_bytes > 0) insert(after);
    return begin;
  }
  void insert(Stretch stretch) noexcept {
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
  /// At least so much where more than kSlack is spare, the smallest stretches first: they are the least likely to fit
  /// anything.
  void drop_least(std::size_t size) noexcept {
    for (std::size_t gone = 0, left = sum(); gone < size && left > kSlack;) {
      const auto least = std::ranges::min_element(spare_, {}, &Stretch::size_bytes);
      gone += least->size_bytes;
      left -= least->size_bytes;
      unmap(*least);
      spare_.erase(least);
    }
  }
  void drop_all() noexcept {
    for (const Stretch& stretch : spare_) unmap(stretch);
    spare_.clear();
  }

  /// Puts spare large pages in the place of fresh ones, as many as there are. @return how many.
  std::size_t gather([[maybe_unused]] std::uintptr_t to, [[maybe_unused]] std::size_t count) {
    std::size_t gathered = 0;
#if defined(MREMAP_FIXED)
    for (; gathered < std::min(count, kMostGathered); ++gathered, to += kLargePage) {
      const std::uintptr_t from = take_stretch(kLargePage, kLargePage);
      if (from == 0) break;
      move_large_page(from, to);
    }
#endif
    return gathered;
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
  static constexpr std::size_t kMostGathered = 2048;

  /// Arrays of a few hundred kilobytes come and go all the time: what is left between them is worth keeping.
  static constexpr std::size_t kSlack = 2 * kLargePage;
  static constexpr std::size_t kMost = 256;
  static std::vector<Stretch> room() {
    std::vector<Stretch> spare;
    spare.reserve(kMost);
    return spare;
  }

  mutable std::mutex mutex_;
  std::vector<Stretch> spare_ = room();
};

SparePages& spare_pages() {
  static SparePages* const pages = new SparePages;  // Outlives whatever returns pages at exit.
  return *pages;
}

}  // namespace

void* take_pages(std::size_t size_bytes) {
  return reinterpret_cast<void*>(spare_pages().take(whole(size_bytes, kPage)));
}

void return_pages(void* pages, std::size_t size_bytes) noexcept {
  spare_pages().keep({reinterpret_cast<std::uintptr_t>(pages), whole(size_bytes, kPage)});
}

void drop_spare_pages() noexcept {
  spare_pages().drop();
}

void trim_spare_pages(std::size_t most_bytes) noexcept {
  spare_pages().trim(most_bytes);
}

std::size_t spare_pages_bytes() noexcept {
  return spare_pages().size_bytes();
}

void touch_pages(void* begin, std::size_t size_bytes) noexcept {
  auto* const bytes = static_cast<volatile unsigned char*>(begin);
  for (std::size_t at = 0; at < size_bytes; at += kPage) bytes[at] = 0;
  if (size_bytes > 0) bytes[size_bytes - 1] = 0;
}

}  // namespace arris
