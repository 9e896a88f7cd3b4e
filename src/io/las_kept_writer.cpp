#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <optional>

#include "core/error.h"
#include "core/text.h"
#include "io/bytes.h"
#include "io/column_ranges.h"
#include "io/crs_sharing.h"
#include "io/kept_writers.h"
#include "io/las_extra_bytes.h"
#include "io/las_file.h"
#include "io/las_layout.h"
#include "io/las_sharing.h"
#include "io/las_totals.h"

namespace arris::io {
namespace {

constexpr std::uint16_t kSupersededRecord = 7;  ///< LASF_Spec / 7
/// Bytes behind the points that no structure refers to are carried up to this size; more is likely not meant to be
/// there.
constexpr std::uint64_t kMaxStrayTail = std::uint64_t{1} << 20;

/// Kept records bit for bit, our columns behind them as extra bytes. The header, the VLRs, the gap before the points
/// and what follows the points are copied from the first input; only counts, bounds and offsets change.
class LasKeptWriter final : public KeptPointWriter {
 public:
  explicit LasKeptWriter(const KeptJob& job)
      : input_(job.inputs[0].path),
        las_(read_las_file(input_, job.inputs[0].tolerance)),
        output_(job.path, job.options.overwrite) {
    check_crs_sharing(job, warnings_);
    if (const std::size_t left_out = later_extended_records(job.inputs); left_out > 0) {
      warnings_.push_back(fmt::format("{} extended records of inputs after {} are left out", left_out, input_.name()));
    }
    std::vector<std::string> taken;
    for (const ExtraAttribute& attribute : read_extra_bytes(input_, las_).attributes) taken.push_back(attribute.name);
    const std::vector<ColumnSpec> columns = rename_taken_columns(job.columns, taken, warnings_);
    row_bytes_ = row_size_bytes(columns);
    ranges_ = ColumnRanges(columns);
    entries_bytes_ = columns.size() * kExtraBytesEntryBytes;
    return_mask_ = is_extended_format(las_.header.point_format) ? 15 : 7;
    plan_ = plan_extra_bytes(input_, las_, columns);
    warnings_.insert(warnings_.end(), plan_.warnings.begin(), plan_.warnings.end());
    write_front();
    warn_of_external_waveforms(job);
  }

  void append([[maybe_unused]] std::size_t source_index, const PointBatch& batch, std::span<const std::uint32_t> kept,
              std::span<const std::byte> rows) override {
    assert(rows.size() == kept.size() * row_bytes_);
    if (!can_count(las_.header.minor, totals_.points + kept.size())) {
      throw ConfigError(
          fmt::format("{}: LAS 1.{} cannot count more than 4 294 967 295 points; write PLY, or split the inputs",
                      printable(output_.path().string(), 1000), las_.header.minor));
    }
    const std::size_t at_once = OutputFile::kMostExtension / (las_.header.record_bytes + row_bytes_);
    for (std::size_t begin = 0; begin < kept.size(); begin += at_once) {
      const std::size_t count = std::min(at_once, kept.size() - begin);
      append_some(batch, kept.subspan(begin, count), rows.data() + begin * row_bytes_);
    }
  }

  void commit() override {
    write_tail();
    ranges_.patch_entries(output_, entries_at_);
    correct_totals(header_, totals_);
    output_.patch(0, header_);
    output_.commit();
  }

  const std::vector<std::string>& warnings() const override { return warnings_; }

 private:
  /// @param kept  as many as one extension of the output has room for.
  void append_some(const PointBatch& batch, std::span<const std::uint32_t> kept, const std::byte* row) {
    const std::size_t record_bytes = las_.header.record_bytes, row_bytes = row_bytes_;
    ranges_.add({row, kept.size() * row_bytes});
    LasTotals totals = totals_;  // Here what is written does not keep it out of registers.
    std::byte* to = output_.extend(kept.size() * (record_bytes + row_bytes_)).data();
    for (const std::uint32_t point : kept) {
      const auto record = record_of(batch, point);
      assert(record.size() == record_bytes);
      totals.add(record.data(), return_mask_);
      copy_short(to, record.data(), record_bytes);
      copy_short(to + record_bytes, row, row_bytes);
      to += record_bytes + row_bytes;
      row += row_bytes;
    }
    totals_ = totals;
  }
  void write_front() {
    header_ = las_.header.raw;
    output_.write(std::span<const std::byte>(header_));
    for (std::size_t i = 0; i < las_.vlrs.size(); ++i) write_vlr(i);
    if (!plan_.new_payload.empty()) {
      output_.write(std::span<const std::byte>(extra_bytes_vlr_header(plan_.new_payload.size())));
      output_.write(std::span<const std::byte>(plan_.new_payload));
      entries_at_ = output_.size_bytes() - entries_bytes_;
    }
    gap_shift_ = output_.size_bytes() - las_.vlrs_end;
    copy_bytes(input_, las_.vlrs_end, las_.header.offset_to_points, output_);
    if (output_.size_bytes() > 0xFFFFFFFFU) {
      throw ConfigError(
          fmt::format("{}: its records before the points leave no room for a description of new attributes; write PLY",
                      input_.name()));
    }
    const std::size_t vlrs = las_.vlrs.size() + (plan_.new_payload.empty() ? 0 : 1);
    store<std::uint32_t>(&header_[kVlrCount], static_cast<std::uint32_t>(vlrs));
    store<std::uint32_t>(&header_[kOffsetToPoints], static_cast<std::uint32_t>(output_.size_bytes()));
    store<std::uint16_t>(&header_[kRecordLength], static_cast<std::uint16_t>(las_.header.record_bytes + row_bytes_));
  }

  void write_vlr(std::size_t index) {
    const LasVlr& vlr = las_.vlrs[index];
    std::vector<std::byte> bytes(static_cast<std::size_t>(vlr.end() - vlr.begin));
    input_.read(vlr.begin, bytes);
    if (plan_.append_to == static_cast<int>(index)) {
      bytes.insert(bytes.end(), plan_.appended.begin(), plan_.appended.end());
      store<std::uint16_t>(&bytes[20], static_cast<std::uint16_t>(bytes.size() - kVlrHeaderBytes));
    }
    if (plan_.supersede_vlrs && is_extra_bytes_record(vlr)) store<std::uint16_t>(&bytes[18], kSupersededRecord);
    output_.write(std::span<const std::byte>(bytes));
    if (plan_.append_to == static_cast<int>(index)) entries_at_ = output_.size_bytes() - entries_bytes_;
  }

  /// Copies what follows the points and points the header to its new place.
  void write_tail() {
    const std::uint64_t tail = input_.size_bytes() - las_.points_end;
    tail_shift_ = output_.size_bytes() - las_.points_end;
    const bool referred = las_.header.waveform_start >= las_.points_end ||
                          std::any_of(las_.evlrs.begin(), las_.evlrs.end(),
                                      [&](const LasVlr& record) { return record.begin >= las_.points_end; });
    if (referred || tail <= kMaxStrayTail) {
      copy_bytes(input_, las_.points_end, input_.size_bytes(), output_);
    } else {
      warnings_.push_back(fmt::format("{}: {} behind the last point belong to nothing and are left out", input_.name(),
                                      human_bytes(tail)));
    }
    if (las_.header.waveform_start != 0) {
      store<std::uint64_t>(&header_[kWaveformStart], moved(las_.header.waveform_start));
    }
    if (las_.header.evlr_count > 0) {
      if (las_.evlrs.size() < las_.header.evlr_count) {
        warnings_.push_back(fmt::format("{}: {} of {} extended records are damaged and no longer listed", input_.name(),
                                        las_.header.evlr_count - las_.evlrs.size(), las_.header.evlr_count));
      }
      store<std::uint64_t>(&header_[kEvlrStart], las_.evlrs.empty() ? 0 : moved(las_.header.evlr_start));
      store<std::uint32_t>(&header_[kEvlrCount], static_cast<std::uint32_t>(las_.evlrs.size()));
    } else if (las_.header.evlr_start >= las_.points_end) {
      store<std::uint64_t>(&header_[kEvlrStart], moved(las_.header.evlr_start));  // Some writers point at the end.
    }
    if (!plan_.supersede_evlrs) return;
    std::array<std::byte, 2> id{};
    store<std::uint16_t>(id.data(), kSupersededRecord);
    for (const LasVlr& record : las_.evlrs) {
      if (is_extra_bytes_record(record)) output_.patch(moved(record.begin) + 18, id);
    }
  }

  /// New offset of a structure of the input. 0 (absent) for one that would lie within the points, which are not as they
  /// were.
  std::uint64_t moved(std::uint64_t offset) const {
    if (offset >= las_.points_end) return offset + tail_shift_;
    if (offset >= las_.header.offset_to_points) return 0;
    return offset >= las_.vlrs_end ? offset + gap_shift_ : offset;
  }

  void warn_of_external_waveforms(const KeptJob& job) {
    const bool waves = kLasPointLayouts[las_.header.point_format].waveform != 0;
    if (!waves || (las_.header.global_encoding & kEncodingExternalWaveforms) == 0) return;
    auto from = job.inputs[0].path;
    auto to = job.path;
    from.replace_extension(".wdp");
    to.replace_extension(".wdp");
    warnings_.push_back(fmt::format("the waveforms of the points are in {}; copy it to {}", printable(from.string()),
                                    printable(to.string())));
  }

  InputFile input_;
  LasFile las_;
  OutputFile output_;
  ExtraBytesPlan plan_;
  std::vector<std::byte> header_;
  LasTotals totals_;
  ColumnRanges ranges_{{}};
  std::size_t entries_bytes_ = 0;  ///< Of the descriptions of our columns ...
  std::uint64_t entries_at_ = 0;   ///< ... which lie here in the output.
  std::size_t row_bytes_ = 0;
  unsigned return_mask_ = 7;
  std::uint64_t gap_shift_ = 0;  ///< How far the bytes between VLRs and points moved ...
  std::uint64_t tail_shift_ =
      0;  ///< ... and those behind the points (modulo 2^64: fewer points move them to the front).
  std::vector<std::string> warnings_;
};

}  // namespace

std::unique_ptr<KeptPointWriter> create_las_kept_writer(const KeptJob& job) {
  return std::make_unique<LasKeptWriter>(job);
}

}  // namespace arris::io
