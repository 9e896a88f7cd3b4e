#include "evaluate_segments.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <limits>

#include "common_options.h"
#include "core/error.h"
#include "core/text.h"
#include "core/units.h"
#include "evaluate/segmentation_text.h"
#include "io/attribute_reader.h"
#include "io/point_source.h"
#include "progress_display.h"
#include "tiling/survey.h"

namespace arris::tools {
namespace {

using evaluate::LabelledPoint;

/// The labels in one column of a cloud, point by point.
class LabelStream {
 public:
  /// @param names  of the column, the first that the file has is taken. @param option  the one that chooses it.
  LabelStream(const std::string& path, const std::vector<std::string>& names, const std::string& option)
      : path_(path), source_(io::open_point_source(path)), attributes_(path, names) {
    while (column_ < names.size() && !attributes_.has(column_)) ++column_;
    if (column_ == names.size()) {
      throw ConfigError(fmt::format("{} has no column {}; name the one with the labels by {}", printable(path, 1000),
                                    printable(fmt::format("{}", fmt::join(names, " or "))), option));
    }
    name_ = names[column_];
    options_.records = true;
  }

  const std::string& name() const { return name_; }
  std::uint64_t points() const { return source_->info().points; }
  /// A coordinate of the file is known to about so much.
  double step(std::size_t axis) const { return source_->info().scaled_integers ? source_->info().scale[axis] : 0.0; }

  /// Calls use(index, position, label) for every point.
  template <class Use>
  void read(const CancelToken& cancel, const Use& use) {
    std::vector<double> values;
    for (io::PointBatch batch; source_->read(batch, options_);) {
      cancel.check();
      attributes_.read(batch, column_, values);
      const auto at = [&](std::size_t i, std::size_t axis) {
        return io::world_coordinate(source_->info(), batch, i, axis);
      };
      for (std::size_t i = 0; i < batch.count; ++i)
        use(batch.first_id + i, evaluate::Vec3{at(i, 0), at(i, 1), at(i, 2)}, label(batch.first_id + i, values[i]));
    }
  }

 private:
  /// NaN and numbers below 0 are other programs' ways to say "none".
  std::uint32_t label(std::uint64_t index, double value) const {
    if (!(value > 0.0)) return 0;
    if (value != std::floor(value) || value > std::numeric_limits<std::uint32_t>::max()) {
      throw ConfigError(fmt::format("{}: {} of point {} is {}; labels must be whole numbers below 2^32",
                                    printable(path_, 1000), printable(name_), index, value));
    }
    return static_cast<std::uint32_t>(value);
  }

  std::string path_, name_;
  std::unique_ptr<io::PointSource> source_;
  io::AttributeReader attributes_;
  io::ReadOptions options_;
  std::size_t column_ = 0;
};

bool same_place(const evaluate::Vec3& a, const evaluate::Vec3& b, const evaluate::Vec3& step) {
  const auto same = [](double p, double q, double allowed) {
    const double rounding = 1e-6 + 1e-7 * std::abs(p);  // PLY files often hold floats.
    return std::abs(p - q) <= allowed + rounding || (!std::isfinite(p) && !std::isfinite(q));
  };
  return same(a.x, b.x, step.x) && same(a.y, b.y, step.y) && same(a.z, b.z, step.z);
}

/// Labels point by point, and the name of the column that was judged.
struct Labelled {
  std::vector<LabelledPoint> points;
  std::string column;
};

Labelled read_points(const std::string& prediction, const SegmentsOptions& o, const CancelToken& cancel) {
  LabelStream truth(o.truth, {o.faces}, "--faces");
  LabelStream segments(
      prediction, o.segments.empty() ? std::vector<std::string>{"SupervoxelId", "SegmentId"} : std::vector{o.segments},
      "--segments");
  const std::string names = fmt::format("{} and {}", printable(prediction, 1000), printable(o.truth, 1000));
  if (truth.points() != segments.points()) {
    throw InputError(
        fmt::format("{} have {} and {} points; labels are compared point by point: give the same cloud, "
                    "all points in the same order",
                    names, segments.points(), truth.points()));
  }
  std::vector<LabelledPoint> points;
  points.reserve(truth.points());
  truth.read(cancel, [&](std::uint64_t, const evaluate::Vec3& position, std::uint32_t face) {
    points.push_back({position, 0, face});
  });
  const auto step = [&](std::size_t axis) { return std::max(truth.step(axis), segments.step(axis)); };
  const evaluate::Vec3 steps{step(0), step(1), step(2)};
  segments.read(cancel, [&](std::uint64_t index, const evaluate::Vec3& p, std::uint32_t segment) {
    LabelledPoint& point = points.at(index);
    if (!same_place(point.position, p, steps)) {
      const evaluate::Vec3& q = point.position;
      throw InputError(
          fmt::format("{} differ: point {} is at ({:.10g}, {:.10g}, {:.10g}) and ({:.10g}, {:.10g}, {:.10g}); labels "
                      "are compared point by point: give the same cloud, all points in the same order",
                      names, index, p.x, p.y, p.z, q.x, q.y, q.z));
    }
    point.segment = segment;
  });
  return {std::move(points), segments.name()};
}

double estimate_spacing(const std::string& path, const CancelToken& cancel) {
  ProgressDisplay silent(ProgressMode::kNever, -1);
  io::InputSet inputs({std::filesystem::path(path)});
  return tiling::survey_inputs(inputs, {}, silent, cancel).spacing;
}

}  // namespace

CLI::Option* add_segments_options(CLI::App& verb, SegmentsOptions& o) {
  CLI::Option* labels = verb.add_option(
      "--labels", o.truth,
      "Judge supervoxels or segments instead: the same cloud with the true surface of every point (synth --labels)");
  verb.add_option("--segments", o.segments,
                  "Column of the prediction with --labels (default: SupervoxelId, or else SegmentId)")
      ->needs(labels);
  verb.add_option("--faces", o.faces, "Column of the truth")->needs(labels)->capture_default_str();
  verb.add_option("--radius", o.radius,
                  "Points with one of another label so near are boundary points (length; default: 2 spacings)")
      ->needs(labels);
  verb.add_option("--voxel", o.voxel,
                  "Size R of the voxels that supervoxels were made with (length): judge their boundaries within R "
                  "sqrt(3) too")
      ->needs(labels);
  verb.add_flag(
          "--planes", o.planes,
          "Judge planes too: which are found, split, joined, how complete and correct they are (column SegmentId: "
          "always)")
      ->needs(labels);
  verb.add_option("--min-area", o.min_area,
                  "Planes of at least this area have figures of their own (square units; area: points times spacing²)")
      ->needs(labels)
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  return labels;
}

int evaluate_segments(const std::string& prediction, const SegmentsOptions& o, const std::string& spacing,
                      ResultFormat format, Session& session) {
  evaluate::SegmentationOptions options;
  if (!o.radius.empty()) options.radius = parse_length(o.radius);
  if (!o.voxel.empty()) options.voxel = parse_length(o.voxel);
  const auto [points, column] = read_points(prediction, o, session.cancel);
  if (o.planes || column == "SegmentId") options.min_plane_area = o.min_area;
  options.spacing = spacing.empty() ? estimate_spacing(o.truth, session.cancel) : parse_length(spacing);
  const evaluate::SegmentationComparison result = evaluate::compare_segmentation(points, options);
  write_text("-",
             format == ResultFormat::kJson  ? evaluate::to_json(result)
             : format == ResultFormat::kCsv ? evaluate::to_csv(result)
                                            : evaluate::to_table(result),
             false);
  return 0;
}

}  // namespace arris::tools
