#include "core/writeback.h"

#include <fcntl.h>

namespace arris {

void Writeback::begin([[maybe_unused]] int descriptor, std::uint64_t size_bytes) {
#if defined(SYNC_FILE_RANGE_WRITE)
  static_cast<void>(::sync_file_range(descriptor, static_cast<off_t>(begun_bytes_),
                                      static_cast<off_t>(size_bytes - begun_bytes_), SYNC_FILE_RANGE_WRITE));
#endif
  begun_bytes_ = size_bytes;
}

}  // namespace arris
