#include <fmt/format.h>
#include <openvdb/io/Stream.h>
#include <openvdb/openvdb.h>
#include <openvdb/points/PointDataGrid.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "core/error.h"
#include "core/pages.h"
#include "core/parallel.h"
#include "tiling/grid_backend.h"
#include "tiling/leaf_index.h"
#include "tiling/leaf_points.h"
#include "tiling/morton.h"
#include "tiling/scattered_points.h"

namespace arris::tiling {
namespace {

using openvdb::points::PointDataGrid;
using openvdb::points::PointDataTree;

constexpr int kLeafLog2 = 3;
/// Leaves take so much whatever they hold (the average of points that large leaves need is made for it), and so do the
/// nodes above them: 16^3 leaves, and 32^3 of those.
constexpr std::size_t kLeastPointsPerLeaf = 256;
constexpr std::size_t kLowerNodeBytes = 34'000;
constexpr std::size_t kUpperNodeBytes = 270'000;
constexpr int kLowerNodeLog2 = 4;
constexpr int kUpperNodeLog2 = 9;
/// Of a cloud around a corner where eight upper nodes meet, and on top of that per point.
constexpr std::size_t kFairNodeBytes = 3'000'000;
constexpr std::size_t kFairNodeBytesPerPoint = 4;
constexpr std::size_t kGrainLeaves = 16;
constexpr const char* kVoxelMeta = "storage_voxel_log2";

bool is_scattered(const LeafIndex& index, std::size_t points) {
  if (index.scattered()) return true;
  const std::size_t nodes =
      index.cubes(kLowerNodeLog2) * kLowerNodeBytes + index.cubes(kUpperNodeLog2) * kUpperNodeBytes;
  return nodes > kFairNodeBytes + points * kFairNodeBytesPerPoint;
}

std::int32_t to_steps(std::int32_t voxel, int log2) {
  return static_cast<std::int32_t>(std::int64_t{voxel} * (std::int64_t{1} << log2));
}

LatticeBox box_of(const PointLeaf& leaf, int log2) {
  LatticeBox box;
  for (int axis = 0; axis < 3; ++axis) {
    box.min[axis] = to_steps(leaf.origin()[axis], log2);
    box.max[axis] = box.min[axis] + (std::int64_t{PointLeaf::DIM} << log2);
  }
  return box;
}

/// Of a cloud that is not scattered.
std::vector<std::unique_ptr<PointLeaf>> make_leaves(std::span<const LatticePoint> positions,
                                                    std::span<const std::uint64_t> ids, LeafIndex& index, int log2) {
  PageVector<std::uint32_t> order;
  std::vector<std::uint32_t> begin;
  index.group(order, begin);
  const PointDescriptor::Ptr descriptor = leaf_descriptor();
  std::vector<std::unique_ptr<PointLeaf>> leaves(index.size());
  parallel_for_chunks(leaves.size(), kGrainLeaves, [&](std::size_t first, std::size_t last) {
    LeafWriter writer(descriptor, positions, ids, log2);
    for (std::size_t i = first; i < last; ++i) {
      leaves[i] = writer.make(index.origin(i), std::span(order).subspan(begin[i], begin[i + 1] - begin[i]));
    }
  });
  return leaves;
}

/// Frees the attributes of the leaves as it goes.
SortedPoints take_points(PointDataGrid& grid, const std::function<bool(const LatticeBox&)>& wanted) {
  const int log2 = grid.metaValue<std::int32_t>(kVoxelMeta);
  if (log2 < 0 || log2 > kFixedVoxelLog2) throw std::runtime_error("has an unknown storage voxel");

  std::vector<PointLeaf*> leaves;
  grid.tree().getNodes(leaves);
  if (!leaves.empty() && lists_scattered_points(*leaves.front()))
    return take_scattered_points(std::move(leaves), wanted);

  if (wanted) std::erase_if(leaves, [&](const PointLeaf* leaf) { return !wanted(box_of(*leaf, log2)); });
  std::ranges::sort(leaves, [](const PointLeaf* a, const PointLeaf* b) {
    const auto corner = [](const PointLeaf* leaf) {
      return LatticePoint{leaf->origin().x(), leaf->origin().y(), leaf->origin().z()};
    };
    return z_order_less(corner(a), corner(b));
  });
  std::vector<std::size_t> begin(leaves.size() + 1, 0);
  for (std::size_t i = 0; i < leaves.size(); ++i) begin[i + 1] = begin[i] + leaves[i]->getLastValue();

  SortedPoints out;
  out.positions.resize(begin.back());
  out.ids.resize(begin.back());
  parallel_for_chunks(leaves.size(), kGrainLeaves, [&](std::size_t first, std::size_t last) {
    LeafReader reader(log2);
    for (std::size_t i = first; i < last; ++i) {
      PointLeaf& leaf = *leaves[i];
      const std::size_t points = begin[i + 1] - begin[i];
      reader.read(leaf, std::span(out.positions).subspan(begin[i], points),
                  std::span(out.ids).subspan(begin[i], points));
      leaf.clearAttributes(false);  // Frees as it goes.
    }
  });
  return out;
}

class VdbGrid final : public StoredGrid {
 public:
  explicit VdbGrid(PointDataGrid::Ptr grid) : grid_(std::move(grid)) {}

  void write(std::ostream& stream) const override {
    openvdb::io::Stream archive(stream);
    archive.setCompression(openvdb::io::COMPRESS_ACTIVE_MASK);
    archive.setGridStatsMetadataEnabled(false);
    archive.write(openvdb::GridCPtrVec{grid_});
  }
  SortedPoints take_points() override { return tiling::take_points(*grid_, {}); }

 private:
  PointDataGrid::Ptr grid_;
};

class VdbBackend final : public GridBackend {
 public:
  std::unique_ptr<StoredGrid> make(std::span<const LatticePoint> positions, std::span<const std::uint64_t> ids,
                                   const std::map<std::string, std::string>& metadata) const override;
  SortedPoints read(std::istream& stream, const std::function<bool(const LatticeBox&)>& wanted) const override;
};

std::unique_ptr<StoredGrid> VdbBackend::make(std::span<const LatticePoint> positions,
                                             std::span<const std::uint64_t> ids,
                                             const std::map<std::string, std::string>& metadata) const {
  if (positions.size() >= 0xffffffffULL) {
    throw ConfigError(
        fmt::format("a tile of {} points is too large; use tiles of fewer than 2^32 points", positions.size()));
  }
  std::optional<LeafIndex> index(std::in_place, positions, kLeafLog2, kLeafLog2 + kFixedVoxelLog2,
                                 PointGrid::kPointsPerLeaf, kLeastPointsPerLeaf);
  const int log2 = index->level() - kLeafLog2;
  if (is_scattered(*index, positions.size())) index.reset();
  // Here alone: a tree's virtual functions are all compiled wherever one is made, and take long.
  auto tree = std::make_shared<PointDataTree>();
  auto leaves = index ? make_leaves(positions, ids, *index, log2) : list_scattered_points(positions, ids);
  for (auto& leaf : leaves) tree->addLeaf(leaf.release());
  auto grid = PointDataGrid::create(tree);
  grid->setName("points");
  // World space is lattice steps: the middle of a voxel of 2^v steps lies (2^v - 1) / 2 behind its first step.
  const double voxel = std::ldexp(1.0, log2);
  auto transform = openvdb::math::Transform::createLinearTransform(voxel);
  transform->postTranslate(openvdb::Vec3d((voxel - 1.0) / 2.0));
  grid->setTransform(transform);
  grid->insertMeta(kVoxelMeta, openvdb::Int32Metadata(log2));
  for (const auto& [name, value] : metadata) grid->insertMeta(name, openvdb::StringMetadata(value));
  return std::make_unique<VdbGrid>(std::move(grid));
}

SortedPoints VdbBackend::read(std::istream& stream, const std::function<bool(const LatticeBox&)>& wanted) const {
  const openvdb::GridPtrVecPtr grids = openvdb::io::Stream(stream, /*delayLoad=*/false).getGrids();
  if (!grids || grids->size() != 1) throw std::runtime_error("holds no single grid");
  const auto grid = openvdb::gridPtrCast<PointDataGrid>(grids->front());
  if (!grid) throw std::runtime_error("holds no points");
  grids->clear();
  return take_points(*grid, wanted);
}

}  // namespace

const GridBackend& vdb_backend() {
  static const VdbBackend backend = [] {
    openvdb::initialize();
    return VdbBackend();
  }();
  return backend;
}

}  // namespace arris::tiling
