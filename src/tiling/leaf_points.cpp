#include "tiling/leaf_points.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <numeric>
#include <stdexcept>

#include "core/avx2.h"
#include "tiling/morton.h"

namespace arris::tiling {
namespace {

using FixedCodec = openvdb::points::FixedPointCodec<false, openvdb::points::PositionRange>;
using PositionArray = openvdb::points::TypedAttributeArray<openvdb::Vec3f, FixedCodec>;
using FixedPosition = PositionArray::StorageType;
using IdArray = openvdb::points::TypedAttributeArray<std::int64_t>;

constexpr openvdb::Index kVoxels = 512;
constexpr int kFixedBits = 16;
constexpr std::size_t kBatch = 128;
/// Keys of 3 * 13 bits leave room for the places of so many points.
constexpr int kPlaceBits = 16;
constexpr std::size_t kLanes = 4;
/// As many are sorted by counting.
constexpr std::size_t kMostRanked = 32;
/// More are dealt to parts of the voxel first, up to 8^4 of them.
constexpr std::size_t kPointsPerPart = 8;
constexpr int kMostPartLevels = 4;

/// Position within a voxel of 2^log2 steps as OpenVDB stores it, in [-0.5, 0.5): the middle of the step, so that the
/// codec's truncation cannot reach the next one, whether a reader divides by 65535 or takes the topmost bits.
class StepCodec {
 public:
  explicit StepCodec(int log2) : per_step_(std::ldexp(1.0F, -log2)) {}
  float encode(std::int32_t step) const { return (static_cast<float>(step) + 0.5F) * per_step_ - 0.5F; }

 private:
  float per_step_;  // A power of two: the product is exact.
};

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

/// Whole arrays: the loop that spreads bits vectorises.
__attribute__((always_inline)) inline void find_keys(const FixedPosition* fixed, int shift,
                                                     std::span<std::uint64_t> keys) {
  std::array<std::uint32_t, kBatch> x{}, y{}, z{};
  std::array<std::uint64_t, kBatch> key{};
  for (std::size_t begin = 0; begin < keys.size(); begin += kBatch) {
    const std::size_t count = std::min(kBatch, keys.size() - begin);
    for (std::size_t i = 0; i < count; ++i) {
      x[i] = std::uint32_t{fixed[begin + i].x()} >> shift;
      y[i] = std::uint32_t{fixed[begin + i].y()} >> shift;
      z[i] = std::uint32_t{fixed[begin + i].z()} >> shift;
    }
    for (std::size_t i = 0; i < kBatch; ++i) key[i] = z_key(x[i], y[i], z[i]);
    std::copy_n(key.begin(), count, keys.begin() + static_cast<std::ptrdiff_t>(begin));
  }
}

#if ARRIS_AVX2_VERSIONS
__attribute__((target("avx2"))) void find_keys_avx2(const FixedPosition* fixed, int shift,
                                                    std::span<std::uint64_t> keys) {
  find_keys(fixed, shift, keys);
}
#endif

/// order[n] = place of the n-th of the packed keys in ascending order, by counting for each how many are below it:
/// no branch to be guessed, and the loops vectorise. All differ and are below 2^63.
/// @param packed  kLanes - 1 more than `count`, whatever they are.
__attribute__((always_inline)) inline void rank(const std::int64_t* packed, std::size_t count, std::uint32_t* order) {
  typedef std::int64_t Lanes __attribute__((vector_size(kLanes * sizeof(std::int64_t))));
  for (std::size_t begin = 0; begin < count; begin += kLanes) {
    Lanes keys, below{};
    std::memcpy(&keys, packed + begin, sizeof(keys));
    for (std::size_t other = 0; other < count; ++other) below -= packed[other] < keys;
    const std::size_t lanes = std::min(kLanes, count - begin);
    for (std::size_t lane = 0; lane < lanes; ++lane) order[below[lane]] = static_cast<std::uint32_t>(begin + lane);
  }
}

#if ARRIS_AVX2_VERSIONS
__attribute__((target("avx2"))) void rank_avx2(const std::int64_t* packed, std::size_t count, std::uint32_t* order) {
  rank(packed, count, order);
}
#endif

void rank_keys(const std::int64_t* packed, std::size_t count, std::uint32_t* order) {
#if ARRIS_AVX2_VERSIONS
  if (may_use_avx2()) return rank_avx2(packed, count, order);
#endif
  rank(packed, count, order);
}

/// @param shift  from fixed point to steps.
void find_keys_of(const FixedPosition* fixed, int shift, std::span<std::uint64_t> keys) {
#if ARRIS_AVX2_VERSIONS
  if (may_use_avx2()) return find_keys_avx2(fixed, shift, keys);
#endif
  find_keys(fixed, shift, keys);
}

/// The values of an attribute, one for each of `count` points. Throws if it is of another kind.
template <class Array>
const typename Array::StorageType* values_of(const PointLeaf& leaf, const char* name, std::size_t count) {
  const openvdb::points::AttributeArray& attribute = leaf.constAttributeArray(name);
  if (!attribute.isType<Array>()) throw std::runtime_error("has an attribute of another kind");
  const Array& array = Array::cast(attribute);
  if (array.size() != count || (array.isUniform() && count > 1)) {
    throw std::runtime_error("has not as many values as points");
  }
  return array.constData();
}

std::uint32_t place_of(std::int64_t packed) {
  return static_cast<std::uint32_t>(packed) & ((1U << kPlaceBits) - 1);
}

void sort_ids_of_equals(std::span<const LatticePoint> positions, std::span<std::uint64_t> ids) {
  for (std::size_t begin = 0, end = 0; begin < positions.size(); begin = end) {
    end = begin + 1;
    while (end < positions.size() && positions[end] == positions[begin]) ++end;
    if (end - begin > 1) std::ranges::sort(ids.subspan(begin, end - begin));
  }
}

}  // namespace

PointDescriptor::Ptr leaf_descriptor() {
  return PointDescriptor::create(PositionArray::attributeType())->duplicateAppend("id", IdArray::attributeType());
}

std::unique_ptr<PointLeaf> LeafWriter::make(const LatticePoint& corner, std::span<const std::uint32_t> points) {
  auto leaf = std::make_unique<PointLeaf>(openvdb::Coord(corner.x >> log2_, corner.y >> log2_, corner.z >> log2_));
  leaf->replaceAttributeSet(new openvdb::points::AttributeSet(descriptor_, static_cast<openvdb::Index>(points.size())),
                            /*allowMismatchingDescriptors=*/true);
  sort_by_voxel(points);
  leaf->setOffsets(offsets_);
  write_positions(*leaf);
  openvdb::points::AttributeWriteHandle<std::int64_t, openvdb::points::NullCodec> id(leaf->attributeArray("id"));
  for (std::size_t n = 0; n < sorted_.size(); ++n) {
    id.set(static_cast<openvdb::Index>(n), static_cast<std::int64_t>(ids_[sorted_[n]]));
  }
  return leaf;
}

void LeafWriter::sort_by_voxel(std::span<const std::uint32_t> points) {
  voxel_.resize(points.size());
  sorted_.resize(points.size());
  offsets_.assign(kVoxels, 0);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const LatticePoint& p = positions_[points[i]];
    voxel_[i] = static_cast<std::uint16_t>((p.x >> log2_ & 7) << 6 | (p.y >> log2_ & 7) << 3 | (p.z >> log2_ & 7));
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

void LeafWriter::write_positions(PointLeaf& leaf) const {
  openvdb::points::AttributeWriteHandle<openvdb::Vec3f, FixedCodec> handle(leaf.attributeArray("P"));
  const StepCodec codec(log2_);
  const std::int32_t mask = (std::int32_t{1} << log2_) - 1;
  for (std::size_t i = 0; i < sorted_.size(); ++i) {
    const LatticePoint& p = positions_[sorted_[i]];
    handle.set(static_cast<openvdb::Index>(i),
               openvdb::Vec3f(codec.encode(p.x & mask), codec.encode(p.y & mask), codec.encode(p.z & mask)));
  }
}

void LeafReader::read(const PointLeaf& leaf, std::span<LatticePoint> positions, std::span<std::uint64_t> ids) {
  const FixedPosition* const fixed = values_of<PositionArray>(leaf, "P", positions.size());
  const std::int64_t* const stored_ids = values_of<IdArray>(leaf, "id", positions.size());
  const int shift = kFixedBits - log2_;
  keys_.resize(positions.size());
  find_keys_of(fixed, shift, keys_);
  const auto to_steps = [&](std::int64_t voxel) {
    return static_cast<std::int32_t>(voxel * (std::int64_t{1} << log2_));
  };
  std::size_t out = 0;
  bool any_equal = false;
  for (const openvdb::Index voxel : voxels_in_z_order()) {
    const openvdb::Index begin = voxel == 0 ? 0 : openvdb::Index{leaf.getValue(voxel - 1)}, end = leaf.getValue(voxel);
    if (begin == end) continue;
    if (begin > end || end > keys_.size()) throw std::runtime_error("has voxels out of order");
    const LatticePoint corner{to_steps(leaf.origin().x() + static_cast<std::int32_t>(voxel >> 6)),
                              to_steps(leaf.origin().y() + static_cast<std::int32_t>(voxel >> 3 & 7)),
                              to_steps(leaf.origin().z() + static_cast<std::int32_t>(voxel & 7))};
    sort(std::span(keys_).subspan(begin, end - begin));
    for (const std::uint32_t place : order_) {
      const FixedPosition& p = fixed[begin + place];
      positions[out] = {corner.x + (p.x() >> shift), corner.y + (p.y() >> shift), corner.z + (p.z() >> shift)};
      ids[out] = static_cast<std::uint64_t>(stored_ids[begin + place]);
      any_equal |= out > 0 && positions[out] == positions[out - 1];
      ++out;
    }
  }
  if (any_equal) sort_ids_of_equals(positions, ids);
}

void LeafReader::sort(std::span<const std::uint64_t> keys) {
  const std::size_t count = keys.size();
  order_.resize(count);
  if (count > std::size_t{1} << kPlaceBits) {
    std::iota(order_.begin(), order_.end(), 0U);
    std::ranges::sort(order_, {}, [&](std::uint32_t place) { return keys[place]; });
    return;
  }
  packed_.resize(count + kLanes);
  if (count <= kMostRanked) {
    for (std::size_t i = 0; i < count; ++i) packed_[i] = static_cast<std::int64_t>(keys[i] << kPlaceBits | i);
    rank_keys(packed_.data(), count, order_.data());
    return;
  }
  sort_by_parts(keys);
}

void LeafReader::sort_by_parts(std::span<const std::uint64_t> keys) {
  const std::size_t count = keys.size();
  // Surfaces fill a quarter of the parts, or less.
  int levels = std::min(1, log2_);
  while (levels < std::min(log2_, kMostPartLevels) && kPointsPerPart << 2 * levels < count) ++levels;
  const int shift = 3 * (log2_ - levels);
  parts_.assign((std::size_t{1} << 3 * levels) + 1, 0);
  for (const std::uint64_t key : keys) ++parts_[(key >> shift) + 1];
  std::partial_sum(parts_.begin(), parts_.end(), parts_.begin());
  for (std::size_t i = 0; i < count; ++i) {  // Leaves the end of each part in its place.
    packed_[parts_[keys[i] >> shift]++] = static_cast<std::int64_t>(keys[i] << kPlaceBits | i);
  }
  std::size_t begin = 0;
  for (const std::uint32_t end : parts_) {
    if (end - begin > kMostRanked) {
      std::sort(packed_.begin() + static_cast<std::ptrdiff_t>(begin),
                packed_.begin() + static_cast<std::ptrdiff_t>(end));
      for (std::size_t i = begin; i < end; ++i) order_[i] = place_of(packed_[i]);
    } else if (end > begin) {
      std::array<std::uint32_t, kMostRanked> order;
      rank_keys(packed_.data() + begin, end - begin, order.data());
      for (std::size_t i = begin; i < end; ++i) order_[i] = place_of(packed_[begin + order[i - begin]]);
    }
    begin = end;
  }
}

}  // namespace arris::tiling
