#pragma once
/// @file The points of one leaf of an OpenVDB point grid: lattice positions as 16-bit fixed point in voxels, and ids.
///
/// Nothing here shares anything: leaves may be written and read at a time.

#include <openvdb/points/PointDataGrid.h>

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/lattice.h"

namespace arris::tiling {

using PointLeaf = openvdb::points::PointDataTree::LeafNodeType;
using PointDescriptor = openvdb::points::AttributeSet::Descriptor;

/// Above, 16 bits cannot tell the steps of a voxel apart safely.
constexpr int kFixedVoxelLog2 = 13;

/// Of leaves with the attributes "P" and "id".
PointDescriptor::Ptr leaf_descriptor();

/// Makes leaves of points, with the memory of the leaf before.
class LeafWriter {
 public:
  /// @param log2  voxels are 2^log2 steps, at most kFixedVoxelLog2.
  LeafWriter(PointDescriptor::Ptr descriptor, std::span<const LatticePoint> positions,
             std::span<const std::uint64_t> ids, int log2)
      : descriptor_(std::move(descriptor)), positions_(positions), ids_(ids), log2_(log2) {}

  /// @param corner  in steps: the least of the leaf of 8^3 voxels.
  /// @param points  of positions and ids, all of them in the leaf.
  std::unique_ptr<PointLeaf> make(const LatticePoint& corner, std::span<const std::uint32_t> points);

 private:
  void sort_by_voxel(std::span<const std::uint32_t> points);
  void write_positions(PointLeaf& leaf) const;

  PointDescriptor::Ptr descriptor_;
  std::span<const LatticePoint> positions_;
  std::span<const std::uint64_t> ids_;
  int log2_;
  std::vector<std::uint16_t> voxel_;
  std::vector<std::uint32_t> sorted_;
  std::vector<PointLeaf::ValueType> offsets_;  // As OpenVDB keeps them: the end of each voxel's points.
};

/// Reads leaves that LeafWriter made.
class LeafReader {
 public:
  /// @param log2  as they were made.
  explicit LeafReader(int log2) : log2_(log2) {}

  /// The leaf's points in Z-order of positions (morton.h), equal positions by ascending id. Throws std::exception if
  /// its attributes are others.
  /// @param positions, ids  as many as the leaf has.
  void read(const PointLeaf& leaf, std::span<LatticePoint> positions, std::span<std::uint64_t> ids);

 private:
  /// Fills order_ with the places of a voxel's keys in their order, equal ones in any.
  void sort(std::span<const std::uint64_t> keys);
  void sort_by_parts(std::span<const std::uint64_t> keys);

  int log2_;
  std::vector<std::uint64_t> keys_;   // Z-order keys of positions in their voxels.
  std::vector<std::int64_t> packed_;  // Key and place of each point of a voxel.
  std::vector<std::uint32_t> parts_;
  std::vector<std::uint32_t> order_;  // Of the points of a voxel.
};

}  // namespace arris::tiling
