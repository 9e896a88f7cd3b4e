#include "core/writeback.h"

#include <fcntl.h>

namespace arris {
namespace {

/// Of the cache that is asked for: the system looks at all that are left of the file every time.
constexpr std::uint64_t kLetGoShare = 4;

}  // namespace

void Writeback::begin([[maybe_unused]] int descriptor, std::uint64_t size_bytes) {
#if defined(SYNC_FILE_RANGE_WRITE)
  static_cast<void>(::sync_file_range(descriptor, static_cast<off_t>(begun_bytes_),
                                      static_cast<off_t>(size_bytes - begun_bytes_), SYNC_FILE_RANGE_WRITE));
#endif
  begun_bytes_ = size_bytes;
#if defined(POSIX_FADV_DONTNEED)
  if (size_bytes < cached_bytes_ || size_bytes - cached_bytes_ < let_go_bytes_ + cached_bytes_ / kLetGoShare) return;
  // From the start: what was not on disk the last time may be now.
  let_go_bytes_ = size_bytes - cached_bytes_;
  static_cast<void>(::posix_fadvise(descriptor, 0, static_cast<off_t>(let_go_bytes_), POSIX_FADV_DONTNEED));
#endif
}

}  // namespace arris
