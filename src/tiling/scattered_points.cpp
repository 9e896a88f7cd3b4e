#include "tiling/scattered_points.h"

#include <algorithm>
#include <memory>
#include <numeric>
#include <tuple>
#include <utility>
#include <vector>

#include "tiling/morton.h"

namespace arris::tiling {
namespace {

using Steps = openvdb::math::Vec3<std::int32_t>;
using NullCodec = openvdb::points::NullCodec;
using PositionArray = openvdb::points::TypedAttributeArray<openvdb::Vec3f, NullCodec>;
using StepsArray = openvdb::points::TypedAttributeArray<Steps, NullCodec>;
using IdArray = openvdb::points::TypedAttributeArray<std::int64_t, NullCodec>;

constexpr const char* kSteps = "lattice";
constexpr std::size_t kPointsPerLeaf = 4096;  // What a leaf takes besides, 2.7 kB, is little then.
constexpr openvdb::Int32 kRow = 16;           // Leaves along a side of the node above them.

openvdb::Coord place_of(std::size_t leaf) {
  constexpr auto kSide = static_cast<openvdb::Int32>(PointLeaf::DIM);
  const auto n = static_cast<openvdb::Int32>(leaf);
  return {kSide * (n % kRow), kSide * (n / kRow % kRow), kSide * (n / (kRow * kRow))};
}

bool stands_before(const PointLeaf* a, const PointLeaf* b) {
  return std::tuple(a->origin().z(), a->origin().y(), a->origin().x()) <
         std::tuple(b->origin().z(), b->origin().y(), b->origin().x());
}

}  // namespace

std::vector<std::unique_ptr<PointLeaf>> list_scattered_points(std::span<const LatticePoint> positions,
                                                              std::span<const std::uint64_t> ids) {
  std::vector<std::uint32_t> order(positions.size());
  std::iota(order.begin(), order.end(), 0U);
  std::ranges::sort(order, [&](std::uint32_t a, std::uint32_t b) {
    return positions[a] == positions[b] ? ids[a] < ids[b] : z_order_less(positions[a], positions[b]);
  });
  const auto descriptor = openvdb::points::AttributeSet::Descriptor::create(PositionArray::attributeType())
                              ->duplicateAppend(kSteps, StepsArray::attributeType())
                              ->duplicateAppend("id", IdArray::attributeType());
  std::vector<std::unique_ptr<PointLeaf>> leaves;
  leaves.reserve(order.size() / kPointsPerLeaf + 1);
  for (std::size_t first = 0; first < order.size(); first += kPointsPerLeaf) {
    const auto points = std::span(order).subspan(first, std::min(kPointsPerLeaf, order.size() - first));
    const auto count = static_cast<openvdb::Index>(points.size());
    auto leaf = std::make_unique<PointLeaf>(place_of(first / kPointsPerLeaf));
    leaf->replaceAttributeSet(new openvdb::points::AttributeSet(descriptor, count),
                              /*allowMismatchingDescriptors=*/true);
    // All in the first voxel: offsets are the ends of the voxels' points.
    leaf->setOffsets(std::vector<PointLeaf::ValueType>(PointLeaf::SIZE, PointLeaf::ValueType(count)));
    openvdb::points::AttributeWriteHandle<Steps, NullCodec> steps(leaf->attributeArray(kSteps));
    openvdb::points::AttributeWriteHandle<std::int64_t, NullCodec> id(leaf->attributeArray("id"));
    for (openvdb::Index i = 0; i < count; ++i) {
      const LatticePoint& p = positions[points[i]];
      steps.set(i, Steps(p.x, p.y, p.z));
      id.set(i, static_cast<std::int64_t>(ids[points[i]]));
    }
    leaves.push_back(std::move(leaf));
  }
  return leaves;
}

bool lists_scattered_points(const PointLeaf& leaf) {
  return leaf.hasAttribute(kSteps);
}

SortedPoints take_scattered_points(std::vector<PointLeaf*> leaves,
                                   const std::function<bool(const LatticeBox&)>& wanted) {
  std::ranges::sort(leaves, stands_before);
  SortedPoints out;
  if (!wanted) {
    std::size_t points = 0;
    for (const PointLeaf* leaf : leaves) points += leaf->getLastValue();
    out.positions.reserve(points);
    out.ids.reserve(points);
  }
  for (PointLeaf* leaf : leaves) {
    const openvdb::points::AttributeHandle<Steps, NullCodec> steps(leaf->constAttributeArray(kSteps));
    const openvdb::points::AttributeHandle<std::int64_t, NullCodec> id(leaf->constAttributeArray("id"));
    const std::size_t before = out.positions.size();
    LatticeBox box;
    for (openvdb::Index i = 0; i < steps.size(); ++i) {
      const Steps p = steps.get(i);
      out.positions.push_back({p.x(), p.y(), p.z()});
      box.include(out.positions.back());
    }
    if (wanted && !wanted(box)) {
      out.positions.resize(before);
    } else {
      for (openvdb::Index i = 0; i < id.size(); ++i) out.ids.push_back(static_cast<std::uint64_t>(id.get(i)));
    }
    leaf->clearAttributes(false);  // Frees as it goes.
  }
  return out;
}

}  // namespace arris::tiling
