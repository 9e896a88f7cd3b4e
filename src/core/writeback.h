#pragma once
/// @file Files that go to disk while they are written.

#include <cstdint>

namespace arris {

/// Tells the system now and then to begin with what was written, so that there is little to wait for when the file is
/// synced. Only a hint: syncing tells what goes wrong. Not thread-safe.
class Writeback {
 public:
  /// @param step_bytes  between one hint and the next.
  explicit Writeback(std::uint64_t step_bytes) : step_bytes_(step_bytes) {}

  /// @param size_bytes  of the file, written in order so far.
  void written(int descriptor, std::uint64_t size_bytes) {
    if (size_bytes - begun_bytes_ >= step_bytes_) begin(descriptor, size_bytes);
  }

 private:
  void begin(int descriptor, std::uint64_t size_bytes);

  std::uint64_t step_bytes_;
  std::uint64_t begun_bytes_ = 0;
};

}  // namespace arris
