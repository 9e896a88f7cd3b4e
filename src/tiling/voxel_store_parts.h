#pragma once
/// @file What a VoxelStore is made of; for the accumulator that makes it.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <utility>

#include "tiling/voxel_file.h"
#include "tiling/voxel_store.h"

namespace arris::tiling {

struct VoxelStore::Impl {
  Impl(const VoxelGrid& of, std::filesystem::path path, std::size_t buffer_bytes, bool colours)
      : grid(of), file(std::move(path), buffer_bytes, VoxelLayout(of, colours)) {}

  VoxelGrid grid;
  VoxelFile file;
  VoxelIndex index;
  std::uint16_t largest_colour = 0;
  std::uint64_t points = 0;
};

}  // namespace arris::tiling
