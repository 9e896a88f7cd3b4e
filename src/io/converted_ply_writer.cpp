#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>

#include "core/text.h"
#include "io/column_union.h"
#include "io/crs_sharing.h"
#include "io/kept_writers.h"
#include "io/las_crs.h"
#include "io/las_file.h"
#include "io/ply_header.h"
#include "io/ply_output.h"

namespace arris::io {
namespace {

/// Points of LAS inputs, of PLY inputs with different properties, or of both, as PLY: all attributes by name, then our
/// columns. In the format of the inputs if all are PLY of one, else binary little-endian.
class ConvertedPlyWriter final : public KeptPointWriter {
 public:
  explicit ConvertedPlyWriter(const KeptJob& job) : output_(job.path, job.options.overwrite) {
    check_crs_sharing(job, warnings_);
    for (const SourceInfo& input : job.inputs) readers_.push_back(make_record_reader(InputFile(input.path), input));
    union_ = std::make_unique<ColumnUnion>(readers_);
    std::vector<std::string> taken;
    for (const RecordColumn& column : union_->columns()) taken.push_back(ply_name(column));
    columns_ = rename_taken_columns(job.columns, taken, warnings_);
    row_bytes_ = row_size_bytes(columns_);
    values_.resize(union_->columns().size());
    choose_format(job.inputs);
    note_losses(job.inputs);
    write_header(job.inputs);
  }

  void append(std::size_t source_index, const PointBatch& batch, std::span<const std::uint32_t> kept,
              std::span<const std::byte> rows) override {
    assert(rows.size() == kept.size() * row_bytes_);
    RecordReader& reader = *readers_[source_index];
    from_file_.resize(reader.columns().size());
    const std::byte* row = rows.data();
    for (const std::uint32_t point : kept) {
      reader.read(record_of(batch, point), from_file_);
      union_->map(source_index, from_file_, values_);
      scratch_.clear();
      for (std::size_t i = 0; i < values_.size(); ++i) {
        encode_value(format_, union_->columns()[i].type, values_[i], scratch_);
      }
      encode_row(format_, columns_, row, scratch_);
      if (format_ == PlyFormat::kAscii) scratch_.push_back(std::byte{'\n'});
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
  /// Names in PLY have no blanks, and attributes of files may have any bytes.
  static std::string ply_name(const RecordColumn& column) {
    std::string name = printable(column.name_in_file, 100);
    std::replace(name.begin(), name.end(), ' ', '_');
    return name.empty() ? "unnamed" : name;
  }

  void choose_format(const std::vector<SourceInfo>& inputs) {
    bool first = true;
    for (const SourceInfo& input : inputs) {
      if (input.format == Format::kLas) {
        format_ = PlyFormat::kLittleEndian;
        return;
      }
      const PlyFormat format = read_ply_header(InputFile(input.path)).format;
      if (!first && format != format_) {
        format_ = PlyFormat::kLittleEndian;
        return;
      }
      format_ = format;
      first = false;
    }
  }

  void note_losses(const std::vector<SourceInfo>& inputs) {
    for (std::size_t i = 0; i < inputs.size(); ++i) {
      const std::string name = printable(inputs[i].path.string(), 1000);
      for (const std::string& loss : readers_[i]->losses())
        warnings_.push_back(fmt::format("{}: left out: {}", name, loss));
      if (inputs[i].format == Format::kPly) continue;
      const InputFile file(inputs[i].path);
      const LasFile las = read_las_file(file, inputs[i].tolerance);
      const std::size_t records = las.vlrs.size() + las.evlrs.size();
      if (records > 0) {
        warnings_.push_back(fmt::format(
            "{}: PLY has no place for its {} variable-length records; the coordinate reference system is written as a "
            "comment",
            name, records));
      }
    }
  }

  void write_header(const std::vector<SourceInfo>& inputs) {
    output_.write(fmt::format("ply\nformat {} 1.0\n", format_name(format_)));
    bool crs_written = false;
    bool comments_written = false;
    for (const SourceInfo& input : inputs) {
      const InputFile file(input.path);
      if (input.format == Format::kLas && !crs_written) {
        const CrsSummary crs = describe_crs(file, read_las_file(file, input.tolerance));
        crs_written = !crs.text.empty();
        if (crs_written) output_.write(fmt::format("{}{}\n", kPlyCrsComment, crs.text));
      }
      if (input.format == Format::kPly && !comments_written) {
        comments_written = true;
        for (const std::string& line : read_ply_header(file).lines) {
          if ((line.starts_with("comment") || line.starts_with("obj_info")) && !is_count_comment(line))
            output_.write(line + "\n");
        }
      }
    }
    count_at_ = output_.size_bytes();
    std::string text = ply_count_lines(0, "\n");
    for (const RecordColumn& column : union_->columns())
      text += fmt::format("property {} {}\n", type_name(column.type), ply_name(column));
    text += ply_column_lines(columns_, "\n") + "end_header\n";
    output_.write(std::string_view(text));
  }

  OutputFile output_;
  std::vector<std::unique_ptr<RecordReader>> readers_;
  std::unique_ptr<ColumnUnion> union_;
  PlyFormat format_ = PlyFormat::kLittleEndian;
  std::vector<ColumnSpec> columns_;
  std::size_t row_bytes_ = 0;
  std::uint64_t count_ = 0;
  std::uint64_t count_at_ = 0;
  std::vector<double> from_file_;
  std::vector<double> values_;
  std::vector<std::byte> scratch_;
  std::vector<std::string> warnings_;
};

}  // namespace

std::unique_ptr<KeptPointWriter> create_converted_ply_writer(const KeptJob& job) {
  return std::make_unique<ConvertedPlyWriter>(job);
}

}  // namespace arris::io
