#pragma once
/// @file Files that go to disk while they are written.

#include <cstdint>

namespace arris {

/// Tells the system now and then to begin with what was written, so that there is little to wait for when the file is
/// synced, and, if asked to, that what is on disk already need not stay in memory but for the end of the file: pages of
/// its cache are used again then, while a file that does not fit would take memory from everything else, page by page.
/// Only hints: syncing tells what goes wrong. Not thread-safe.
class Writeback {
 public:
  static constexpr std::uint64_t kCacheAll = ~std::uint64_t{0};

  /// @param step_bytes  between one hint and the next. @param cached_bytes  of the end of the file, at least.
  explicit Writeback(std::uint64_t step_bytes, std::uint64_t cached_bytes = kCacheAll)
      : step_bytes_(step_bytes), cached_bytes_(cached_bytes) {}

  /// @param size_bytes  of the file, written in order so far.
  void written(int descriptor, std::uint64_t size_bytes) {
    if (size_bytes - begun_bytes_ >= step_bytes_) begin(descriptor, size_bytes);
  }

 private:
  void begin(int descriptor, std::uint64_t size_bytes);

  std::uint64_t step_bytes_;
  std::uint64_t cached_bytes_;
  std::uint64_t begun_bytes_ = 0;
  std::uint64_t let_go_bytes_ = 0;
};

}  // namespace arris
