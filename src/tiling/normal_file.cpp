#include "tiling/normal_file.h"

#include <algorithm>
#include <iterator>

#include "core/parallel.h"
#include "tiling/checked_file.h"

namespace arris::tiling {
namespace {

/// Written at a time.
constexpr std::size_t kBufferVoxels = 16 * 1024;
/// Read by a thread at a time: so many chunks that those at the ends, which others read too, are few.
constexpr std::size_t kReadVoxels = 16 * NormalFile::kChunkVoxels;

std::uint64_t checksum(std::span<const NormalFile::Normal> normals) {
  Hasher hasher;
  hasher.update(normals.data(), normals.size_bytes());
  return hasher.digest();
}

}  // namespace

void NormalFile::append(const VoxelTile& tile, std::span<const Normal> normals) {
  std::vector<Normal> buffer;
  buffer.reserve(kBufferVoxels);
  std::size_t begin = 0;  // Of the chunk, in the buffer.
  std::uint32_t next_rank = 0;
  for (std::size_t v = 0; v < tile.size(); ++v) {
    if (tile.core[v] == 0) continue;
    if (tile.ranks[v] != next_rank || buffer.size() - begin == kChunkVoxels) {
      add_chunk(buffer, begin, next_rank);
      begin = buffer.size();
      if (begin + kChunkVoxels > kBufferVoxels) {
        file_.append(std::as_bytes(std::span(buffer)));
        buffer.clear();
        begin = 0;
      }
    }
    buffer.push_back(normals[v]);
    next_rank = tile.ranks[v] + 1;
  }
  add_chunk(buffer, begin, next_rank);
  file_.append(std::as_bytes(std::span(buffer)));
}

void NormalFile::add_chunk(std::span<const Normal> normals, std::size_t begin, std::uint32_t end_rank) {
  const std::span<const Normal> chunk = normals.subspan(begin);
  if (chunk.empty()) return;
  const auto voxels = static_cast<std::uint32_t>(chunk.size());
  chunks_.push_back({end_rank - voxels, voxels, file_.size_bytes() + begin * sizeof(Normal), checksum(chunk)});
}

void NormalFile::finish() {
  std::ranges::sort(chunks_, {}, &Chunk::first_rank);
}

PageVector<NormalFile::Normal> NormalFile::read(const VoxelTile& tile) const {
  PageVector<Normal> normals(tile.size());
  parallel_for_chunks(tile.size(), kReadVoxels, [&](std::size_t begin, std::size_t end) {
    std::vector<Normal> stored;
    for (std::size_t v = begin; v < end;) {
      const Chunk& chunk = *std::prev(std::ranges::upper_bound(chunks_, tile.ranks[v], {}, &Chunk::first_rank));
      stored.resize(chunk.voxels);
      file_.read_at(chunk.offset, std::as_writable_bytes(std::span(stored)));
      if (checksum(stored) != chunk.checksum) file_.throw_damaged();
      for (; v < end && tile.ranks[v] - chunk.first_rank < chunk.voxels; ++v)
        normals[v] = stored[tile.ranks[v] - chunk.first_rank];
    }
  });
  return normals;
}

}  // namespace arris::tiling
