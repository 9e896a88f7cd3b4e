#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>

#include "core/error.h"
#include "core/text.h"
#include "io/bytes.h"
#include "io/kept_writers.h"
#include "io/las_extra_bytes.h"
#include "io/las_grid.h"
#include "io/las_layout.h"
#include "io/las_totals.h"
#include "io/ply_header.h"
#include "io/ply_record.h"
#include "io/ply_sharing.h"

namespace arris::io {
namespace {

enum Field : std::size_t {
  kX,
  kY,
  kZ,
  kIntensity,
  kReturnNumber,
  kReturns,
  kClass,
  kAngle,
  kUserData,
  kSourceId,
  kGpsTime,
  kRed,
  kGreen,
  kBlue,
  kFields
};

/// Names under which programs export LAS attributes to PLY; the first that is there is taken.
constexpr std::array<std::array<const char*, 5>, kFields> kNames{{
    {"x"},
    {"y"},
    {"z"},
    {"intensity", "Intensity", "scalar_Intensity", "scalar_intensity", "reflectance"},
    {"return_number", "scalar_Return_Number", "scalar_ReturnNumber", "return_num"},
    {"number_of_returns", "scalar_Number_Of_Returns", "scalar_NumberOfReturns"},
    {"classification", "Classification", "scalar_Classification", "scalar_classification"},
    {"scan_angle", "scalar_Scan_Angle"},
    {"user_data", "scalar_User_Data", "scalar_UserData"},
    {"point_source_id", "scalar_Point_Source_ID", "scalar_PointSourceId", "pt_src_id"},
    {"gps_time", "scalar_Gps_Time", "scalar_GpsTime"},
    {"red", "diffuse_red", "r"},
    {"green", "diffuse_green", "g"},
    {"blue", "diffuse_blue", "b"},
}};

WorldExtent measure(const std::vector<SourceInfo>& inputs) {
  WorldExtent extent;
  PointBatch batch;
  for (const SourceInfo& input : inputs) {
    const auto source = open_point_source(input.path);
    while (source->read(batch, {})) {
      const std::array<const std::vector<double>*, 3> axes{&batch.x, &batch.y, &batch.z};
      for (std::size_t axis = 0; axis < 3; ++axis) {
        for (const double value : *axes[axis]) {
          if (!std::isfinite(value)) continue;
          extent.min[axis] = std::min(extent.min[axis], value);
          extent.max[axis] = std::max(extent.max[axis], value);
        }
      }
    }
  }
  return extent;
}

/// Nearest integer within the range of T; NaN gives 0.
template <typename T>
T clamped(double value) {
  constexpr double kLeast = std::numeric_limits<T>::min();
  constexpr double kMost = std::numeric_limits<T>::max();
  if (std::isnan(value)) return 0;
  return static_cast<T>(std::round(std::clamp(value, kLeast, kMost)));
}

/// PLY vertices as LAS 1.4, point format 6, or 7 with colour. Attributes are recognised by their usual names.
class PlyToLasWriter final : public KeptPointWriter {
 public:
  explicit PlyToLasWriter(const KeptJob& job)
      : header_(read_ply_header(InputFile(job.inputs[0].path))),
        walker_(header_.format, header_.vertices(), find_properties()),
        output_(job.path, job.options.overwrite) {
    check_ply_sharing(job.inputs, /*same_encoding=*/true);
    grid_ = choose_las_grid(job.options.extent ? *job.options.extent : measure(job.inputs));
    colour_ = has(kRed) && has(kGreen) && has(kBlue);
    eight_bit_ =
        colour_ && size_bytes(header_.vertices().properties[static_cast<std::size_t>(property_[kRed])].type) == 1;
    unit_colour_ =
        colour_ && !is_integer(header_.vertices().properties[static_cast<std::size_t>(property_[kRed])].type);
    columns_ = job.columns;
    row_bytes_ = row_size_bytes(columns_);
    const std::uint8_t format = colour_ ? 7 : 6;
    record_.resize(kLasPointLayouts[format].size_bytes);
    note_losses();
    write_header(format);
  }

  void append([[maybe_unused]] std::size_t source_index, const PointBatch& batch, std::span<const std::uint32_t> kept,
              std::span<const std::byte> rows) override {
    assert(rows.size() == kept.size() * row_bytes_);
    const std::byte* row = rows.data();
    for (const std::uint32_t point : kept) {
      // The reader has walked these very bytes already, so they are whole.
      if (walker_.walk(record_of(batch, point), true) == PlyRecordWalker::Result::kDone && convert()) {
        totals_.add(record_.data(), 15);
        output_.write(std::span<const std::byte>(record_));
        output_.write(std::span(row, row_bytes_));
      } else {
        ++left_out_;
      }
      row += row_bytes_;
    }
  }

  void commit() override {
    if (left_out_ > 0) {
      warnings_.push_back(
          fmt::format("{} points without finite coordinates within the range of LAS are left out", grouped(left_out_)));
    }
    store_totals(las_header_, totals_);
    output_.patch(0, las_header_);
    output_.commit();
  }

  const std::vector<std::string>& warnings() const override { return warnings_; }

 private:
  bool has(Field field) const { return property_[field] >= 0; }

  /// Fills property_ and slot_, and returns the properties to read.
  std::vector<int> find_properties() {
    std::vector<int> wanted;
    for (std::size_t field = 0; field < kFields; ++field) {
      for (const char* name : kNames[field]) {
        if (property_[field] < 0 && name != nullptr) property_[field] = header_.vertices().find(name);
      }
      slot_[field] = wanted.size();
      if (property_[field] >= 0) wanted.push_back(property_[field]);
    }
    return wanted;
  }

  double value(Field field) const { return has(field) ? walker_.value(slot_[field]) : 0.0; }

  void note_losses() {
    std::string lost;
    for (std::size_t i = 0; i < header_.vertices().properties.size(); ++i) {
      const auto used = std::find(property_.begin(), property_.end(), static_cast<int>(i));
      const bool carried = used != property_.end() && (colour_ || used < property_.begin() + kRed);
      if (!carried && lost.size() < 300)
        lost += (lost.empty() ? "" : ", ") + printable(header_.vertices().properties[i].name, 40);
    }
    if (!lost.empty())
      warnings_.push_back(fmt::format("LAS has no place for the vertex properties {}; they are left out", lost));
    for (const PlyElement& element : header_.elements) {
      if (element.name == "vertex" || element.count == 0) continue;
      warnings_.push_back(
          fmt::format("element {} ({} records) is left out", printable(element.name, 40), element.count));
      if (warnings_.size() > 20) break;
    }
    if (has(kIntensity) &&
        !is_integer(header_.vertices().properties[static_cast<std::size_t>(property_[kIntensity])].type)) {
      warnings_.push_back("intensity is a floating-point property; it is rounded to 0..65535");
    }
    warnings_.push_back(fmt::format("coordinates are rounded to multiples of {}", grid_.scale));
  }

  void write_header(std::uint8_t format) {
    const auto fixed = make_las14_header(format, record_.size() + row_bytes_, grid_.scale, grid_.offset);
    las_header_.assign(fixed.begin(), fixed.end());
    store_text(&las_header_[kSystemIdentifier], 32, "OTHER");
    store_text(&las_header_[kGeneratingSoftware], 32, "arris");
    const std::vector<std::byte> entries = describe_columns(columns_);
    std::vector<std::byte> vlr;
    if (!columns_.empty()) {
      vlr = extra_bytes_vlr_header(entries.size());
      vlr.insert(vlr.end(), entries.begin(), entries.end());
      store<std::uint32_t>(&las_header_[kVlrCount], 1);
      store<std::uint32_t>(&las_header_[kOffsetToPoints], static_cast<std::uint32_t>(las_header_.size() + vlr.size()));
    }
    output_.write(std::span<const std::byte>(las_header_));
    output_.write(std::span<const std::byte>(vlr));
  }

  /// Fills record_ from the walker; false if the point has no place in the file.
  bool convert() {
    std::byte* record = record_.data();
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto stored = grid_.stored(axis, value(static_cast<Field>(axis)));
      if (!stored) return false;
      store<std::int32_t>(record + 4 * axis, *stored);
    }
    store<std::uint16_t>(record + 12, clamped<std::uint16_t>(value(kIntensity)));
    const auto number = has(kReturnNumber) ? std::min<unsigned>(15, clamped<std::uint8_t>(value(kReturnNumber))) : 1U;
    const auto returns =
        has(kReturns) ? std::min<unsigned>(15, clamped<std::uint8_t>(value(kReturns))) : std::max(1U, number);
    store<std::uint8_t>(record + 14, static_cast<std::uint8_t>(number | (returns << 4)));
    store<std::uint8_t>(record + 16, clamped<std::uint8_t>(value(kClass)));
    store<std::uint8_t>(record + 17, clamped<std::uint8_t>(value(kUserData)));
    store<std::int16_t>(record + 18, clamped<std::int16_t>(value(kAngle) / kScanAngleStepDeg));
    store<std::uint16_t>(record + 20, clamped<std::uint16_t>(value(kSourceId)));
    store<double>(record + 22, value(kGpsTime));
    if (!colour_) return true;
    for (std::size_t i = 0; i < 3; ++i) {
      double shade = value(static_cast<Field>(kRed + i));
      if (eight_bit_) shade *= 257.0;  // 255 -> 65535
      if (unit_colour_) shade *= 65535.0;
      store<std::uint16_t>(record + 30 + 2 * i, clamped<std::uint16_t>(shade));
    }
    return true;
  }

  PlyHeader header_;
  std::array<int, kFields> property_ = filled(-1);
  std::array<std::size_t, kFields> slot_{};
  PlyRecordWalker walker_;
  OutputFile output_;
  LasGrid grid_;
  bool colour_ = false;
  bool eight_bit_ = false;    ///< Colours are 0..255 ...
  bool unit_colour_ = false;  ///< ... or 0..1 (floating point).
  std::vector<ColumnSpec> columns_;
  std::size_t row_bytes_ = 0;
  std::vector<std::byte> record_;
  std::vector<std::byte> las_header_;
  LasTotals totals_;
  std::uint64_t left_out_ = 0;
  std::vector<std::string> warnings_;

  static constexpr std::array<int, kFields> filled(int value) {
    std::array<int, kFields> all{};
    all.fill(value);
    return all;
  }
};

}  // namespace

std::unique_ptr<KeptPointWriter> create_ply_to_las_writer(const KeptJob& job) {
  return std::make_unique<PlyToLasWriter>(job);
}

}  // namespace arris::io
