#include "tiling/point_grid.h"

#include <fmt/format.h>
#include <openvdb/io/Stream.h>
#include <openvdb/openvdb.h>
#include <openvdb/points/PointDataGrid.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>
#include <numeric>
#include <optional>
#include <utility>

#include "core/error.h"
#include "core/pages.h"
#include "core/parallel.h"
#include "tiling/leaf_index.h"
#include "tiling/morton.h"
#include "tiling/scattered_points.h"

namespace arris::tiling {
namespace {

using openvdb::points::PointDataGrid;
using openvdb::points::PointDataTree;
using Leaf = PointDataTree::LeafNodeType;
using Descriptor = openvdb::points::AttributeSet::Descriptor;
using FixedCodec = openvdb::points::FixedPointCodec<false, openvdb::points::PositionRange>;
using IdArray = openvdb::points::TypedAttributeArray<std::int64_t>;

constexpr int kLeafLog2 = 3;
constexpr int kFixedVoxelLog2 = 13;  // Above, 16 bits cannot tell the steps of a voxel apart safely.
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
constexpr openvdb::Index kVoxels = 512;

void initialize_openvdb() {
  static std::once_flag once;
  std::call_once(once, [] { openvdb::initialize(); });
}

/// Position within a voxel of 2^log2 steps as OpenVDB stores it, in [-0.5, 0.5): the middle of the step, so that the
/// codec's truncation cannot reach the next one.
class StepCodec {
 public:
  explicit StepCodec(int log2) : steps_(std::ldexp(1.0F, log2)), per_step_(std::ldexp(1.0F, -log2)) {}
  float encode(std::int32_t step) const { return (static_cast<float>(step) + 0.5F) * per_step_ - 0.5F; }
  std::int32_t decode(float position) const { return static_cast<std::int32_t>((position + 0.5F) * steps_); }

 private:
  float steps_, per_step_;  // Powers of two: every product is exact.
};

/// Order of a leaf's points by voxel (counting sort) with the offsets that OpenVDB keeps.
class VoxelOrder {
 public:
  void sort(std::span<const LatticePoint> positions, std::span<const std::uint32_t> points, int log2) {
    voxel_.resize(points.size());
    sorted_.resize(points.size());
    offsets_.assign(kVoxels, 0);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const LatticePoint& p = positions[points[i]];
      voxel_[i] = static_cast<std::uint16_t>((p.x >> log2 & 7) << 6 | (p.y >> log2 & 7) << 3 | (p.z >> log2 & 7));
      offsets_[voxel_[i]] = offsets_[voxel_[i]] + 1;
    }
    std::array<std::uint32_t, kVoxels> next{};
    std::uint32_t sum = 0;
    for (std::size_t v = 0; v < kVoxels; ++v) {
      next[v] = sum;
      sum += offsets_[v];
      offsets_[v] = sum;
    }
    for (std::size_t i = 0; i < points.size(); ++i) sorted_[next[voxel_[i]]++] = points[i];
  }
  const std::vector<Leaf::ValueType>& offsets() const { return offsets_; }
  const std::vector<std::uint32_t>& sorted() const { return sorted_; }

 private:
  std::vector<std::uint16_t> voxel_;
  std::vector<std::uint32_t> sorted_;
  std::vector<Leaf::ValueType> offsets_;
};

void write_positions(Leaf& leaf, std::span<const LatticePoint> positions, const std::vector<std::uint32_t>& order,
                     int log2) {
  openvdb::points::AttributeWriteHandle<openvdb::Vec3f, FixedCodec> handle(leaf.attributeArray("P"));
  const StepCodec codec(log2);
  const std::int32_t mask = (std::int32_t{1} << log2) - 1;
  for (std::size_t i = 0; i < order.size(); ++i) {
    const LatticePoint& p = positions[order[i]];
    handle.set(static_cast<openvdb::Index>(i),
               openvdb::Vec3f(codec.encode(p.x & mask), codec.encode(p.y & mask), codec.encode(p.z & mask)));
  }
}

bool is_scattered(const LeafIndex& index, std::size_t points) {
  if (index.scattered()) return true;
  const std::size_t nodes =
      index.cubes(kLowerNodeLog2) * kLowerNodeBytes + index.cubes(kUpperNodeLog2) * kUpperNodeBytes;
  return nodes > kFairNodeBytes + points * kFairNodeBytesPerPoint;
}

/// A point of a leaf on its way back: the Z-order key of its position in the leaf, and its id.
using KeyedId = std::pair<std::uint64_t, std::uint64_t>;

/// The voxels of a leaf in Z-order.
const std::array<std::uint16_t, kVoxels>& voxels_in_z_order() {
  static const std::array<std::uint16_t, kVoxels> order = [] {
    std::array<std::uint16_t, kVoxels> voxels{};
    std::iota(voxels.begin(), voxels.end(), std::uint16_t{0});
    std::ranges::sort(voxels, {}, [](std::uint16_t v) { return z_key(v >> 6, v >> 3 & 7U, v & 7U); });
    return voxels;
  }();
  return order;
}

/// Fills `points` with the leaf's points in Z-order, equal positions by ascending id.
void read_leaf(const Leaf& leaf, int log2, std::vector<KeyedId>& points) {
  const openvdb::points::AttributeHandle<openvdb::Vec3f, FixedCodec> positions(leaf.constAttributeArray("P"));
  const openvdb::points::AttributeHandle<std::int64_t, openvdb::points::NullCodec> ids(leaf.constAttributeArray("id"));
  const StepCodec codec(log2);
  points.clear();
  for (const openvdb::Index voxel : voxels_in_z_order()) {
    const openvdb::Index begin = voxel == 0 ? 0 : openvdb::Index{leaf.getValue(voxel - 1)}, end = leaf.getValue(voxel);
    if (begin == end) continue;
    const auto vx = static_cast<std::int32_t>(voxel >> 6), vy = static_cast<std::int32_t>(voxel >> 3 & 7),
               vz = static_cast<std::int32_t>(voxel & 7);
    for (openvdb::Index i = begin; i < end; ++i) {
      const openvdb::Vec3f p = positions.get(i);
      const std::uint64_t key = z_key(static_cast<std::uint32_t>((vx << log2) + codec.decode(p.x())),
                                      static_cast<std::uint32_t>((vy << log2) + codec.decode(p.y())),
                                      static_cast<std::uint32_t>((vz << log2) + codec.decode(p.z())));
      points.emplace_back(key, static_cast<std::uint64_t>(ids.get(i)));
    }
    std::sort(points.end() - (end - begin), points.end());
  }
}

std::int32_t to_steps(std::int32_t voxel, int log2) {
  return static_cast<std::int32_t>(std::int64_t{voxel} * (std::int64_t{1} << log2));
}

LatticeBox box_of(const Leaf& leaf, int log2) {
  LatticeBox box;
  for (int axis = 0; axis < 3; ++axis) {
    box.min[axis] = to_steps(leaf.origin()[axis], log2);
    box.max[axis] = box.min[axis] + (std::int64_t{Leaf::DIM} << log2);
  }
  return box;
}

/// The tree of a cloud that is not scattered.
PointDataTree::Ptr make_tree(std::span<const LatticePoint> positions, std::span<const std::uint64_t> ids,
                             const LeafIndex& index, int log2) {
  PageVector<std::uint32_t> order;
  std::vector<std::uint32_t> begin;
  index.group(positions, order, begin);
  const auto descriptor =
      Descriptor::create(openvdb::points::TypedAttributeArray<openvdb::Vec3f, FixedCodec>::attributeType())
          ->duplicateAppend("id", IdArray::attributeType());
  std::vector<std::unique_ptr<Leaf>> leaves(index.size());
  parallel_for_chunks(leaves.size(), kGrainLeaves, [&](std::size_t first, std::size_t last) {
    VoxelOrder voxels;
    for (std::size_t i = first; i < last; ++i) {
      const auto points = std::span(order).subspan(begin[i], begin[i + 1] - begin[i]);
      const LatticePoint origin = index.origin(i);
      auto leaf = std::make_unique<Leaf>(openvdb::Coord(origin.x >> log2, origin.y >> log2, origin.z >> log2));
      leaf->replaceAttributeSet(
          new openvdb::points::AttributeSet(descriptor, static_cast<openvdb::Index>(points.size())),
          /*allowMismatchingDescriptors=*/true);
      voxels.sort(positions, points, log2);
      leaf->setOffsets(voxels.offsets());
      write_positions(*leaf, positions, voxels.sorted(), log2);
      openvdb::points::AttributeWriteHandle<std::int64_t, openvdb::points::NullCodec> id(leaf->attributeArray("id"));
      for (std::size_t n = 0; n < points.size(); ++n) {
        id.set(static_cast<openvdb::Index>(n), static_cast<std::int64_t>(ids[voxels.sorted()[n]]));
      }
      leaves[i] = std::move(leaf);
    }
  });
  auto tree = std::make_shared<PointDataTree>();
  for (auto& leaf : leaves) tree->addLeaf(leaf.release());
  return tree;
}

/// Frees the attributes of the leaves as it goes.
SortedPoints take_points(PointDataGrid& grid, const std::function<bool(const LatticeBox&)>& wanted) {
  const int log2 = grid.metaValue<std::int32_t>(kVoxelMeta);
  if (log2 < 0 || log2 > kFixedVoxelLog2) throw std::runtime_error("has an unknown storage voxel");

  if (lists_scattered_points(grid.tree())) return take_scattered_points(grid.tree(), wanted);

  std::vector<Leaf*> leaves;
  grid.tree().getNodes(leaves);
  if (wanted) std::erase_if(leaves, [&](const Leaf* leaf) { return !wanted(box_of(*leaf, log2)); });
  std::ranges::sort(leaves, [](const Leaf* a, const Leaf* b) {
    const auto corner = [](const Leaf* leaf) {
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
    std::vector<KeyedId> points;
    for (std::size_t i = first; i < last; ++i) {
      Leaf& leaf = *leaves[i];
      read_leaf(leaf, log2, points);
      const openvdb::Coord& corner = leaf.origin();
      for (std::size_t n = 0; n < points.size(); ++n) {
        const std::uint64_t key = points[n].first;
        out.positions[begin[i] + n] = {to_steps(corner.x(), log2) + static_cast<std::int32_t>(gather_bits(key >> 2)),
                                       to_steps(corner.y(), log2) + static_cast<std::int32_t>(gather_bits(key >> 1)),
                                       to_steps(corner.z(), log2) + static_cast<std::int32_t>(gather_bits(key))};
        out.ids[begin[i] + n] = points[n].second;
      }
      leaf.clearAttributes(false);  // Frees as it goes.
    }
  });
  return out;
}

}  // namespace

struct PointGrid::Impl {
  PointDataGrid::Ptr grid;
};

PointGrid::PointGrid(std::span<const LatticePoint> positions, std::span<const std::uint64_t> ids,
                     const std::map<std::string, std::string>& metadata)
    : impl_(std::make_unique<Impl>()) {
  if (positions.size() >= 0xffffffffULL) {
    throw ConfigError(
        fmt::format("a tile of {} points is too large; use tiles of fewer than 2^32 points", positions.size()));
  }
  initialize_openvdb();
  std::optional<LeafIndex> index(std::in_place, positions, kLeafLog2, kLeafLog2 + kFixedVoxelLog2, kPointsPerLeaf,
                                 kLeastPointsPerLeaf);
  const int log2 = index->level() - kLeafLog2;
  if (is_scattered(*index, positions.size())) index.reset();
  const auto tree = index ? make_tree(positions, ids, *index, log2) : list_scattered_points(positions, ids);
  impl_->grid = PointDataGrid::create(tree);
  impl_->grid->setName("points");
  // World space is lattice steps: the middle of a voxel of 2^v steps lies (2^v - 1) / 2 behind its first step.
  const double voxel = std::ldexp(1.0, log2);
  auto transform = openvdb::math::Transform::createLinearTransform(voxel);
  transform->postTranslate(openvdb::Vec3d((voxel - 1.0) / 2.0));
  impl_->grid->setTransform(transform);
  impl_->grid->insertMeta(kVoxelMeta, openvdb::Int32Metadata(log2));
  for (const auto& [name, value] : metadata) impl_->grid->insertMeta(name, openvdb::StringMetadata(value));
}

PointGrid::~PointGrid() = default;

void PointGrid::write(std::ostream& stream) const {
  openvdb::io::Stream archive(stream);
  archive.setCompression(openvdb::io::COMPRESS_ACTIVE_MASK);
  archive.setGridStatsMetadataEnabled(false);
  archive.write(openvdb::GridCPtrVec{impl_->grid});
}

SortedPoints PointGrid::take_points() && {
  return tiling::take_points(*impl_->grid, {});
}

SortedPoints read_point_grid(std::istream& stream, const std::function<bool(const LatticeBox&)>& wanted) {
  initialize_openvdb();
  const openvdb::GridPtrVecPtr grids = openvdb::io::Stream(stream, /*delayLoad=*/false).getGrids();
  if (!grids || grids->size() != 1) throw std::runtime_error("holds no single grid");
  const auto grid = openvdb::gridPtrCast<PointDataGrid>(grids->front());
  if (!grid) throw std::runtime_error("holds no points");
  grids->clear();
  return take_points(*grid, wanted);
}

}  // namespace arris::tiling
