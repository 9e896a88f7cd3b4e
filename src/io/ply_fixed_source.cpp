#include <algorithm>
#include <optional>

#include "io/bytes.h"
#include "io/ply_body.h"
#include "io/ply_field_names.h"
#include "io/ply_vertices.h"
#include "io/read_limits.h"

namespace arris::io {
namespace {

template <typename T, std::endian kOrder>
void decode_column(const std::byte* at, std::size_t stride, std::size_t count, double* out) {
  for (std::size_t i = 0; i < count; ++i, at += stride) out[i] = static_cast<double>(load<T, kOrder>(at));
}

template <std::endian kOrder>
void decode_column_of_type(ScalarType type, const std::byte* at, std::size_t stride, std::size_t count, double* out) {
  with_scalar_type(type, [&](auto zero) { decode_column<decltype(zero), kOrder>(at, stride, count, out); });
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
    for (std::size_t axis = 0; axis < 3; ++axis) axes_[axis] = column(header_.vertices().find(kAxes[axis]));
    if (info_.has_classes) classes_ = column(find_ply_field(header_.vertices(), "classification"));
  }

  const SourceInfo& info() const override { return info_; }
  void rewind() override { next_ = 0; }
  bool skip_to(std::uint64_t point) override {
    next_ = point;
    return true;
  }

  bool read(PointBatch& batch, const ReadOptions& options) override {
    const std::size_t count = batch_count(options.batch_points, info_.points - next_, info_.record_bytes);
    start_ply_batch(batch, next_, count, options.exclusion);
    prepare_records(batch, options.records, info_.record_bytes);
    if (count == 0) return false;
    const std::uint64_t begin = begin_ + next_ * info_.record_bytes;
    if (options.records) {
      file_->read(begin, batch.records);
      decode(batch.records.data(), 0, count, batch);
      exclude(options.exclusion, batch.records.data(), 0, count, batch);
    } else {
      read_coordinates(begin, options.exclusion, batch);
    }
    next_ += count;
    return true;
  }

 private:
  static constexpr std::array<const char*, 3> kAxes{"x", "y", "z"};

  struct Column {
    ScalarType type = ScalarType::kFloat64;
    std::size_t offset = 0;  ///< In the record.
  };

  Column column(int property) const {
    const std::vector<PlyProperty>& properties = header_.vertices().properties;
    Column column{properties[static_cast<std::size_t>(property)].type, 0};
    for (int i = 0; i < property; ++i) column.offset += size_bytes(properties[static_cast<std::size_t>(i)].type);
    return column;
  }

  void read_coordinates(std::uint64_t begin, const PointExclusion& exclusion, PointBatch& batch) {
    const std::size_t block_points = std::max<std::size_t>(1, kReadBlockBytes / info_.record_bytes);
    block_.resize(std::min(block_points, batch.count) * info_.record_bytes);
    for (std::size_t first = 0; first < batch.count; first += block_points) {
      const std::size_t count = std::min(block_points, batch.count - first);
      file_->read(begin + first * info_.record_bytes, std::span(block_).first(count * info_.record_bytes));
      decode(block_.data(), first, count, batch);
      exclude(exclusion, block_.data(), first, count, batch);
    }
  }

  void exclude(const PointExclusion& exclusion, const std::byte* records, std::size_t first, std::size_t count,
               PointBatch& batch) {
    if (exclusion.only_classes.none() || !classes_) return;
    labels_.resize(count);
    decode(*classes_, records, count, labels_.data());
    mark_excluded(exclusion, labels_, first, batch);
  }

  void decode(const std::byte* records, std::size_t first, std::size_t count, PointBatch& batch) const {
    const std::array<double*, 3> out{batch.x.data() + first, batch.y.data() + first, batch.z.data() + first};
    for (std::size_t axis = 0; axis < 3; ++axis) decode(axes_[axis], records, count, out[axis]);
  }

  void decode(const Column& column, const std::byte* records, std::size_t count, double* out) const {
    const std::byte* at = records + column.offset;
    if (header_.format == PlyFormat::kBigEndian) {
      decode_column_of_type<std::endian::big>(column.type, at, info_.record_bytes, count, out);
    } else {
      decode_column_of_type<std::endian::little>(column.type, at, info_.record_bytes, count, out);
    }
  }

  std::shared_ptr<const InputFile> file_;
  PlyHeader header_;
  SourceInfo info_;
  std::uint64_t begin_ = 0;  ///< Offset in the file of the first vertex.
  std::array<Column, 3> axes_{};
  std::optional<Column> classes_;
  std::uint64_t next_ = 0;
  std::vector<std::byte> block_;
  std::vector<double> labels_;  ///< Classifications of a block.
};

}  // namespace

std::unique_ptr<PointSource> open_ply_fixed_source(std::shared_ptr<const InputFile> file, PlyHeader header,
                                                   Tolerance tolerance) {
  return std::make_unique<PlyFixedSource>(std::move(file), std::move(header), tolerance);
}

}  // namespace arris::io
