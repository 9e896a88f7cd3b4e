#include "tiling/spool.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>

#include "core/error.h"
#include "core/text.h"
#include "tiling/checked_file.h"

namespace arris::tiling {
namespace {

constexpr std::size_t kLargestBlockBytes = 32 * 1024;
constexpr std::size_t kReadRecords = 16 * 1024;
static_assert(sizeof(LatticePoint) == 12, "a LatticePoint is copied into a record as it is");

// Two blocks per tile where the pool allows it, so that scattered input is not written in crumbs.
std::uint32_t records_per_block(std::size_t buffer_bytes, std::size_t tiles) {
  const std::size_t share = buffer_bytes / (2 * std::max<std::size_t>(tiles, 1));
  const std::size_t bytes = std::min({std::max<std::size_t>(share, 1024), kLargestBlockBytes, buffer_bytes});
  return static_cast<std::uint32_t>(std::max<std::size_t>(bytes / kSpoolRecordBytes, 1));
}

}  // namespace

std::filesystem::path spool_path(const std::filesystem::path& folder, std::size_t tile) {
  return folder / fmt::format("{}.spool", tile);
}

SpoolWriter::SpoolWriter(std::filesystem::path folder, std::size_t tiles, const Limits& limits)
    : folder_(std::move(folder)),
      limits_(limits),
      block_records_(records_per_block(limits.buffer_bytes, tiles)),
      tiles_(tiles) {
  const std::size_t block_bytes = block_records_ * kSpoolRecordBytes;
  const std::size_t blocks =
      std::clamp<std::size_t>(limits.buffer_bytes / block_bytes, 1, std::max<std::size_t>(tiles, 1));
  pool_ = std::make_unique_for_overwrite<std::byte[]>(blocks * block_bytes);
  block_owner_.resize(blocks);
  for (std::size_t block = blocks; block > 0; --block) free_blocks_.push_back(static_cast<std::uint32_t>(block - 1));
}

SpoolWriter::~SpoolWriter() {
  for (const std::size_t tile : open_tiles_) ::close(tiles_[tile].descriptor);
}

void SpoolWriter::append(std::size_t tile, std::span<const LatticePoint> points, std::uint64_t first_id) {
  Tile& state = tiles_[tile];
  records_ += points.size();
  for (std::size_t done = 0; done < points.size();) {
    if (state.block == kNone) acquire_block(tile);
    const std::size_t batch = std::min<std::size_t>(block_records_ - state.used, points.size() - done);
    std::byte* out = pool_.get() + (std::size_t{state.block} * block_records_ + state.used) * kSpoolRecordBytes;
    for (std::size_t i = done; i < done + batch; ++i, out += kSpoolRecordBytes) {
      const std::uint64_t id = first_id + i;
      std::memcpy(out, &points[i], sizeof(LatticePoint));
      std::memcpy(out + sizeof(LatticePoint), &id, sizeof(id));
    }
    done += batch;
    state.used += static_cast<std::uint32_t>(batch);
    if (state.used == block_records_) flush(tile);  // The block stays: more points are likely.
  }
}

void SpoolWriter::acquire_block(std::size_t tile) {
  if (free_blocks_.empty()) {
    const auto fullest =
        std::ranges::max_element(block_owner_, {}, [&](std::size_t owner) { return tiles_[owner].used; });
    Tile& victim = tiles_[*fullest];
    flush(*fullest);
    free_blocks_.push_back(victim.block);
    victim.block = kNone;
  }
  tiles_[tile].block = free_blocks_.back();
  free_blocks_.pop_back();
  block_owner_[tiles_[tile].block] = tile;
}

void SpoolWriter::flush(std::size_t tile) {
  Tile& state = tiles_[tile];
  if (state.used == 0) return;
  const int descriptor = open_file(tile);
  const std::byte* data = pool_.get() + std::size_t{state.block} * block_records_ * kSpoolRecordBytes;
  std::size_t left = std::size_t{state.used} * kSpoolRecordBytes;
  while (left > 0) {
    const ssize_t wrote = ::write(descriptor, data, left);
    if (wrote < 0 && errno == EINTR) continue;
    if (wrote <= 0) fail(tile, "write", wrote == 0 ? ENOSPC : errno);
    data += wrote;
    left -= static_cast<std::size_t>(wrote);
    written_bytes_ += static_cast<std::uint64_t>(wrote);
  }
  state.used = 0;
}

int SpoolWriter::open_file(std::size_t tile) {
  Tile& state = tiles_[tile];
  if (state.descriptor >= 0) return state.descriptor;
  if (open_tiles_.size() >= std::max<std::size_t>(limits_.open_files, 1)) close_file(open_tiles_.front());
  const int flags = O_WRONLY | O_APPEND | O_CLOEXEC | O_NOFOLLOW | (state.created ? 0 : O_CREAT | O_TRUNC);
  do {
    state.descriptor = ::open(spool_path(folder_, tile).c_str(), flags, 0600);
  } while (state.descriptor < 0 && errno == EINTR);
  if (state.descriptor < 0) fail(tile, "open", errno);
  state.created = true;
  open_tiles_.push_back(tile);
  return state.descriptor;
}

void SpoolWriter::close_file(std::size_t tile) {
  std::erase(open_tiles_, tile);
  const int descriptor = std::exchange(tiles_[tile].descriptor, -1);
  if (::close(descriptor) != 0 && errno != EINTR) fail(tile, "close", errno);
}

void SpoolWriter::close(std::size_t tile) {
  flush(tile);
  Tile& state = tiles_[tile];
  if (state.block != kNone) free_blocks_.push_back(std::exchange(state.block, kNone));
  if (!state.created) open_file(tile);
  if (state.descriptor >= 0) close_file(tile);
}

void SpoolWriter::fail(std::size_t tile, const char* what, int reason) const {
  const std::uint64_t rest = limits_.expected_bytes > written_bytes_ ? limits_.expected_bytes - written_bytes_ : 0;
  throw_io_error(spool_path(folder_, tile), what, reason, rest);
}

void read_spool(const std::filesystem::path& path, std::vector<LatticePoint>& positions,
                std::vector<std::uint64_t>& ids) {
  FileReader file(path);
  if (file.size_bytes() % kSpoolRecordBytes != 0) {
    throw IoError(
        fmt::format("{}: its {} bytes are not a whole number of {}-byte records; the file was damaged after it was "
                    "written, run again with --no-resume",
                    printable(path.string()), file.size_bytes(), kSpoolRecordBytes));
  }
  const std::size_t count = file.size_bytes() / kSpoolRecordBytes;
  positions.resize(count);
  ids.resize(count);
  std::vector<std::byte> buffer(std::min(count, kReadRecords) * kSpoolRecordBytes);
  for (std::size_t done = 0; done < count;) {
    const std::size_t batch = std::min(count - done, kReadRecords);
    file.read_exactly(std::span(buffer).first(batch * kSpoolRecordBytes));
    const std::byte* in = buffer.data();
    for (std::size_t i = done; i < done + batch; ++i, in += kSpoolRecordBytes) {
      std::memcpy(&positions[i], in, sizeof(LatticePoint));
      std::memcpy(&ids[i], in + sizeof(LatticePoint), sizeof(std::uint64_t));
    }
    done += batch;
  }
}

}  // namespace arris::tiling
