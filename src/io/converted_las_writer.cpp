#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>

#include "core/error.h"
#include "core/text.h"
#include "io/bytes.h"
#include "io/carried_records.h"
#include "io/column_ranges.h"
#include "io/crs_sharing.h"
#include "io/kept_writers.h"
#include "io/las_conversion.h"
#include "io/las_extra_bytes.h"
#include "io/las_file.h"
#include "io/las_grid.h"
#include "io/las_layout.h"
#include "io/las_sharing.h"
#include "io/las_totals.h"
#include "io/ply_header.h"
#include "io/ply_output.h"

namespace arris::io {
namespace {

WorldExtent measure(const std::vector<SourceInfo>& inputs) {
  WorldExtent extent;
  PointBatch batch;
  for (const SourceInfo& input : inputs) {
    const auto source = open_point_source(input.path, input.tolerance);
    while (source->read(batch, {})) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        for (std::size_t i = 0; i < batch.count; ++i) {
          const double value = world_coordinate(input, batch, i, axis);
          if (!std::isfinite(value)) continue;
          extent.min[axis] = std::min(extent.min[axis], value);
          extent.max[axis] = std::max(extent.max[axis], value);
        }
      }
    }
  }
  return extent;
}

/// Points of PLY inputs, of LAS inputs with different layouts, or of both, as LAS 1.4.
class ConvertedLasWriter final : public KeptPointWriter {
 public:
  explicit ConvertedLasWriter(const KeptJob& job)
      : inputs_(job.inputs), output_(job.path, job.options.overwrite), carried_(job.inputs) {
    check_crs_sharing(job, warnings_);
    for (const SourceInfo& input : inputs_) readers_.push_back(make_record_reader(InputFile(input.path), input));
    union_ = std::make_unique<ColumnUnion>(readers_, ScalarType::kUint16);
    conversion_ = std::make_unique<LasConversion>(job, *union_);
    const std::vector<ColumnSpec> columns = rename_taken_columns(job.columns, conversion_->names(), warnings_);
    row_bytes_ = row_size_bytes(columns);
    ranges_ = ColumnRanges(columns);
    grid_ = merge_las_grids(inputs_, job.options.extent ? *job.options.extent : measure(inputs_));
    if (conversion_->record_bytes() + row_bytes_ > kLasMaxRecordBytes) {
      throw ConfigError(fmt::format("{}: records would exceed {} bytes; write PLY", printable(job.path.string(), 1000),
                                    kLasMaxRecordBytes));
    }
    for (const std::string& warning : conversion_->warnings()) warnings_.push_back(warning);
    note_losses();
    write_front(columns);
  }

  void append(std::size_t source_index, const PointBatch& batch, std::span<const std::uint32_t> kept,
              std::span<const std::byte> rows) override {
    assert(rows.size() == kept.size() * row_bytes_);
    RecordReader& reader = *readers_[source_index];
    from_file_.resize(reader.columns().size());
    values_.resize(union_->columns().size());
    const std::byte* row = rows.data();
    for (const std::uint32_t point : kept) {
      record_.assign(conversion_->record_bytes(), std::byte{});
      if (store_position(source_index, batch, point)) {
        const auto original = record_of(batch, point);
        reader.read(original, from_file_);
        union_->map(source_index, from_file_, values_);
        conversion_->fill(source_index, values_, original, record_.data());
        totals_.add(record_.data(), is_extended_format(conversion_->point_format()) ? 15 : 7);
        output_.write(std::span<const std::byte>(record_));
        output_.write(std::span(row, row_bytes_));
        ranges_.add({row, row_bytes_});
      } else {
        ++left_out_;
      }
      row += row_bytes_;
    }
  }

  void commit() override {
    for (std::string& line : conversion_->clamped()) warnings_.push_back(std::move(line));
    if (left_out_ > 0) {
      warnings_.push_back(
          fmt::format("{} points without finite coordinates within the range of LAS are left out", grouped(left_out_)));
    }
    const std::uint64_t evlr_start = output_.size_bytes();
    const std::uint32_t evlrs = carried_.write_evlrs(output_);
    store<std::uint64_t>(&header_[kEvlrStart], evlrs > 0 ? evlr_start : 0);
    store<std::uint32_t>(&header_[kEvlrCount], evlrs);
    ranges_.patch_entries(output_, entries_at_);
    store_totals(header_, totals_);
    output_.patch(0, header_);
    output_.commit();
  }

  const std::vector<std::string>& warnings() const override { return warnings_; }

 private:
  /// Integers stay as they are where scale and offset do.
  bool store_position(std::size_t source_index, const PointBatch& batch, std::size_t point) {
    const SourceInfo& source = inputs_[source_index];
    const std::array<const std::vector<std::int32_t>*, 3> stored{&batch.ix, &batch.iy, &batch.iz};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const bool same = source.scaled_integers && source.scale[axis] == grid_.scale[axis] &&
                        source.offset[axis] == grid_.offset[axis];
      const auto value = same ? std::optional((*stored[axis])[point])
                              : grid_.stored(axis, world_coordinate(source, batch, point, axis));
      if (!value) return false;
      store<std::int32_t>(&record_[4 * axis], *value);
    }
    return true;
  }

  void note_losses() {
    if (inputs_.size() > 1 && carried_.has_las()) {
      warnings_.push_back(
          fmt::format("variable-length records and the kind of GPS time are those of {}", carried_.name()));
    }
    const bool all_las =
        std::all_of(inputs_.begin(), inputs_.end(), [](const auto& input) { return input.format == Format::kLas; });
    if (all_las) {
      warnings_.push_back(fmt::format("the inputs differ ({}); all are converted to LAS 1.4, point format {}",
                                      las_difference(inputs_), conversion_->point_format()));
    }
    for (std::size_t i = 0; i < inputs_.size(); ++i) {
      const SourceInfo& input = inputs_[i];
      const std::string name = printable(input.path.string(), 1000);
      for (const std::string& loss : readers_[i]->losses()) {
        // Extra bytes that all inputs share are carried as they are, described or not.
        if (conversion_->copies_extra_bytes() && loss.find("undocumented") != std::string::npos) continue;
        warnings_.push_back(fmt::format("{}: left out: {}", name, loss));
      }
      if (input.scaled_integers && (input.scale != grid_.scale || input.offset != grid_.offset))
        rounded_ = rounded_ || !std::equal(input.scale.begin(), input.scale.end(), grid_.scale.begin());
      if (!input.scaled_integers) rounded_ = true;
      if (input.format == Format::kPly) note_elements(input, name);
    }
    if (rounded_) {
      warnings_.push_back(fmt::format("coordinates are rounded to multiples of {}, {}, {}", grid_.scale[0],
                                      grid_.scale[1], grid_.scale[2]));
    }
  }

  void note_elements(const SourceInfo& input, const std::string& name) {
    const PlyHeader header = read_ply_header(InputFile(input.path));
    std::size_t comments = 0;
    for (const std::string& line : header.lines)
      comments += (line.starts_with("comment") || line.starts_with("obj_info")) && !is_count_comment(line) &&
                  !line.starts_with(kPlyCrsComment);
    if (comments > 0) warnings_.push_back(fmt::format("{}: left out: {} comments", name, comments));
    std::size_t listed = 0;
    for (const PlyElement& element : header.elements) {
      if (element.name == "vertex" || element.count == 0 || ++listed > 20) continue;
      warnings_.push_back(
          fmt::format("{}: left out: element {} ({} records)", name, printable(element.name, 40), element.count));
    }
  }

  void write_front(const std::vector<ColumnSpec>& columns) {
    const std::uint8_t format = conversion_->point_format();
    const auto fixed = make_las14_header(format, conversion_->record_bytes() + row_bytes_, grid_.scale, grid_.offset);
    header_.assign(fixed.begin(), fixed.end());
    const bool merged = inputs_.size() > 1;
    store_text(&header_[kSystemIdentifier], 32, merged ? "MERGE" : "OTHER");
    store_text(&header_[kGeneratingSoftware], 32, "arris");
    output_.write(std::span<const std::byte>(header_));
    std::uint32_t vlrs = carried_.write_vlrs(output_);
    carried_.set_encoding(is_extended_format(format), header_);
    std::vector<std::byte> entries = conversion_->entries();
    const std::vector<std::byte> ours = describe_columns(columns);
    entries.insert(entries.end(), ours.begin(), ours.end());
    if (!entries.empty()) {
      output_.write(std::span<const std::byte>(extra_bytes_vlr_header(entries.size())));
      output_.write(std::span<const std::byte>(entries));
      entries_at_ = output_.size_bytes() - ours.size();
      ++vlrs;
    }
    store<std::uint32_t>(&header_[kVlrCount], vlrs);
    store<std::uint32_t>(&header_[kOffsetToPoints], static_cast<std::uint32_t>(output_.size_bytes()));
  }

  std::vector<SourceInfo> inputs_;
  OutputFile output_;
  std::vector<std::unique_ptr<RecordReader>> readers_;
  std::unique_ptr<ColumnUnion> union_;
  std::unique_ptr<LasConversion> conversion_;
  LasGrid grid_;
  bool rounded_ = false;
  std::size_t row_bytes_ = 0;
  CarriedRecords carried_;
  std::vector<double> from_file_;
  std::vector<double> values_;
  std::vector<std::byte> record_;
  std::vector<std::byte> header_;
  LasTotals totals_;
  ColumnRanges ranges_{{}};
  std::uint64_t entries_at_ = 0;  ///< Descriptions of our columns in the output.
  std::uint64_t left_out_ = 0;
  std::vector<std::string> warnings_;
};

}  // namespace

std::unique_ptr<KeptPointWriter> create_converted_las_writer(const KeptJob& job) {
  return std::make_unique<ConvertedLasWriter>(job);
}

}  // namespace arris::io
