#include <fmt/format.h>

#include <cassert>

#include "core/text.h"
#include "io/bytes.h"
#include "io/kept_writers.h"
#include "io/las_extra_bytes.h"
#include "io/las_file.h"
#include "io/las_layout.h"
#include "io/ply_output.h"

namespace arris::io {
namespace {

/// LAS points as binary little-endian PLY: double x y z; ushort intensity; uchar return_number, number_of_returns,
/// classification; float scan_angle (degrees); uchar user_data; ushort point_source_id; double gps_time and ushort red
/// green blue where the point format has them; then our columns.
class LasToPlyWriter final : public KeptPointWriter {
 public:
  explicit LasToPlyWriter(const KeptJob& job) : output_(job.path, job.options.overwrite), sources_(job.inputs) {
    const InputFile first(job.inputs[0].path);
    const LasFile las = read_las_file(first);
    point_format_ = las.header.point_format;
    for (const SourceInfo& input : job.inputs) check_format(input);
    layout_ = kLasPointLayouts[point_format_];
    columns_ = rename_taken_columns(job.columns, names(), warnings_);
    row_bytes_ = row_size_bytes(columns_);
    note_losses(first, las);
    write_header();
  }

  void append(std::size_t source_index, const PointBatch& batch, std::span<const std::uint32_t> kept,
              std::span<const std::byte> rows) override {
    assert(rows.size() == kept.size() * row_bytes_);
    const SourceInfo& source = sources_[source_index];
    const std::byte* row = rows.data();
    for (const std::uint32_t point : kept) {
      scratch_.clear();
      convert(record_of(batch, point).data(), source);
      encode_row(PlyFormat::kLittleEndian, columns_, row, scratch_);
      output_.write(std::span<const std::byte>(scratch_));
      row += row_bytes_;
    }
    count_ += kept.size();
  }

  void commit() override {
    const std::string lines = ply_count_lines(count_, "\n");
    output_.patch(count_at_, std::as_bytes(std::span(lines)));
    output_.commit();
  }

  const std::vector<std::string>& warnings() const override { return warnings_; }

 private:
  struct Field {
    const char* type;
    const char* name;
  };

  std::vector<Field> fields() const {
    std::vector<Field> all{{"double", "x"},
                           {"double", "y"},
                           {"double", "z"},
                           {"ushort", "intensity"},
                           {"uchar", "return_number"},
                           {"uchar", "number_of_returns"},
                           {"uchar", "classification"},
                           {"float", "scan_angle"},
                           {"uchar", "user_data"},
                           {"ushort", "point_source_id"}};
    if (layout_.gps_time != 0) all.push_back({"double", "gps_time"});
    if (layout_.colour != 0) {
      for (const char* name : {"red", "green", "blue"}) all.push_back({"ushort", name});
    }
    return all;
  }

  std::vector<std::string> names() const {
    std::vector<std::string> all;
    for (const Field& field : fields()) all.emplace_back(field.name);
    return all;
  }

  void check_format(const SourceInfo& input) {
    const InputFile file(input.path);
    const int other = read_las_file(file).header.point_format;
    if (other != point_format_)
      refuse_sharing(sources_[0], input, fmt::format("point formats {} and {}", point_format_, other));
  }

  void note_losses(const InputFile& file, const LasFile& las) {
    warnings_.push_back(
        "PLY has no place for flags, scan direction, edge of flight line and scanner channel; they are left out");
    if (layout_.infrared != 0) warnings_.push_back("near infrared is left out");
    if (layout_.waveform != 0) warnings_.push_back("waveforms are left out");
    const ExtraBytes extra = read_extra_bytes(file, las);
    std::string lost;
    for (const ExtraAttribute& attribute : extra.attributes) {
      if (lost.size() < 200) lost += (lost.empty() ? ": " : ", ") + printable(attribute.name, 40);
    }
    if (extra.present_bytes > 0)
      warnings_.push_back(fmt::format("{} extra bytes per point are left out{}", extra.present_bytes, lost));
    if (!las.vlrs.empty() || !las.evlrs.empty()) {
      warnings_.push_back(
          "PLY has no place for variable-length records; coordinate reference system and others are left out");
    }
  }

  void write_header() {
    output_.write(std::string_view("ply\nformat binary_little_endian 1.0\n"));
    count_at_ = output_.size_bytes();
    std::string text = ply_count_lines(0, "\n");
    for (const Field& field : fields()) text += fmt::format("property {} {}\n", field.type, field.name);
    text += ply_column_lines(columns_, "\n") + "end_header\n";
    output_.write(std::string_view(text));
  }

  template <typename T>
  void put(T value) {
    scratch_.resize(scratch_.size() + sizeof(T));
    store<T>(scratch_.data() + scratch_.size() - sizeof(T), value);
  }

  void convert(const std::byte* record, const SourceInfo& source) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      put<double>(las_world(source.scale[axis], source.offset[axis], load<std::int32_t>(record + 4 * axis)));
    }
    put<std::uint16_t>(load<std::uint16_t>(record + 12));
    const auto returns = load<std::uint8_t>(record + 14);
    if (is_extended_format(static_cast<std::uint8_t>(point_format_))) {
      put<std::uint8_t>(returns & 15);
      put<std::uint8_t>(returns >> 4);
      put<std::uint8_t>(load<std::uint8_t>(record + 16));
      put<float>(static_cast<float>(load<std::int16_t>(record + 18) * kScanAngleStepDeg));
      put<std::uint8_t>(load<std::uint8_t>(record + 17));
      put<std::uint16_t>(load<std::uint16_t>(record + 20));
    } else {
      put<std::uint8_t>(returns & 7);
      put<std::uint8_t>((returns >> 3) & 7);
      put<std::uint8_t>(load<std::uint8_t>(record + 15) & 31);
      put<float>(load<std::int8_t>(record + 16));
      put<std::uint8_t>(load<std::uint8_t>(record + 17));
      put<std::uint16_t>(load<std::uint16_t>(record + 18));
    }
    if (layout_.gps_time != 0) put<double>(load<double>(record + layout_.gps_time));
    for (std::size_t i = 0; layout_.colour != 0 && i < 3; ++i)
      put<std::uint16_t>(load<std::uint16_t>(record + layout_.colour + 2 * i));
  }

  OutputFile output_;
  std::vector<SourceInfo> sources_;
  int point_format_ = 0;
  LasPointLayout layout_{};
  std::vector<ColumnSpec> columns_;
  std::size_t row_bytes_ = 0;
  std::uint64_t count_ = 0;
  std::uint64_t count_at_ = 0;
  std::vector<std::byte> scratch_;
  std::vector<std::string> warnings_;
};

}  // namespace

std::unique_ptr<KeptPointWriter> create_las_to_ply_writer(const KeptJob& job) {
  return std::make_unique<LasToPlyWriter>(job);
}

}  // namespace arris::io
