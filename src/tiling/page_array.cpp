#include "tiling/page_array.h"

#include <sys/mman.h>

#include <cstdlib>
#include <new>

namespace arris::tiling {
namespace {

constexpr std::size_t kPage = 4096;
constexpr std::size_t kLargePage = std::size_t{2} << 20;

}  // namespace

void* allocate_pages(std::size_t size_bytes) {
  const bool large = size_bytes >= 2 * kLargePage;
  const std::size_t alignment = large ? kLargePage : kPage;
  const std::size_t rounded = (size_bytes + kPage - 1) / kPage * kPage;
  void* const pages = std::aligned_alloc(alignment, (rounded + alignment - 1) / alignment * alignment);
  if (!pages) throw std::bad_alloc();
#if defined(MADV_HUGEPAGE)
  // Fewer faults and fewer misses of the address cache; it does not matter if the system refuses.
  if (large) ::madvise(pages, rounded / kLargePage * kLargePage, MADV_HUGEPAGE);
#endif
  return pages;
}

void free_pages(void* pages) {
  std::free(pages);
}

}  // namespace arris::tiling
