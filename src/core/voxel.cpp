#include "core/voxel.h"

#include <string>

#include "core/error.h"

namespace arris {

VoxelGrid::VoxelGrid(std::int32_t side_steps)
    : side_steps_(side_steps), half_(side_steps / 2), inverse_(1.0 / side_steps) {
  if (side_steps < 1 || side_steps > kMostVoxelSide) {
    throw ConfigError("a voxel of " + std::to_string(side_steps) + " lattice steps is outside of 1 to " +
                      std::to_string(kMostVoxelSide) + "; choose another --voxel or --lattice");
  }
}

}  // namespace arris
