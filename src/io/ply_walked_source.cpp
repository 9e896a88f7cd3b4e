#include <fmt/format.h>

#include <algorithm>

#include "io/ply_body.h"
#include "io/ply_field_names.h"
#include "io/ply_vertices.h"
#include "io/read_limits.h"

namespace arris::io {
namespace {

/// Ascii vertices, and binary ones with lists: records of any size, found by reading them.
class PlyWalkedSource final : public PointSource {
 public:
  PlyWalkedSource(std::shared_ptr<const InputFile> file, PlyHeader header, Tolerance tolerance)
      : file_(std::move(file)),
        header_(std::move(header)),
        info_(make_ply_info(*file_, header_, tolerance)),
        window_(*file_),
        walker_(header_.format, header_.vertices(), wanted(header_.vertices())) {
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
    start_ply_batch(batch, next_, most, options.exclusion);
    const bool by_class = info_.has_classes && options.exclusion.only_classes.any();
    labels_.clear();
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
      if (by_class) labels_.push_back(walker_.value(3));
      if (options.records) keep_record(batch);
      bytes += walker_.end();
      window_.consume(walker_.end());
    }
    if (options.records) batch.record_begin.push_back(batch.records.size());
    if (count < most) start_ply_batch(batch, next_, count, options.exclusion);
    if (by_class) mark_excluded(options.exclusion, labels_, 0, batch);
    next_ += count;
    if (count > 0 && next_ == info_.points) check_rest();
    return count > 0;
  }

 private:
  static std::vector<int> wanted(const PlyElement& vertices) {
    std::vector<int> properties{vertices.find("x"), vertices.find("y"), vertices.find("z")};
    const int classes = find_ply_field(vertices, "classification");
    if (classes >= 0) properties.push_back(classes);
    return properties;
  }

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
  std::vector<double> labels_;  ///< Classifications of a batch.
  bool mid_line_ = false;       ///< A vertex began within the line of the one before.
};

}  // namespace

std::unique_ptr<PointSource> open_ply_walked_source(std::shared_ptr<const InputFile> file, PlyHeader header,
                                                    Tolerance tolerance) {
  return std::make_unique<PlyWalkedSource>(std::move(file), std::move(header), tolerance);
}

}  // namespace arris::io
