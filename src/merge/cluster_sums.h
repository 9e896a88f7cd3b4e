#pragma once
/// @file What is summed and offered of the members of a cluster. Private to ClusterTable.

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "core/voxel.h"
#include "features/supervoxel/clusters.h"
#include "features/supervoxel/voxel_features.h"

namespace arris::merge {

/// Normals and colours are summed in whole multiples of 1 / this.
constexpr float kNormalUnits = 32767.0F;
constexpr float kColourUnits = 256.0F;
/// Members within 30 degrees of the mean normal lie on the surface of most; where two surfaces are mixed in equal parts
/// none do.
constexpr float kFacingCosine = 0.8660254F;

/// The nearest whole number, halves away from zero, of what is smaller than 2^23: as std::lround(), which is a call.
inline std::int64_t units(float value, float per_one) {
  const float scaled = value * per_one;
  const auto whole = static_cast<std::int32_t>(scaled);
  const float rest = scaled - static_cast<float>(whole);
  return whole + (rest >= 0.5F) - (rest <= -0.5F);
}

struct SurfaceSums {
  std::int64_t voxels = 0;
  std::array<std::int64_t, 3> position{};  ///< From the seed's position.
  std::array<std::int64_t, 3> normal{};    ///< Signs as the centre's.

  void add(const SurfaceSums& other) {
    voxels += other.voxels;
    for (std::size_t i = 0; i < 3; ++i) {
      position[i] += other.position[i];
      normal[i] += other.normal[i];
    }
  }
};
struct Sums {
  SurfaceSums all;
  SurfaceSums facing;  ///< Members that lie on the surface of most.
  std::array<std::int64_t, 3> colour{};

  void add(const Sums& other) {
    all.add(other.all);
    facing.add(other.facing);
    for (std::size_t i = 0; i < 3; ++i) colour[i] += other.colour[i];
  }
};
using HistogramSums = std::array<std::int64_t, kHistogramBins>;

struct SeedOffer {
  std::uint64_t distance2 = ~std::uint64_t{0};
  std::uint32_t rank = 0xffffffffU;
  VoxelPosition position{};

  bool better_than(const SeedOffer& other) const {
    return distance2 != other.distance2 ? distance2 < other.distance2 : rank < other.rank;
  }
};

/// Values of the clusters that were met last, for one thread: neighbours in Z-order share few clusters, and return to
/// them. What is put out goes to where all threads put theirs.
template <class Value>
class ClusterSlots {
 public:
  /// That of a cluster, new unless it was met not long ago. Calls put_out(cluster, value) for the one that it takes the
  /// place of.
  template <class PutOut>
  Value& at(std::uint32_t cluster, PutOut&& put_out) {
    Slot& slot = slots_[cluster * 0x9E3779B1U >> (32 - kBits)];
    if (slot.cluster != cluster) {
      if (slot.cluster != kNoCluster) put_out(slot.cluster, slot.value);
      slot = {cluster, {}};
    }
    return slot.value;
  }
  template <class PutOut>
  void put_all_out(PutOut&& put_out) {
    for (Slot& slot : slots_) {
      if (slot.cluster != kNoCluster) put_out(slot.cluster, slot.value);
      slot.cluster = kNoCluster;
    }
  }

 private:
  static constexpr int kBits = 7;
  struct Slot {
    std::uint32_t cluster = kNoCluster;
    Value value{};
  };
  std::array<Slot, std::size_t{1} << kBits> slots_;
};

}  // namespace arris::merge
