#pragma once
/// @file From a place on a face to a point of a scan: noise, outliers, what the surface is made of. Private to synth.

#include <cstdint>

#include "io/point_writer.h"
#include "synth/counter_random.h"
#include "synth/scene_model.h"

namespace arris::synth {

struct PointFinish {
  double noise = 0.0;            ///< Standard deviation per axis.
  double outliers = 0.0;         ///< Share, in [0, 1).
  Box3 outlier_box;              ///< Where those are.
  double intensity_noise = 0.0;  ///< Standard deviation, relative.
};

io::FreshPoint finished_point(const PointFinish& finish, const Face& face, std::uint16_t face_number, Vec3 position,
                              PointRandom& random);

}  // namespace arris::synth
