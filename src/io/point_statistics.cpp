#include "io/point_statistics.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/text.h"
#include "io/kept_writers.h"
#include "io/las_file.h"
#include "io/las_totals.h"

namespace arris::io {
namespace {

class Collector {
 public:
  Collector(const SourceInfo& info, RecordReader& reader) : info_(info), reader_(reader) {
    for (const RecordColumn& column : reader.columns()) statistics_.columns.push_back({column});
    values_.resize(statistics_.columns.size());
    classification_ = reader.find("classification");
    number_ = reader.find("return_number");
    returns_ = reader.find("number_of_returns");
  }

  void add(const PointBatch& batch) {
    for (std::size_t i = 0; i < batch.count; ++i) {
      add_position(batch, i);
      reader_.read(record_of(batch, i), values_);
      for (std::size_t column = 0; column < values_.size(); ++column)
        add_value(statistics_.columns[column], values_[column]);
      add_returns();
      const double label = classification_ < 0 ? -1.0 : values_[static_cast<std::size_t>(classification_)];
      if (label >= 0.0 && label < 256.0) ++statistics_.classes[static_cast<std::size_t>(label)];
    }
    statistics_.points += batch.count;
  }

  PointStatistics result() { return std::move(statistics_); }

 private:
  void add_position(const PointBatch& batch, std::size_t i) {
    std::array<double, 3> world{};
    for (std::size_t axis = 0; axis < 3; ++axis) world[axis] = world_coordinate(info_, batch, i, axis);
    if (!std::isfinite(world[0]) || !std::isfinite(world[1]) || !std::isfinite(world[2])) {
      ++statistics_.without_position;
      return;
    }
    for (std::size_t axis = 0; axis < 3; ++axis) {
      statistics_.extent.min[axis] = std::min(statistics_.extent.min[axis], world[axis]);
      statistics_.extent.max[axis] = std::max(statistics_.extent.max[axis], world[axis]);
    }
  }

  static void add_value(ColumnStatistics& column, double value) {
    if (!std::isfinite(value)) {
      ++column.not_finite;
      return;
    }
    column.min = column.finite == 0 ? value : std::min(column.min, value);
    column.max = column.finite == 0 ? value : std::max(column.max, value);
    ++column.finite;
  }

  void add_returns() {
    if (number_ < 0) return;
    const double number = values_[static_cast<std::size_t>(number_)];
    if (number >= 0.0 && number < 16.0) ++statistics_.by_return[static_cast<std::size_t>(number)];
    const bool above = returns_ >= 0 && number > values_[static_cast<std::size_t>(returns_)];
    if (number < 1.0 || above) ++statistics_.odd_returns;
  }

  const SourceInfo& info_;
  RecordReader& reader_;
  PointStatistics statistics_;
  std::vector<double> values_;
  int classification_ = -1;
  int number_ = -1;
  int returns_ = -1;
};

void check_bounds(const LasHeader& header, const PointStatistics& statistics, std::vector<Problem>& problems) {
  if (statistics.points == statistics.without_position) return;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    // One step of the scale is rounding.
    const double slack = 1.01 * std::abs(header.scale[axis]);
    if (std::abs(header.min[axis] - statistics.extent.min[axis]) <= slack &&
        std::abs(header.max[axis] - statistics.extent.max[axis]) <= slack) {
      continue;
    }
    problems.push_back(
        {"bbox-mismatch",
         fmt::format("the header's {} range is {} to {}, that of the points {:.10g} to {:.10g}", "xyz"[axis],
                     header.min[axis], header.max[axis], statistics.extent.min[axis], statistics.extent.max[axis]),
         kBounds + 16 * axis});
  }
}

void check_returns(const LasHeader& header, const PointStatistics& statistics, std::vector<Problem>& problems) {
  const bool wide = header.minor >= 4;
  for (std::size_t i = 0; i < (wide ? 15U : 5U); ++i) {
    const std::uint64_t claimed = wide ? load<std::uint64_t>(&header.raw[kPointsByReturn + 8 * i])
                                       : load<std::uint32_t>(&header.raw[kLegacyByReturn + 4 * i]);
    if (i + 1 < statistics.by_return.size() && claimed == statistics.by_return[i + 1]) continue;
    problems.push_back({"by-return-mismatch",
                        fmt::format("the header counts {} points of return {}, there are {}", claimed, i + 1,
                                    statistics.by_return[i + 1]),
                        wide ? kPointsByReturn + 8 * i : kLegacyByReturn + 4 * i});
    return;
  }
}

}  // namespace

const ColumnStatistics* PointStatistics::find(std::string_view name) const {
  const auto found =
      std::find_if(columns.begin(), columns.end(), [&](const ColumnStatistics& c) { return c.column.name == name; });
  return found == columns.end() ? nullptr : &*found;
}

bool PointStatistics::has_8_bit_colours() const {
  double most = 0.0;
  for (const char* name : {"red", "green", "blue"}) {
    const ColumnStatistics* column = find(name);
    if (column == nullptr || column->column.type != ScalarType::kUint16) return false;
    most = std::max(most, column->max);
  }
  return most > 0.0 && most <= 255.0;
}

PointStatistics collect_statistics(PointSource& source, RecordReader& reader,
                                   const std::function<void(std::uint64_t)>& read) {
  Collector collector(source.info(), reader);
  source.rewind();
  PointBatch batch;
  ReadOptions options;
  options.records = true;
  while (source.read(batch, options)) {
    collector.add(batch);
    read(batch.count);
  }
  return collector.result();
}

std::vector<Problem> find_point_problems(const InputFile& file, const SourceInfo& info,
                                         const PointStatistics& statistics) {
  std::vector<Problem> problems;
  if (info.format == Format::kLas) {
    const LasHeader header = read_las_file(file, info.tolerance).header;
    check_bounds(header, statistics, problems);
    check_returns(header, statistics, problems);
  }
  if (statistics.odd_returns > 0) {
    problems.push_back({"returns", fmt::format("{} points have return number 0 or one above their number of returns",
                                               grouped(statistics.odd_returns))});
  }
  if (statistics.has_8_bit_colours()) {
    problems.push_back({"colour-8-bit", "colours use 8 of their 16 bits: none exceeds 255"});
  }
  if (statistics.without_position > 0) {
    problems.push_back({"non-finite", fmt::format("{} points have NaN or infinite coordinates",
                                                  grouped(statistics.without_position))});
  }
  return problems;
}

}  // namespace arris::io
