#include "tiling/voxel_run.h"

#include <algorithm>
#include <utility>

namespace arris::tiling {
VoxelRun::VoxelRun(std::filesystem::path path, bool colours, std::size_t buffer_bytes)
    : file_(std::move(path)),
      record_bytes_(colours ? sizeof(VoxelRecord) : sizeof(VoxelSums)),
      own_buffer_(2 * std::max(buffer_bytes / (2 * record_bytes_), std::size_t{1}) * record_bytes_),
      buffer_(own_buffer_),
      hasher_(std::in_place) {
  if (loop_threads() == 1) return;
  buffer_ = buffer_.first(own_buffer_.size() / 2);
  writing_.emplace(1);
}

void VoxelRun::flush() {
  const std::span<const std::byte> full = buffer_.first(used_);
  used_ = 0;
  if (!writing_) return write(full);
  writing_->wait();
  writing_->run([this, full] { write(full); });
  const std::size_t half = own_buffer_.size() / 2;
  buffer_ = std::span(own_buffer_).subspan(buffer_.data() == own_buffer_.data() ? half : 0, half);
}

void VoxelRun::write(std::span<const std::byte> bytes) {
  hasher_->update(bytes.data(), bytes.size());
  file_.append(bytes);
}

void VoxelRun::close() {
  flush();
  if (writing_) writing_->wait();
  writing_.reset();
  digest_ = hasher_->digest();
  hasher_.reset();
  file_.close();
  std::vector<std::byte>().swap(own_buffer_);  // Assigning {} would keep the memory.
}

void VoxelRun::open(std::span<std::byte> buffer) {
  file_.reopen();
  hasher_.emplace();
  buffer_ = buffer.first(buffer.size() / record_bytes_ * record_bytes_);
  position_ = 0;
  used_ = filled_ = 0;
}

bool VoxelRun::refill() {
  filled_ = static_cast<std::size_t>(std::min<std::uint64_t>(buffer_.size(), file_.size_bytes() - position_));
  used_ = 0;
  if (filled_ == 0) {
    if (hasher_->digest() != digest_) file_.throw_damaged();
    return false;
  }
  const auto bytes = buffer_.first(filled_);
  file_.read_at(position_, bytes);
  hasher_->update(bytes.data(), bytes.size());
  position_ += filled_;
  return true;
}

}  // namespace arris::tiling
