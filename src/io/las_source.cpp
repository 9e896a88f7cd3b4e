#include "io/las_source.h"

#include <fmt/format.h>

#include <algorithm>

#include "io/bytes.h"
#include "io/input_file.h"
#include "io/las_crs.h"
#include "io/las_extra_bytes.h"
#include "io/las_file.h"
#include "io/las_layout.h"
#include "io/read_limits.h"

namespace arris::io {
namespace {

/// Point formats 0 to 5 say overlap with a class.
constexpr unsigned kLegacyOverlapClass = 12;

class LasSource final : public PointSource {
 public:
  LasSource(std::shared_ptr<const InputFile> file, Tolerance tolerance)
      : file_(std::move(file)), las_(read_las_file(*file_, tolerance)) {
    const LasHeader& header = las_.header;
    info_.path = file_->path();
    info_.format = Format::kLas;
    info_.layout = fmt::format("LAS 1.{}, point format {}, {} bytes per point", header.minor, header.point_format,
                               header.record_bytes);
    info_.size_bytes = file_->size_bytes();
    info_.points = las_.points;
    info_.scaled_integers = true;
    info_.scale = header.scale;
    info_.offset = header.offset;
    info_.record_bytes = header.record_bytes;
    info_.problems = las_.problems;
    for (const Problem& problem : read_extra_bytes(*file_, las_).problems) info_.problems.push_back(problem);
    note_crs_problems(*file_, las_, info_.problems);
    info_.tolerance = tolerance;
    info_.modified_ns = file_->modified_ns();
  }

  const SourceInfo& info() const override { return info_; }
  void rewind() override { next_ = 0; }
  bool skip_to(std::uint64_t point) override {
    next_ = point;
    return true;
  }

  bool read(PointBatch& batch, const ReadOptions& options) override {
    const std::size_t count = batch_count(options.batch_points, las_.points - next_, info_.record_bytes);
    batch.first_id = next_;
    batch.count = count;
    for (auto* stored : {&batch.ix, &batch.iy, &batch.iz}) stored->resize(count);
    for (auto* world : {&batch.x, &batch.y, &batch.z}) world->clear();
    prepare_records(batch, options.records, info_.record_bytes);
    batch.excluded.assign(options.exclusion.any() ? count : 0, 0);
    if (count == 0) return false;
    const std::uint64_t begin = las_.header.offset_to_points + next_ * info_.record_bytes;
    if (options.records) {
      file_->read(begin, batch.records);
      decode(batch.records.data(), 0, count, batch);
      mark_excluded(options.exclusion, batch.records.data(), 0, batch, count);
    } else {
      read_coordinates(begin, options.exclusion, batch);
    }
    next_ += count;
    return true;
  }

 private:
  /// Reads in blocks that stay in the cache between the system's copy and the decoding.
  void read_coordinates(std::uint64_t begin, const PointExclusion& exclusion, PointBatch& batch) {
    const std::size_t block_points = std::max<std::size_t>(1, kReadBlockBytes / info_.record_bytes);
    block_.resize(std::min(block_points, batch.count) * info_.record_bytes);
    for (std::size_t first = 0; first < batch.count; first += block_points) {
      const std::size_t count = std::min(block_points, batch.count - first);
      file_->read(begin + first * info_.record_bytes, std::span(block_).first(count * info_.record_bytes));
      decode(block_.data(), first, count, batch);
      mark_excluded(exclusion, block_.data(), first, batch, count);
    }
  }

  void mark_excluded(const PointExclusion& exclusion, const std::byte* record, std::size_t first, PointBatch& batch,
                     std::size_t count) const {
    if (!exclusion.any()) return;
    const bool extended = is_extended_format(las_.header.point_format);
    const std::bitset<256> classes = exclusion.excluded_classes();
    for (std::size_t i = first; i < first + count; ++i, record += info_.record_bytes) {
      const auto packed = load<std::uint8_t>(record + 15);
      const unsigned label = extended ? load<std::uint8_t>(record + 16) : packed & 31U;
      unsigned flags = extended ? packed & 15U : packed >> 5;
      if (!extended && label == kLegacyOverlapClass) flags |= 8;
      batch.excluded[i] = (flags & exclusion.flags) != 0 || classes[label];
    }
  }

  void decode(const std::byte* record, std::size_t first, std::size_t count, PointBatch& batch) const {
    const std::size_t stride = info_.record_bytes;
    std::int32_t* ix = batch.ix.data() + first;
    std::int32_t* iy = batch.iy.data() + first;
    std::int32_t* iz = batch.iz.data() + first;
    for (std::size_t i = 0; i < count; ++i, record += stride) {
      ix[i] = load<std::int32_t>(record);
      iy[i] = load<std::int32_t>(record + 4);
      iz[i] = load<std::int32_t>(record + 8);
    }
  }

  std::shared_ptr<const InputFile> file_;
  LasFile las_;
  SourceInfo info_;
  std::uint64_t next_ = 0;  ///< Next point to deliver.
  std::vector<std::byte> block_;
};

}  // namespace

std::unique_ptr<PointSource> open_las_source(std::shared_ptr<const InputFile> file, Tolerance tolerance) {
  return std::make_unique<LasSource>(std::move(file), tolerance);
}

}  // namespace arris::io
