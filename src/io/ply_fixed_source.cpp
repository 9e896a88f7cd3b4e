#include <algorithm>

#include "io/bytes.h"
#include "io/ply_body.h"
#include "io/ply_vertices.h"
#include "io/read_limits.h"

namespace arris::io {
namespace {

template <typename T, std::endian kOrder>
void decode_axis(const std::byte* at, std::size_t stride, std::size_t count, double* out) {
  for (std::size_t i = 0; i < count; ++i, at += stride) out[i] = static_cast<double>(load<T, kOrder>(at));
}

template <std::endian kOrder>
void decode_axis_of_type(ScalarType type, const std::byte* at, std::size_t stride, std::size_t count, double* out) {
  with_scalar_type(type, [&](auto zero) { decode_axis<decltype(zero), kOrder>(at, stride, count, out); });
}

/// Binary vertices without lists: records of fixed size, found by arithmetic.
class PlyFixedSource final : public PointSource {
 public:
  PlyFixedSource(std::shared_ptr<const InputFile> file, PlyHeader header, Tolerance tolerance)
      : file_(std::move(file)), header_(std::move(header)), info_(make_ply_info(*file_, header_, tolerance)) {
    info_.record_bytes = header_.vertices().least_bytes();
    begin_ = find_ply_element(*file_, header_, header_.vertex);
    salvage_vertices(*file_, header_, begin_, info_);
    if (info_.points == header_.vertices().count) {
      // Throws if the file is too short.
      note_short_elements(*file_, header_, skip_ply_element(*file_, header_, header_.vertex, begin_), info_);
    }
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto property = static_cast<std::size_t>(header_.vertices().find(kAxes[axis]));
      types_[axis] = header_.vertices().properties[property].type;
      for (std::size_t i = 0; i < property; ++i) offsets_[axis] += size_bytes(header_.vertices().properties[i].type);
    }
  }

  const SourceInfo& info() const override { return info_; }
  void rewind() override { next_ = 0; }

  bool read(PointBatch& batch, const ReadOptions& options) override {
    const std::size_t count = batch_count(options.batch_points, info_.points - next_, info_.record_bytes);
    start_ply_batch(batch, next_, count);
    prepare_records(batch, options.records, info_.record_bytes);
    if (count == 0) return false;
    const std::uint64_t begin = begin_ + next_ * info_.record_bytes;
    if (options.records) {
      file_->read(begin, batch.records);
      decode(batch.records.data(), 0, count, batch);
    } else {
      read_coordinates(begin, batch);
    }
    next_ += count;
    return true;
  }

 private:
  static constexpr std::array<const char*, 3> kAxes{"x", "y", "z"};

  void read_coordinates(std::uint64_t begin, PointBatch& batch) {
    const std::size_t block_points = std::max<std::size_t>(1, kReadBlockBytes / info_.record_bytes);
    block_.resize(std::min(block_points, batch.count) * info_.record_bytes);
    for (std::size_t first = 0; first < batch.count; first += block_points) {
      const std::size_t count = std::min(block_points, batch.count - first);
      file_->read(begin + first * info_.record_bytes, std::span(block_).first(count * info_.record_bytes));
      decode(block_.data(), first, count, batch);
    }
  }

  void decode(const std::byte* records, std::size_t first, std::size_t count, PointBatch& batch) const {
    const std::array<double*, 3> out{batch.x.data() + first, batch.y.data() + first, batch.z.data() + first};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::byte* at = records + offsets_[axis];
      if (header_.format == PlyFormat::kBigEndian) {
        decode_axis_of_type<std::endian::big>(types_[axis], at, info_.record_bytes, count, out[axis]);
      } else {
        decode_axis_of_type<std::endian::little>(types_[axis], at, info_.record_bytes, count, out[axis]);
      }
    }
  }

  std::shared_ptr<const InputFile> file_;
  PlyHeader header_;
  SourceInfo info_;
  std::uint64_t begin_ = 0;  ///< Offset in the file of the first vertex.
  std::array<ScalarType, 3> types_{};
  std::array<std::size_t, 3> offsets_{};
  std::uint64_t next_ = 0;
  std::vector<std::byte> block_;
};

}  // namespace

std::unique_ptr<PointSource> open_ply_fixed_source(std::shared_ptr<const InputFile> file, PlyHeader header,
                                                   Tolerance tolerance) {
  return std::make_unique<PlyFixedSource>(std::move(file), std::move(header), tolerance);
}

}  // namespace arris::io
