#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <numeric>
#include <optional>

#include "core/error.h"
#include "core/text.h"
#include "io/kept_writers.h"
#include "io/ply_body.h"
#include "io/ply_output.h"
#include "io/ply_sharing.h"

namespace arris::io {
namespace {

bool is_blank(std::byte b) {
  const char c = static_cast<char>(b);
  return c == ' ' || (c >= '\t' && c <= '\r');
}

bool is_property_line(std::string_view line) {
  const std::size_t word = line.find_first_not_of(" \t\v\f");
  return word != std::string_view::npos && line.substr(word).starts_with("property");
}

/// Vertices kept bit for bit (in ascii: their text), our columns behind them; the header's lines stay as they were,
/// apart from the count, our properties, and elements that cannot be carried.
class PlyKeptWriter final : public KeptPointWriter {
 public:
  explicit PlyKeptWriter(const KeptJob& job)
      : input_(job.inputs[0].path), header_(read_ply_header(input_)), output_(job.path, job.options.overwrite) {
    std::vector<std::string> taken;
    for (const PlyProperty& property : header_.vertices().properties) taken.push_back(property.name);
    columns_ = rename_taken_columns(job.columns, taken, warnings_);
    row_bytes_ = row_size_bytes(columns_);
    if (job.options.every_point)
      expected_ = std::accumulate(job.inputs.begin(), job.inputs.end(), std::uint64_t{0},
                                  [](std::uint64_t sum, const SourceInfo& input) { return sum + input.points; });
    salvage_ = job.inputs[0].tolerance == Tolerance::kSalvage;
    // Vertices keep their numbers if all of them are written and nothing else is.
    choose_elements(job.options.every_point && job.inputs.size() == 1 &&
                    job.inputs[0].points == header_.vertices().count);
    if (job.inputs.size() > 1)
      warnings_.push_back(fmt::format("comments and other elements are taken from {} alone", input_.name()));
    write_header();
    for (std::size_t i = 0; i < header_.vertex; ++i) write_element(i);
  }

  void append([[maybe_unused]] std::size_t source_index, const PointBatch& batch, std::span<const std::uint32_t> kept,
              std::span<const std::byte> rows) override {
    assert(rows.size() == kept.size() * row_bytes_);
    const std::byte* row = rows.data();
    const auto line_end = std::as_bytes(std::span(header_.line_end));
    for (const std::uint32_t point : kept) {
      const auto record = record_of(batch, point);
      scratch_.assign(record.begin(), record.end());
      encode_row(header_.format, columns_, row, scratch_);
      if (header_.format == PlyFormat::kAscii) scratch_.insert(scratch_.end(), line_end.begin(), line_end.end());
      output_.write(std::span<const std::byte>(scratch_));
      row += row_bytes_;
    }
    count_ += kept.size();
  }

  void commit() override {
    assert(!expected_ || *expected_ == count_);
    for (std::size_t i = header_.vertex + 1; i < header_.elements.size(); ++i) write_element(i);
    if (rest_begin_) copy_rest(*rest_begin_, input_.size_bytes());
    const std::string lines = ply_count_lines(count_, header_.line_end);
    output_.patch(count_at_, std::as_bytes(std::span(lines)));
    output_.commit();
  }

  const std::vector<std::string>& warnings() const override { return warnings_; }

 private:
  /// Bytes of an element in the input, or why there are none.
  struct Fate {
    bool carried = false;
    std::uint64_t begin = 0;
    std::uint64_t end = 0;
  };

  void choose_elements(bool numbers_stay) {
    fates_.resize(header_.elements.size());
    std::size_t last = 0;  // No need to read behind the last element that is carried.
    for (std::size_t i = 0; i < fates_.size(); ++i) {
      const PlyElement& element = header_.elements[i];
      fates_[i].carried = i == header_.vertex || element.count == 0 || numbers_stay || !refers_to_vertices(element);
      if (fates_[i].carried && i != header_.vertex && element.count > 0) last = i + 1;
      if (fates_[i].carried) continue;
      warnings_.push_back(fmt::format("{}: element {} ({} records) is left out: it refers to vertices by their number",
                                      input_.name(), printable(element.name, 40), element.count));
    }
    std::uint64_t at = header_.body_begin;
    if (numbers_stay) last = header_.vertex + 1;  // What follows is copied to the end of the file, whatever it is.
    for (std::size_t i = 0; i < last; ++i) {
      fates_[i].begin = at;
      try {
        at = skip_ply_element(input_, header_, i, at);
      } catch (const InputError&) {
        if (i < header_.vertex || (i == header_.vertex && !salvage_)) throw;
        const std::size_t lost = std::max(i, header_.vertex + 1);
        for (std::size_t j = lost; j < last; ++j) fates_[j].carried = false;
        warnings_.push_back(fmt::format("elements from {} on are damaged and left out",
                                        printable(header_.elements[std::min(lost, last - 1)].name, 40)));
        return;
      }
      fates_[i].end = at;
    }
    if (numbers_stay) rest_begin_ = at;
  }

  void write_header() {
    std::size_t started = 0;  // Elements whose "element" line has been passed.
    std::size_t vertex_properties = 0;
    for (std::size_t i = 0; i < header_.lines.size(); ++i) {
      const std::string& line = header_.lines[i];
      const bool starts = started < header_.elements.size() && header_.elements[started].line == i;
      if (starts) ++started;
      const bool in_vertex = started == header_.vertex + 1;
      const bool carried = started == 0 || fates_[started - 1].carried;
      if (starts && in_vertex) {
        count_at_ = output_.size_bytes();
        output_.write(std::string_view(ply_count_lines(0, header_.line_end)));
        continue;
      }
      const bool property = is_property_line(line);
      if (is_count_comment(line) || ((starts || property) && !carried)) continue;
      output_.write(std::string_view(line));
      output_.write(std::string_view(header_.line_end));
      if (property && in_vertex && ++vertex_properties == header_.vertices().properties.size()) {
        output_.write(std::string_view(ply_column_lines(columns_, header_.line_end)));
      }
    }
  }

  void write_element(std::size_t index) {
    const Fate fate = fates_[index];
    if (!fate.carried || fate.begin == fate.end) return;
    copy_rest(fate.begin, fate.end);
    if (header_.format == PlyFormat::kAscii) output_.write(std::string_view(header_.line_end));
  }

  /// In ascii without the white space before the first value: it belongs to the line before.
  void copy_rest(std::uint64_t begin, std::uint64_t end) {
    for (std::byte b{}; header_.format == PlyFormat::kAscii && begin < end; ++begin) {
      input_.read(begin, {&b, 1});
      if (!is_blank(b)) break;
    }
    copy_bytes(input_, begin, end, output_);
  }

  InputFile input_;
  PlyHeader header_;
  OutputFile output_;
  std::vector<ColumnSpec> columns_;
  std::size_t row_bytes_ = 0;
  std::vector<Fate> fates_;
  std::optional<std::uint64_t> rest_begin_;  ///< What follows the vertices is copied unread from here on.
  bool salvage_ = false;
  std::optional<std::uint64_t> expected_;  ///< Points that the caller promised to append.
  std::uint64_t count_ = 0;
  std::uint64_t count_at_ = 0;  ///< Offset of the lines that hold the count.
  std::vector<std::byte> scratch_;
  std::vector<std::string> warnings_;
};

}  // namespace

std::unique_ptr<KeptPointWriter> create_ply_kept_writer(const KeptJob& job) {
  return std::make_unique<PlyKeptWriter>(job);
}

}  // namespace arris::io
