#include "synth/point_finish.h"

#include <algorithm>

namespace arris::synth {

io::FreshPoint finished_point(const PointFinish& finish, const Face& face, std::uint16_t face_number, Vec3 position,
                              PointRandom& random) {
  io::FreshPoint point;
  const bool outlier = finish.outliers > 0.0 && random.uniform() < finish.outliers;
  if (outlier) {
    const Vec3 size = finish.outlier_box.max - finish.outlier_box.min;
    position =
        finish.outlier_box.min + Vec3{random.uniform() * size.x, random.uniform() * size.y, random.uniform() * size.z};
  } else if (finish.noise > 0.0) {
    position = position + finish.noise * Vec3{random.normal(), random.normal(), random.normal()};
  }
  point.x = position.x;
  point.y = position.y;
  point.z = position.z;
  double reflectance = face.material.reflectance;
  if (finish.intensity_noise > 0.0) {
    reflectance = std::clamp(reflectance * (1.0 + finish.intensity_noise * random.normal()), 0.0, 1.0);
  }
  point.intensity = static_cast<std::uint16_t>(65535.0 * reflectance);
  point.classification = outlier ? std::uint8_t{7} : face.material.classification;
  point.point_source_id = outlier ? std::uint16_t{0} : face_number;
  point.label = outlier ? 0 : face.surface;
  point.red = face.material.red;
  point.green = face.material.green;
  point.blue = face.material.blue;
  return point;
}

}  // namespace arris::synth
