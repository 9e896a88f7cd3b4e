#include "tiling/page_array.h"

#include <sys/mman.h>

#include <cstdint>
#include <new>

namespace arris::tiling {
namespace {

constexpr std::size_t kLargePage = std::size_t{2} << 20;

}  // namespace

Pages::Pages(std::size_t size_bytes) {
  if (size_bytes < kLeastMapped) {
    small_ = std::make_unique_for_overwrite<std::byte[]>(size_bytes);
    data_ = small_.get();
    return;
  }
  const bool large = size_bytes >= 2 * kLargePage;
  mapped_bytes_ = size_bytes + (large ? kLargePage : 0);  // Address space only: what is not touched takes no memory.
  mapped_ = ::mmap(nullptr, mapped_bytes_, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (mapped_ == MAP_FAILED) {
    mapped_ = nullptr;
    throw std::bad_alloc();
  }
  data_ = mapped_;
#if defined(MADV_HUGEPAGE)
  if (large) {
    // Fewer faults and fewer misses of the address cache; it does not matter if the system refuses. Parts of a large
    // page at the end stay small, so that no more than was asked for is ever resident.
    const auto begin = (reinterpret_cast<std::uintptr_t>(mapped_) + kLargePage - 1) / kLargePage * kLargePage;
    data_ = reinterpret_cast<void*>(begin);
    ::madvise(data_, size_bytes / kLargePage * kLargePage, MADV_HUGEPAGE);
  }
#endif
}

void Pages::free() noexcept {
  if (mapped_) ::munmap(mapped_, mapped_bytes_);
  mapped_ = nullptr;
}

}  // namespace arris::tiling
