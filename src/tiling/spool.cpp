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

/// Before the packed points of a block. A file ends with the number of all its points (uint64).
struct BlockHead {
  std::uint32_t points, bytes;
};

// Two blocks per tile where the pool allows it, so that scattered input is not written in crumbs.
std::uint32_t points_per_block(std::size_t buffer_bytes, std::size_t tiles) {
  const std::size_t share = buffer_bytes / (2 * std::max<std::size_t>(tiles, 1));
  const std::size_t bytes = std::min({std::max<std::size_t>(share, 1024), kLargestBlockBytes, buffer_bytes});
  return static_cast<std::uint32_t>(std::max<std::size_t>(bytes / sizeof(SpooledPoint), 1));
}

}  // namespace

std::filesystem::path spool_path(const std::filesystem::path& folder, std::size_t tile) {
  return folder / fmt::format("{}.spool", tile);
}

SpoolWriter::SpoolWriter(std::filesystem::path folder, std::size_t tiles, const Limits& limits)
    : folder_(std::move(folder)),
      limits_(limits),
      block_points_(points_per_block(limits.buffer_bytes, tiles)),
      tiles_(tiles),
      packed_(sizeof(BlockHead) + block_points_ * kMostPackedBytes + kPackingSlackBytes) {
  const std::size_t block_bytes = block_points_ * sizeof(SpooledPoint);
  const std::size_t blocks =
      std::clamp<std::size_t>(limits.buffer_bytes / block_bytes, 1, std::max<std::size_t>(tiles, 1));
  pool_ = std::make_unique_for_overwrite<SpooledPoint[]>(blocks * block_points_);
  block_owner_.resize(blocks);
  for (std::size_t block = blocks; block > 0; --block) free_blocks_.push_back(static_cast<std::uint32_t>(block - 1));
}

SpoolWriter::~SpoolWriter() {
  for (const std::size_t tile : open_tiles_) ::close(tiles_[tile].descriptor);
}

void SpoolWriter::append(std::size_t tile, std::span<const LatticePoint> points, std::uint64_t first_id) {
  Tile& state = tiles_[tile];
  points_ += points.size();
  for (std::size_t done = 0; done < points.size();) {
    if (state.block == kNone) acquire_block(tile);
    const std::size_t batch = std::min<std::size_t>(block_points_ - state.used, points.size() - done);
    SpooledPoint* const out = pool_.get() + std::size_t{state.block} * block_points_ + state.used;
    for (std::size_t i = 0; i < batch; ++i) out[i] = {points[done + i], first_id + done + i};
    done += batch;
    state.used += static_cast<std::uint32_t>(batch);
    if (state.used == block_points_) flush(tile);  // The block stays: more points are likely.
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
  const std::span block(pool_.get() + std::size_t{state.block} * block_points_, state.used);
  const std::size_t bytes = pack_points(block, packed_.data() + sizeof(BlockHead));
  const BlockHead head{state.used, static_cast<std::uint32_t>(bytes)};
  std::memcpy(packed_.data(), &head, sizeof(head));
  write(tile, std::span(packed_).first(sizeof(head) + bytes));
  state.points += state.used;
  state.used = 0;
}

void SpoolWriter::write(std::size_t tile, std::span<const std::byte> bytes) {
  const int descriptor = open_file(tile);
  while (!bytes.empty()) {
    const ssize_t wrote = ::write(descriptor, bytes.data(), bytes.size());
    if (wrote < 0 && errno == EINTR) continue;
    if (wrote <= 0) fail(tile, "write", wrote == 0 ? ENOSPC : errno);
    bytes = bytes.subspan(static_cast<std::size_t>(wrote));
    written_bytes_ += static_cast<std::uint64_t>(wrote);
  }
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
  write(tile, std::as_bytes(std::span(&state.points, 1)));
  close_file(tile);
}

void SpoolWriter::fail(std::size_t tile, const char* what, int reason) const {
  const std::uint64_t rest = limits_.expected_bytes > written_bytes_ ? limits_.expected_bytes - written_bytes_ : 0;
  throw_io_error(spool_path(folder_, tile), what, reason, rest);
}

void read_spool(const std::filesystem::path& path, LatticePoints& positions, PointIds& ids) {
  FileReader file(path);
  const auto require = [&](bool sound) {
    if (sound) return;
    throw IoError(
        fmt::format("{}: its {} bytes are not those of a spool; the file was damaged after it was written, "
                    "run again with --no-resume",
                    printable(path.string()), file.size_bytes()));
  };
  std::uint64_t points = 0;
  require(file.size_bytes() >= sizeof(points));
  file.read_exactly_at(file.size_bytes() - sizeof(points), std::as_writable_bytes(std::span(&points, 1)));
  require(points <= file.size_bytes() / kLeastPackedBytes);
  positions.resize(points);
  ids.resize(points);
  std::vector<std::byte> packed;
  for (std::size_t done = 0; done < points;) {
    BlockHead head{};
    file.read_exactly(std::as_writable_bytes(std::span(&head, 1)));
    require(head.points > 0 && head.points <= points - done && head.bytes <= file.size_bytes());
    packed.resize(head.bytes + kPackingSlackBytes);
    const std::span bytes = std::span(packed).first(head.bytes);
    file.read_exactly(bytes);
    require(unpack_points(bytes, std::span(positions).subspan(done, head.points),
                          std::span(ids).subspan(done, head.points)));
    done += head.points;
  }
  file.read_exactly(std::as_writable_bytes(std::span(&points, 1)));
  std::byte beyond{};
  require(points == positions.size() && file.read(std::span(&beyond, 1)) == 0);
}

}  // namespace arris::tiling
