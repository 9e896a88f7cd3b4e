#include "found_values.h"

#include <bit>
#include <cmath>
#include <cstring>
#include <vector>

#include "io/attribute_reader.h"

namespace arris::test {
namespace {

constexpr std::size_t kBatchPoints = 5000;  // Several batches for most files.

/// Where a LAS point format keeps red, or 0.
std::size_t red_offset(int point_format) {
  constexpr std::array<std::size_t, 11> kRed{0, 0, 20, 28, 0, 28, 0, 30, 30, 0, 30};
  return kRed.at(static_cast<std::size_t>(point_format));
}

std::uint64_t bits_of(double value) {
  constexpr std::uint64_t kQuietNan = 0x7ff8000000000000U;
  return std::isnan(value) ? kQuietNan : std::bit_cast<std::uint64_t>(value);
}

class Finder {
 public:
  explicit Finder(const io::SourceInfo& info) : info_(info), las_(info.format == io::Format::kLas) {
    // The reader of attributes knows sound files only.
    if (info.tolerance != io::Tolerance::kSalvage) {
      attributes_.emplace(info.path, std::vector<std::string>{"intensity", "red"});
    }
    if (las_) {
      const std::string key = "point format ";
      red_at_ = red_offset(std::stoi(info.layout.substr(info.layout.find(key) + key.size())));
    }
    if (has_attribute(0)) found_.intensity = 0.0L;
    if (red_at_ > 0 || has_attribute(1)) found_.red = 0.0L;
  }

  void add(const io::PointBatch& batch) {
    const std::array stored{&batch.ix, &batch.iy, &batch.iz};
    const std::array world{&batch.x, &batch.y, &batch.z};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (std::size_t i = 0; i < batch.count; ++i) {
        const std::uint64_t weight = 3 * (found_.count + i) + axis + 1;
        if (las_) {
          const std::int32_t value = (*stored[axis])[i];
          found_.digest += weight * static_cast<std::uint64_t>(static_cast<std::int64_t>(value));
          found_.sums[axis] += static_cast<long double>(value);
          add_extent(axis, value * info_.scale[axis] + info_.offset[axis]);
        } else {
          const double value = (*world[axis])[i];
          found_.digest += weight * bits_of(value);
          if (!std::isfinite(value)) continue;
          found_.sums[axis] += static_cast<long double>(value);
          found_.absolute[axis] += static_cast<long double>(std::abs(value));
          add_extent(axis, value);
        }
      }
    }
    add_attributes(batch);
    found_.records.append(reinterpret_cast<const char*>(batch.records.data()), batch.records.size());
    found_.count += batch.count;
  }

  FoundValues& found() { return found_; }

 private:
  bool has_attribute(std::size_t index) const { return attributes_ && attributes_->has(index); }

  void add_extent(std::size_t axis, double value) {
    found_.min[axis] = std::min(found_.min[axis], value);
    found_.max[axis] = std::max(found_.max[axis], value);
  }

  void add_attributes(const io::PointBatch& batch) {
    const auto add_column = [&](std::size_t index, std::optional<long double>& sum) {
      if (!has_attribute(index)) return;
      attributes_->read(batch, index, column_);
      for (const double value : column_) *sum += std::isfinite(value) ? static_cast<long double>(value) : 0.0L;
    };
    add_column(0, found_.intensity);
    if (!las_) return add_column(1, found_.red);
    for (std::size_t i = 0; red_at_ > 0 && i < batch.count; ++i) {
      std::uint16_t red = 0;
      std::memcpy(&red, batch.records.data() + batch.record_begin[i] + red_at_, sizeof red);
      *found_.red += static_cast<long double>(red);
    }
  }

  const io::SourceInfo& info_;
  bool las_ = false;
  std::optional<io::AttributeReader> attributes_;
  std::size_t red_at_ = 0;
  FoundValues found_;
  std::vector<double> column_;
};

}  // namespace

FoundValues find_values(io::PointSource& source) {
  Finder finder(source.info());
  io::PointBatch batch;
  io::ReadOptions options;
  options.records = true;
  options.batch_points = kBatchPoints;
  source.rewind();
  while (source.read(batch, options)) finder.add(batch);
  return std::move(finder.found());
}

}  // namespace arris::test
