#pragma once
/// @file Analytic scenes with exact truth, as streams of points in bounded memory.
///
///     SceneRequest request;
///     request.scene = "block";
///     request.points = 100'000'000;
///     const Scene scene(request);
///     auto stream = scene.stream();
///     for (std::vector<io::FreshPoint> block; stream->next(block);) writer.append(block);
///     evaluate::write_truth_csv(out, scene.truth());
///
/// Laws: (1) the points depend on the request only: not on the machine, the block size or the number of threads; (2)
/// without noise and outliers every point lies on a face, with an error of a few units in the last place; (3) truth
/// edges lie on faces; (4) rotation and shift move points and truth alike.

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "evaluate/truth.h"
#include "io/point_writer.h"
#include "synth/scene_catalog.h"

namespace arris::synth {

/// kModel: all edges of the model, seen or not. kScan: what the points show (header of scan_truth.h states the rules):
/// seen parts of the model's edges, and borders of what the stations see, each with its local spacing.
enum class TruthOf : std::uint8_t { kModel, kScan };

struct SceneRequest {
  std::string scene;  ///< A name from list_scenes().
  /// Data units, metres by default scenes; 0: the scene's default. Surface scenes: one point per spacing² of face (per
  /// spacing³ of volume). Scanned scenes: distance of neighbouring rays at 10 m range.
  double spacing = 0.0;
  std::uint64_t points = 0;  ///< Above 0: choose the spacing that gives about so many points; spacing must then be 0.
  double noise = 0.0;        ///< Standard deviation, data units; per axis, scanned scenes: along the ray.
  /// Surface scenes only; a cell is one spacing² of a face, cut so that a whole number of cells spans the face:
  /// "grid": the middle of every cell, so half a spacing from the face's sides; "jittered" (default): moved by up to
  /// 0.3 cells per axis, uniformly; "random": a Poisson process of one point per cell on average; "gradient": the same,
  /// thinned along x so that the local spacing grows linearly to sqrt(10) of `spacing` (density 10:1); "scan": lines 2
  /// spacings apart with a point every 1/2 spacing, each line with its own phase; "poisson": Poisson discs, no two
  /// points of a face nearer than 0.72 spacings (before noise; volumes: as "random"). Cells are cut anew on every face:
  /// no shared edge is sampled twice.
  std::string sampling = "jittered";
  std::uint64_t seed = 1;
  /// Share of points, [0, 1), that are put anywhere in the scene's box grown by 10 % (class 7); scanned scenes: at a
  /// random range before the surface.
  double outliers = 0.0;
  std::array<double, 3> shift{0.0, 0.0, 0.0};  ///< Added last.
  bool rotate = false;                         ///< By a rotation drawn from the seed, about the scene's origin.
  std::map<std::string, double> options;       ///< Of the scene, see list_scenes().
};

/// Pulls the points. Memory: about 2 * block_points * sizeof(FreshPoint), more only if one row of a face is longer than
/// that.
class ScenePointStream {
 public:
  ~ScenePointStream();
  /// Replaces `block` by the next points, made in parallel; false and an empty block at the end. Not thread-safe.
  bool next(std::vector<io::FreshPoint>& block);

 private:
  friend class Scene;
  struct Impl;
  explicit ScenePointStream(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

/// Immutable; safe to use from several threads. FreshPoint::point_source_id is the number of the face from 1 (0:
/// outlier), or of the station in scanned scenes. FreshPoint::label is the number of the surface from 1, in all scenes:
/// touching faces in one plane, on one cylinder or on one sphere are one surface. It is 0 for outliers, mixed pixels
/// and points of volumes.
class Scene {
 public:
  /// Throws ConfigError for anything in the request that is unknown or out of range.
  explicit Scene(const SceneRequest& request);
  ~Scene();
  Scene(Scene&&) noexcept;
  Scene& operator=(Scene&&) noexcept;

  const SceneInfo& info() const;
  double spacing() const;  ///< The one given, chosen or default.
  double expected_points()
      const;  ///< The stream delivers as many within a few percent (random samplings: sqrt of it more).
  const std::vector<evaluate::TruthEdge>& edges() const;  ///< Of the model, rotated and shifted.
  /// True if the scene is scanned from stations.
  bool scanned() const;
  /// Edges and the properties scene, spacing, noise, sampling, seed, outliers, expected_points, shift, rotate and the
  /// options; scanned scenes also truth_of. @param of  kScan is the same as kModel unless the scene is scanned; then it
  /// takes seconds for a town.
  evaluate::Truth truth(TruthOf of = TruthOf::kScan) const;
  /// Box of the faces, rotated and shifted, noise and outliers not counted: for the choice of a file's offset.
  std::array<std::array<double, 3>, 2> bounds() const;
  /// Exact distance of a point (rotated and shifted) to the nearest face; O(log faces).
  double distance(const std::array<double, 3>& point) const;

  /// Several streams are independent. The scene must outlive its streams.
  std::unique_ptr<ScenePointStream> stream(std::size_t block_points = 256 * 1024) const;

 private:
  friend class ScenePointStream;
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// "grid", "jittered", "random", "gradient", "scan", "poisson".
const std::vector<std::string>& list_samplings();

}  // namespace arris::synth
