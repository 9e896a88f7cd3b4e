#include "tiling/voxel_cube.h"

#include <algorithm>

namespace arris::tiling {
namespace {

constexpr int kBlock = VoxelIndex::kBlockSide;
constexpr std::uint32_t kParts = VoxelIndex::kBlockParts;
using Words = std::array<std::uint64_t, kParts>;

/// The places of a block that lie in its first (-1), last (1) or any (0) layer along each axis.
constexpr std::array<Words, cube::kAround> layers() {
  std::array<Words, cube::kAround> places{};
  const auto in = [](int layer, int at) { return layer == 0 || at == (layer < 0 ? 0 : kBlock - 1); };
  for (int i = 0; i < cube::kAround; ++i) {
    for (int x = 0; x < kBlock; ++x) {
      for (int y = 0; y < kBlock; ++y) {
        for (int z = 0; z < kBlock; ++z) {
          if (!in(i / 9 - 1, x) || !in(i / 3 % 3 - 1, y) || !in(i % 3 - 1, z)) continue;
          const std::uint32_t place = VoxelIndex::place_in_block({x, y, z});
          places[i][place / 64] |= std::uint64_t{1} << place % 64;
        }
      }
    }
  }
  return places;
}
constexpr auto kLayers = layers();
constexpr int layer_index(int x, int y, int z) {
  return 9 * (x + 1) + 3 * (y + 1) + z + 1;
}

/// Bits 0 to 5: voxels in the first and last layer along x, y and z.
using Faces = std::uint32_t;
Faces faces_of(const Words& voxels) {
  constexpr std::array<int, 6> kFaces{layer_index(-1, 0, 0), layer_index(1, 0, 0),  layer_index(0, -1, 0),
                                      layer_index(0, 1, 0),  layer_index(0, 0, -1), layer_index(0, 0, 1)};
  Faces faces = 0;
  for (std::size_t face = 0; face < kFaces.size(); ++face) {
    std::uint64_t any = 0;
    for (std::uint32_t part = 0; part < kParts; ++part) any |= voxels[part] & kLayers[kFaces[face]][part];
    faces |= static_cast<Faces>(any != 0) << face;
  }
  return faces;
}

/// A place around a group, from -1 to 2 along each axis, and what it takes to touch a block there.
struct Beside {
  std::array<std::int8_t, 3> at{};
  std::int8_t layer = 0;            ///< Of that block: the part of it that touches the group; of kLayers.
  std::array<Faces, 8> touching{};  ///< Per block of the group: the faces that must have voxels; 0: too far.
};

constexpr std::array<Beside, 56> places_beside() {
  std::array<Beside, 56> all{};
  std::size_t count = 0;
  for (int i = 0; i < 64; ++i) {
    const std::array<int, 3> at{i / 16 - 1, i / 4 % 4 - 1, i % 4 - 1};
    Beside place;
    std::array<int, 3> layer{};
    bool beside = false;
    for (int axis = 0; axis < 3; ++axis) {
      place.at[axis] = static_cast<std::int8_t>(at[axis]);
      layer[axis] = at[axis] < 0 ? 1 : at[axis] > 1 ? -1 : 0;
      beside |= layer[axis] != 0;
    }
    if (!beside) continue;
    place.layer = static_cast<std::int8_t>(layer_index(layer[0], layer[1], layer[2]));
    for (int block = 0; block < 8; ++block) {
      Faces faces = 0;
      bool near = true;
      for (int axis = 0; axis < 3; ++axis) {
        const int away = at[axis] - (block >> (2 - axis) & 1);
        near &= away >= -1 && away <= 1;
        if (away != 0) faces |= Faces{1} << (2 * axis + (away > 0 ? 1 : 0));
      }
      place.touching[block] = near ? faces : 0;
    }
    all[count++] = place;
  }
  return all;
}
constexpr auto kBeside = places_beside();

bool touches(const std::array<Faces, 8>& faces, const Beside& place) {
  bool any = false;
  for (std::size_t block = 0; block < 8; ++block)
    any |= place.touching[block] != 0 && (faces[block] & place.touching[block]) == place.touching[block];
  return any;
}

LatticePoint group_of(const LatticePoint& block) {
  return {block.x >> 1, block.y >> 1, block.z >> 1};
}

}  // namespace

BlockRange block_group(const VoxelIndex& index, std::size_t block) {
  const LatticePoint group = group_of(index.block(block).key);
  BlockRange found{block, block + 1};
  while (found.begin > 0 && group_of(index.block(found.begin - 1).key) == group) --found.begin;
  while (found.end < index.blocks() && group_of(index.block(found.end).key) == group) ++found.end;
  return found;
}

template <bool kRanks>
void VoxelCube<kRanks>::load(const BlockRange& group) {
  rows_.fill(0);
  std::array<Faces, 8> faces{};
  LatticePoint first;
  for (std::size_t block = group.begin; block < group.end; ++block) {
    const LatticePoint key = index_.block(block).key;
    first = {key.x & ~1, key.y & ~1, key.z & ~1};
    Words voxels;
    for (std::uint32_t part = 0; part < kParts; ++part) voxels[part] = index_.part(block, part).bits;
    faces[static_cast<std::size_t>((key.x & 1) << 2 | (key.y & 1) << 1 | (key.z & 1))] = faces_of(voxels);
    add(static_cast<std::uint32_t>(block), kLayers[layer_index(0, 0, 0)], first_cell(key));
  }
  for (const Beside& place : kBeside) {
    if (!touches(faces, place)) continue;
    // Keys of blocks have 29 bits, so their neighbours' fit.
    const std::uint32_t block = find({first.x + place.at[0], first.y + place.at[1], first.z + place.at[2]});
    if (block == VoxelIndex::kNone) continue;
    add(block, kLayers[place.layer], first_cell(place.at[0], place.at[1], place.at[2]));
  }
}

template <bool kRanks>
void VoxelCube<kRanks>::add(std::uint32_t block, const Words& places, cube::RowCell first) {
  for (std::uint32_t part = 0; part < kParts; ++part) {
    if (places[part] == 0) continue;
    const VoxelIndex::Part voxels = index_.part(block, part);
    for_each_bit(voxels.bits & places[part], [&](std::uint32_t bit) {
      const cube::RowCell at = kCellOfPlace[part * kPartPlaces + bit];
      rows_[static_cast<std::size_t>(first.row + at.row)] |= 1U << (first.z + at.z);
      if constexpr (kRanks) ranks_[static_cast<std::size_t>(first.cell() + at.cell())] = voxels.rank(bit);
    });
  }
}

template <bool kRanks>
std::uint32_t VoxelCube<kRanks>::find(const LatticePoint& block) {
  Found& slot = recent_[static_cast<std::size_t>((block.x & 15) | (block.y & 15) << 4 | (block.z & 7) << 8)];
  if (!slot.known || slot.key != block) slot = {block, index_.find_block(block), true};
  return slot.index;
}

template class VoxelCube<false>;
template class VoxelCube<true>;

}  // namespace arris::tiling
