#pragma once
/// @file What a scanner at one place sees: the nearest face along a ray, for rays that come column by column. Private
/// to synth.

#include <array>
#include <cstdint>
#include <vector>

#include "synth/scene_model.h"

namespace arris::synth {

struct RayHit {
  double range = 0.0;      ///< 0: nothing within the maximum range.
  double cosine = 0.0;     ///< Of the angle of incidence, [0, 1].
  std::uint32_t face = 0;  ///< Index into the model's faces.
  friend bool operator==(const RayHit&, const RayHit&) = default;
};

/// Planes and upright cylinders as seen from one position. Rays of one azimuth share the list of faces that can be hit,
/// sorted by elevation; within a list faces come nearest first, so that most rays end after one or two tests. Culling
/// is conservative: cast() and cast_all() agree exactly. Immutable; a Column belongs to one thread.
class RayCaster {
 public:
  /// @param model  must outlive the caster; planes and cylinders along z only.
  RayCaster(const SceneModel& model, const Vec3& position, double max_range);

  /// Scratch memory and state for the rays of one azimuth.
  struct Column {
    double sin = 0.0, cos = 1.0;  ///< Of the azimuth, from x towards y.
    static constexpr std::size_t kBins = 64;
    std::array<std::vector<std::uint32_t>, kBins> bins;  ///< By elevation: indices of targets.
  };
  void start_column(Column& column, double azimuth_sin, double azimuth_cos) const;
  RayHit cast(const Column& column, double elevation_sin, double elevation_cos) const;
  /// The same without culling, for tests: O(faces).
  RayHit cast_all(const Column& column, double elevation_sin, double elevation_cos) const;

 private:
  struct Target {
    const Face* face = nullptr;
    std::uint32_t index = 0;
    double min_range = 0.0;  ///< No point of the face is nearer.
    bool all_azimuths = false;
    double azimuth = 0.0, half_width = 0.0;  ///< Radians; seen within azimuth +- half_width.
    double min_elevation_sin = -1.0, max_elevation_sin = 1.0;
    double ou = 0.0, ov = 0.0, ow = 0.0;  ///< The scanner in the frame of the face.
  };
  static Target make_target(const Face& face, std::uint32_t index, const Vec3& position);
  void intersect(const Target& target, const Vec3& direction, RayHit& best) const;

  double max_range_;
  std::vector<Target> targets_;  ///< Nearest first.
};

}  // namespace arris::synth
