#pragma once
/// @file Streams of points from files: what every format's reader offers to the rest of arris.

#include <array>
#include <bitset>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace arris::io {

enum class Format : std::uint8_t { kLas, kPly };

/// Something wrong or unusual in a file that can still be read. `code` is a stable identifier, `text` one printable
/// line.
struct Problem {
  std::string code;
  std::string text;
  std::uint64_t byte = 0;  ///< Where in the file.
};

/// What to do with files that do not keep to their format.
enum class Tolerance : std::uint8_t {
  kStrict,   ///< Every problem refuses the file.
  kUsual,    ///< Problems that leave the points in no doubt are reported; others refuse the file.
  kSalvage,  ///< Of a file that is cut short or counts no points, the whole points that are there are read.
};

/// What a file says of itself. Filled when the file is opened; the count is checked against the size of the file then.
struct SourceInfo {
  std::filesystem::path path;
  Format format = Format::kLas;
  std::string layout;  ///< For people: "LAS 1.4, point format 8, 94 bytes per point" / "PLY binary_little_endian 1.0".
  std::uint64_t size_bytes = 0;  ///< Of the file.
  std::uint64_t points = 0;      ///< Points that read() will deliver.
  /// True if coordinates are stored as scaled integers (LAS): world = offset + scale * integer, per axis.
  bool scaled_integers = false;
  std::array<double, 3> scale{1.0, 1.0, 1.0};
  std::array<double, 3> offset{0.0, 0.0, 0.0};
  /// Size of one original record; 0 where records have no fixed size (PLY ascii or with lists).
  std::size_t record_bytes = 0;
  bool has_classes = true;                  ///< Points are classified: LAS, and PLY with a property for it.
  std::vector<Problem> problems;            ///< Found while opening; worth a warning each.
  Tolerance tolerance = Tolerance::kUsual;  ///< With which it was opened.
  std::int64_t modified_ns = 0;             ///< Time of the file's last change, nanoseconds since 1970.
};

/// Points that are to take no part, by what LAS says of them. PLY points are excluded only by `only_classes`: then they
/// are judged by their classification property, and points without a whole number of 0 to 255 there are of no class.
struct PointExclusion {
  std::uint8_t flags = 0;         ///< Any of: 1 synthetic, 2 key point, 4 withheld, 8 overlap (also class 12 of 0-5).
  std::bitset<256> classes;       ///< Classifications.
  std::bitset<256> only_classes;  ///< If there are any: points of all other classes too.
  bool any() const { return flags != 0 || classes.any() || only_classes.any(); }
  /// `classes` and, if there are any, all but `only_classes`.
  std::bitset<256> excluded_classes() const { return only_classes.any() ? classes | ~only_classes : classes; }
};

/// Points as structure of arrays; capacity is reused from call to call.
struct PointBatch {
  std::uint64_t first_id = 0;  ///< Global id of the first point: its index over all inputs in the order given.
  std::size_t count = 0;
  /// Stored integers, `count` each; only if scaled_integers.
  std::vector<std::int32_t> ix, iy, iz;
  /// World coordinates, `count` each; only if not scaled_integers. May hold NaN and infinities. A number in a PLY ascii
  /// file is taken with all its digits, even where its property is declared float.
  std::vector<double> x, y, z;
  /// Nonzero for points that take no part; empty if nothing excludes any (ReadOptions::exclusion, InputSet).
  std::vector<std::uint8_t> excluded;
  /// Original records, only if asked for: point i occupies records[record_begin[i], record_begin[i + 1]).
  std::vector<std::byte> records;
  std::vector<std::size_t> record_begin;  ///< count + 1 entries, or empty.
};

/// Coordinate of a point of a batch read from that source, in world units.
inline double world_coordinate(const SourceInfo& source, const PointBatch& batch, std::size_t point, std::size_t axis) {
  if (!source.scaled_integers) return (axis == 0 ? batch.x : axis == 1 ? batch.y : batch.z)[point];
  const std::int32_t stored = (axis == 0 ? batch.ix : axis == 1 ? batch.iy : batch.iz)[point];
  return static_cast<double>(stored) * source.scale[axis] + source.offset[axis];
}

struct ReadOptions {
  bool records = false;  ///< Deliver the original records as well as the coordinates.
  /// Most points per batch, >= 1: so few stay in the caches. Records take 4 MiB at most, or one longer record.
  std::size_t batch_points = 16 * 1024;
  PointExclusion exclusion{};  ///< An InputSet applies it, if it names any, in place of its own exclusion and filters.
};

/// One file as a rewindable stream. Memory is bounded by the batch and a fixed read buffer (not mapped: a file that is
/// cut short while we read gives an InputError, not a signal). Not thread-safe; different sources are independent.
class PointSource {
 public:
  virtual ~PointSource() = default;
  /// Problems that only reading can show are added when the last point has been read.
  virtual const SourceInfo& info() const = 0;
  /// Starts over from the first point.
  virtual void rewind() = 0;
  /// Fills `batch` with the next points and returns true, or returns false (count = 0) after the last point. first_id
  /// counts from 0 within this source. Throws InputError for damaged content, IoError if reading fails.
  virtual bool read(PointBatch& batch, const ReadOptions& options) = 0;
  /// Goes on with that point, <= info().points, as if all before it had been read. False, and nothing changes, where
  /// records are not found by arithmetic.
  virtual bool skip_to(std::uint64_t /*point*/) { return false; }
};

/// Marks more points of a batch as excluded (`batch.excluded` has batch.count entries). It must give the same for the
/// same point in every pass. @param source  index of the batch's source.
using PointFilter = std::function<void(std::size_t source, PointBatch& batch)>;

class InputFile;

/// Throws the InputError that refuses a file for a problem under kStrict.
[[noreturn]] void refuse_problem(const InputFile& file, const Problem& problem);

/// Opens a file by its content ("LASF", "ply"), not by its name. Throws InputError / IoError.
std::unique_ptr<PointSource> open_point_source(std::shared_ptr<const InputFile> file,
                                               Tolerance tolerance = Tolerance::kUsual);
std::unique_ptr<PointSource> open_point_source(const std::filesystem::path& path,
                                               Tolerance tolerance = Tolerance::kUsual);

/// Expands arguments to files: a folder gives its *.las and *.ply files (any case, not recursive) in byte order of
/// their names. Throws InputError for missing paths and folders without any scan.
std::vector<std::filesystem::path> expand_inputs(std::span<const std::string> arguments);

/// Many files as one stream with global ids. Sources are opened lazily one at a time; infos are read at construction.
class InputSet {
 public:
  explicit InputSet(const std::vector<std::filesystem::path>& paths, Tolerance tolerance = Tolerance::kUsual);
  const std::vector<SourceInfo>& sources() const { return infos_; }
  std::uint64_t points() const { return points_; }
  void rewind();
  /// As PointSource::read, with global ids. A batch never crosses a file: source_index() tells which one it came from.
  bool read(PointBatch& batch, const ReadOptions& options);
  /// Goes on with the point of that global id, < points(). False, with nothing to rely on but rewind(), where a source
  /// cannot do so.
  bool skip_to(std::uint64_t id);
  std::size_t source_index() const { return current_; }
  /// For all reads from now on whose options name no exclusion of their own. Throws InputError if it asks for classes
  /// (only_classes) of a file that has none.
  void exclude(const PointExclusion& exclusion);
  /// For the same reads, on top of exclude() and of the filters before.
  void add_filter(PointFilter filter) { filters_.push_back(std::move(filter)); }
  /// Throws InputError if a file is no longer what it was when the set was made (size, time of change).
  void check_unchanged() const;

 private:
  void open_next();

  std::vector<SourceInfo> infos_;
  std::uint64_t points_ = 0;
  std::size_t current_ = 0;     ///< Source of the last batch delivered.
  std::size_t next_ = 0;        ///< Source to open next.
  std::uint64_t first_id_ = 0;  ///< Global id of the first point of the open source.
  std::unique_ptr<PointSource> open_;
  PointExclusion exclusion_;
  std::vector<PointFilter> filters_;
};

}  // namespace arris::io
