#pragma once
/// @file Sorted runs of sums of voxels on disk.

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <optional>
#include <span>
#include <vector>

#include "core/parallel.h"
#include "tiling/checked_file.h"
#include "tiling/scratch_file.h"
#include "tiling/voxel_sums.h"

namespace arris::tiling {

/// A run: written once in Z-order, read once. 28 bytes per record, 40 with colours; hashed on the way out and in.
/// Removes its file on destruction. Throws IoError.
class VoxelRun {
 public:
  /// @param buffer_bytes  for writing: one half is filled while another thread writes the other, unless loops may use
  /// one thread only.
  VoxelRun(std::filesystem::path path, bool colours, std::size_t buffer_bytes);

  void append(const VoxelRecord& record) {
    if (used_ + record_bytes_ > buffer_.size()) flush();
    // Two copies of known size are faster than one of a size that is not.
    std::memcpy(buffer_.data() + used_, &record.sums, sizeof(record.sums));
    if (has_colours()) std::memcpy(buffer_.data() + used_ + sizeof(record.sums), &record.colour, sizeof(record.colour));
    used_ += record_bytes_;
  }
  void append(std::span<const VoxelRecord> records) {
    for (const VoxelRecord& record : records) append(record);
  }
  /// Ends writing; frees the buffer and the descriptor.
  void close();

  /// Begins reading, by way of a buffer of at least one record, which must live as long as the run is read.
  void open(std::span<std::byte> buffer);
  /// The next record; false at the end, after the whole run was verified. Leaves `record.colour` alone if the run has
  /// no colours.
  bool read(VoxelRecord& record) {
    if (used_ == filled_ && !refill()) return false;
    std::memcpy(&record.sums, buffer_.data() + used_, sizeof(record.sums));
    if (has_colours()) std::memcpy(&record.colour, buffer_.data() + used_ + sizeof(record.sums), sizeof(record.colour));
    used_ += record_bytes_;
    return true;
  }

  bool has_colours() const { return record_bytes_ == sizeof(VoxelRecord); }
  std::uint64_t size_bytes() const { return file_.size_bytes(); }

 private:
  void flush();
  void write(std::span<const std::byte> bytes);
  bool refill();

  ScratchFile file_;
  std::size_t record_bytes_;
  std::vector<std::byte> own_buffer_;  // While the run is written.
  std::span<std::byte> buffer_;
  std::size_t used_ = 0;    // Bytes of the buffer written or read.
  std::size_t filled_ = 0;  // Bytes of the buffer that hold records to read.
  std::uint64_t position_ = 0;
  std::optional<Hasher> hasher_;  // While the run is open.
  std::uint64_t digest_ = 0;
  std::optional<BackgroundTasks> writing_;  // Of the other half of the buffer. Joined before that goes.
};

}  // namespace arris::tiling
