#include "io/ply_source.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/error.h"
#include "core/text.h"
#include "io/bytes.h"
#include "io/input_file.h"
#include "io/ply_body.h"
#include "io/ply_header.h"
#include "io/read_limits.h"

namespace arris::io {
namespace {

SourceInfo make_info(const InputFile& file, const PlyHeader& header, Tolerance tolerance) {
  SourceInfo info;
  info.path = file.path();
  info.format = Format::kPly;
  info.layout = fmt::format("PLY {} {}", header.format_name(), printable(header.version, 40));
  info.size_bytes = file.size_bytes();
  info.points = header.vertices().count;
  info.problems = header.problems;
  info.tolerance = tolerance;
  info.modified_ns = file.modified_ns();
  return info;
}

/// Under kSalvage: takes what is whole for the number of vertices.
void salvage_vertices(const InputFile& file, const PlyHeader& header, std::uint64_t begin, SourceInfo& info) {
  if (info.tolerance != Tolerance::kSalvage) return;
  const WholeRecords whole = count_whole_records(file, header, header.vertex, begin);
  if (whole.count == info.points) return;
  info.problems.push_back({"points-lost",
                           fmt::format("{} of {} vertices are whole; {} from byte {} on are lost", whole.count,
                                       info.points, info.points - whole.count, whole.end),
                           whole.end});
  info.points = whole.count;
}

/// Elements behind the vertices are not read; that the file is too short for them shows all the same.
void note_short_elements(const InputFile& file, const PlyHeader& header, std::uint64_t vertices_end, SourceInfo& info) {
  std::uint64_t left = file.size_bytes() - vertices_end;
  bool fixed = true;
  for (std::size_t i = header.vertex + 1; i < header.elements.size(); ++i) {
    const PlyElement& element = header.elements[i];
    const auto least = checked_multiply(element.count, element.least_bytes());
    if (!least || *least > left) {
      info.problems.push_back({"elements-lost",
                               fmt::format("the {} {} records that the header counts behind the vertices do not fit "
                                           "the {} bytes that are left",
                                           element.count, printable(element.name, 40), left),
                               vertices_end});
      return;
    }
    left -= *least;
    fixed = fixed && !element.has_list();
  }
  if (fixed && left > 0) {
    info.problems.push_back({"trailing-bytes",
                             fmt::format("{} bytes follow the last element and belong to nothing", left),
                             file.size_bytes() - left});
  }
}

void start_batch(PointBatch& batch, std::uint64_t first_id, std::size_t count) {
  batch.first_id = first_id;
  batch.count = count;
  batch.excluded.clear();
  for (auto* stored : {&batch.ix, &batch.iy, &batch.iz}) stored->clear();
  for (auto* world : {&batch.x, &batch.y, &batch.z}) world->resize(count);
}

template <typename T, std::endian kOrder>
void decode_axis(const std::byte* at, std::size_t stride, std::size_t count, double* out) {
  for (std::size_t i = 0; i < count; ++i, at += stride) out[i] = static_cast<double>(load<T, kOrder>(at));
}

template <std::endian kOrder>
void decode_axis_of_type(ScalarType type, const std::byte* at, std::size_t stride, std::size_t count, double* out) {
  switch (type) {
    case ScalarType::kInt8:
      return decode_axis<std::int8_t, kOrder>(at, stride, count, out);
    case ScalarType::kUint8:
      return decode_axis<std::uint8_t, kOrder>(at, stride, count, out);
    case ScalarType::kInt16:
      return decode_axis<std::int16_t, kOrder>(at, stride, count, out);
    case ScalarType::kUint16:
      return decode_axis<std::uint16_t, kOrder>(at, stride, count, out);
    case ScalarType::kInt32:
      return decode_axis<std::int32_t, kOrder>(at, stride, count, out);
    case ScalarType::kUint32:
      return decode_axis<std::uint32_t, kOrder>(at, stride, count, out);
    case ScalarType::kFloat32:
      return decode_axis<float, kOrder>(at, stride, count, out);
    case ScalarType::kFloat64:
      return decode_axis<double, kOrder>(at, stride, count, out);
    case ScalarType::kInt64:
      return decode_axis<std::int64_t, kOrder>(at, stride, count, out);
    case ScalarType::kUint64:
      return decode_axis<std::uint64_t, kOrder>(at, stride, count, out);
  }
}

/// Binary vertices without lists: records of fixed size, found by arithmetic.
class PlyFixedSource final : public PointSource {
 public:
  PlyFixedSource(std::shared_ptr<const InputFile> file, PlyHeader header, Tolerance tolerance)
      : file_(std::move(file)), header_(std::move(header)), info_(make_info(*file_, header_, tolerance)) {
    info_.record_bytes = header_.vertices().least_bytes();
    begin_ = find_ply_element(*file_, header_, header_.vertex);
    salvage_vertices(*file_, header_, begin_, info_);
    if (info_.points == header_.vertices().count) {
      // Throws if the file is too short.
      note_short_elements(*file_, header_, skip_ply_element(*file_, header_, header_.vertex, begin_), info_);
    }
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto property = static_cast<std::size_t>(header_.vertices().find(kAxes[axis]));
      types_[axis] = header_.vertices().properties[property].type;
      for (std::size_t i = 0; i < property; ++i) offsets_[axis] += size_bytes(header_.vertices().properties[i].type);
    }
  }

  const SourceInfo& info() const override { return info_; }
  void rewind() override { next_ = 0; }

  bool read(PointBatch& batch, const ReadOptions& options) override {
    const std::size_t count = batch_count(options.batch_points, info_.points - next_, info_.record_bytes);
    start_batch(batch, next_, count);
    prepare_records(batch, options.records, info_.record_bytes);
    if (count == 0) return false;
    const std::uint64_t begin = begin_ + next_ * info_.record_bytes;
    if (options.records) {
      file_->read(begin, batch.records);
      decode(batch.records.data(), 0, count, batch);
    } else {
      read_coordinates(begin, batch);
    }
    next_ += count;
    return true;
  }

 private:
  static constexpr std::array<const char*, 3> kAxes{"x", "y", "z"};

  void read_coordinates(std::uint64_t begin, PointBatch& batch) {
    const std::size_t block_points = std::max<std::size_t>(1, kReadBlockBytes / info_.record_bytes);
    block_.resize(std::min(block_points, batch.count) * info_.record_bytes);
    for (std::size_t first = 0; first < batch.count; first += block_points) {
      const std::size_t count = std::min(block_points, batch.count - first);
      file_->read(begin + first * info_.record_bytes, std::span(block_).first(count * info_.record_bytes));
      decode(block_.data(), first, count, batch);
    }
  }

  void decode(const std::byte* records, std::size_t first, std::size_t count, PointBatch& batch) const {
    const std::array<double*, 3> out{batch.x.data() + first, batch.y.data() + first, batch.z.data() + first};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::byte* at = records + offsets_[axis];
      if (header_.format == PlyFormat::kBigEndian) {
        decode_axis_of_type<std::endian::big>(types_[axis], at, info_.record_bytes, count, out[axis]);
      } else {
        decode_axis_of_type<std::endian::little>(types_[axis], at, info_.record_bytes, count, out[axis]);
      }
    }
  }

  std::shared_ptr<const InputFile> file_;
  PlyHeader header_;
  SourceInfo info_;
  std::uint64_t begin_ = 0;  ///< Offset in the file of the first vertex.
  std::array<ScalarType, 3> types_{};
  std::array<std::size_t, 3> offsets_{};
  std::uint64_t next_ = 0;
  std::vector<std::byte> block_;
};

/// Ascii vertices, and binary ones with lists: records of any size, found by reading them.
class PlyWalkedSource final : public PointSource {
 public:
  PlyWalkedSource(std::shared_ptr<const InputFile> file, PlyHeader header, Tolerance tolerance)
      : file_(std::move(file)),
        header_(std::move(header)),
        info_(make_info(*file_, header_, tolerance)),
        window_(*file_),
        walker_(header_.format, header_.vertices(),
                {header_.vertices().find("x"), header_.vertices().find("y"), header_.vertices().find("z")}) {
    begin_ = find_ply_element(*file_, header_, header_.vertex);
    salvage_vertices(*file_, header_, begin_, info_);
    check_count();
    PlyWalkedSource::rewind();
  }

  const SourceInfo& info() const override { return info_; }

  void rewind() override {
    next_ = 0;
    mid_line_ = false;
    window_.seek(begin_);
  }

  bool read(PointBatch& batch, const ReadOptions& options) override {
    const auto most = static_cast<std::size_t>(
        std::min<std::uint64_t>(std::max<std::size_t>(1, options.batch_points), info_.points - next_));
    start_batch(batch, next_, most);
    batch.records.clear();
    batch.record_begin.clear();
    std::size_t bytes = 0;
    std::size_t count = 0;
    for (; count < most && (count == 0 || bytes + walker_.end() <= kBatchBytes); ++count) {
      read_ply_record(*file_, header_, header_.vertex, next_ + count, window_, walker_);
      mid_line_ = mid_line_ || (next_ + count > 0 && !walker_.follows_line_end());
      batch.x[count] = walker_.value(0);
      batch.y[count] = walker_.value(1);
      batch.z[count] = walker_.value(2);
      if (options.records) keep_record(batch);
      bytes += walker_.end();
      window_.consume(walker_.end());
    }
    if (options.records) batch.record_begin.push_back(batch.records.size());
    if (count < most) start_batch(batch, next_, count);
    next_ += count;
    if (count > 0 && next_ == info_.points) check_rest();
    return count > 0;
  }

 private:
  void keep_record(PointBatch& batch) const {
    const auto record = window_.bytes().first(walker_.end()).subspan(walker_.begin());
    batch.record_begin.push_back(batch.records.size());
    batch.records.insert(batch.records.end(), record.begin(), record.end());
  }

  /// A count that even the shortest records could not fill is refused at once; an exact check needs the records.
  void check_count() const {
    const std::uint64_t left = file_->size_bytes() - begin_;
    // A value in ascii takes a digit and a blank; the last blank may be missing.
    const std::size_t least = header_.format == PlyFormat::kAscii ? 2 * header_.vertices().properties.size()
                                                                  : header_.vertices().least_bytes();
    if (info_.points <= (left + 1) / least) return;
    refuse(*file_, begin_,
           fmt::format("the header counts {} vertices, but the {} bytes from here on hold at most {}", info_.points,
                       left, (left + 1) / least),
           "copy or export the file again, or read what is there with --salvage");
  }

  /// Values behind the last vertex of an ascii file that has nothing else: if vertices did not keep to lines either,
  /// they were read out of step with the header's properties.
  void check_rest() {
    const bool last = std::all_of(header_.elements.begin() + static_cast<std::ptrdiff_t>(header_.vertex) + 1,
                                  header_.elements.end(), [](const PlyElement& element) { return element.count == 0; });
    if (header_.format != PlyFormat::kAscii || !last || info_.points < header_.vertices().count) return;
    const auto is_value = [](std::byte b) {
      const char c = static_cast<char>(b);
      return c != ' ' && (c < '\t' || c > '\r');
    };
    do {
      const auto bytes = window_.bytes();
      const auto value = std::find_if(bytes.begin(), bytes.end(), is_value);
      window_.consume(static_cast<std::size_t>(value - bytes.begin()));
      if (value != bytes.end()) return note_rest(window_.position());
    } while (window_.extend());
  }

  void note_rest(std::uint64_t byte) {
    if (mid_line_) {
      refuse(*file_, byte,
             fmt::format("values remain after vertex {} and vertices do not end with their lines", info_.points),
             "the header declares fewer properties than the lines have: correct it or export the file again");
    }
    const Problem problem{"trailing-bytes",
                          fmt::format("values follow the {} vertices that the header counts", info_.points), byte};
    if (info_.tolerance == Tolerance::kStrict) refuse_problem(*file_, problem);
    const bool known = std::any_of(info_.problems.begin(), info_.problems.end(),
                                   [](const Problem& p) { return p.code == "trailing-bytes"; });
    if (!known) info_.problems.push_back(problem);
  }

  std::shared_ptr<const InputFile> file_;
  PlyHeader header_;
  SourceInfo info_;
  FileWindow window_;
  PlyRecordWalker walker_;
  std::uint64_t begin_ = 0;  ///< Offset in the file of the first vertex or the white space before it.
  std::uint64_t next_ = 0;
  bool mid_line_ = false;  ///< A vertex began within the line of the one before.
};

}  // namespace

std::unique_ptr<PointSource> open_ply_source(std::shared_ptr<const InputFile> file, Tolerance tolerance) {
  PlyHeader header = read_ply_header(*file);
  if (header.format != PlyFormat::kAscii && !header.vertices().has_list()) {
    return std::make_unique<PlyFixedSource>(std::move(file), std::move(header), tolerance);
  }
  return std::make_unique<PlyWalkedSource>(std::move(file), std::move(header), tolerance);
}

}  // namespace arris::io
