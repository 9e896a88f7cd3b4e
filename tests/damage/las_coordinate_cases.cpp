/// @file Scales, offsets and bounds that are no numbers to compute with.

#include <limits>

#include "damaged_file.h"
#include "sound_las.h"

namespace arris::test {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

struct Value {
  const char* name;
  double number;
};

void add_scales(DamagedFiles& files) {
  const std::string sound = sound_las(2, 0);
  constexpr const char* kAxes = "xyz";
  for (std::size_t axis = 0; axis < 3; ++axis) {
    // 1e308 times the largest integer is infinite.
    for (const Value& v : {Value{"0", 0.0}, Value{"-0", -0.0}, Value{"nan", kNan}, Value{"inf", kInf},
                           Value{"-inf", -kInf}, Value{"1e308", 1e308}, Value{"-1e308", -1e308}}) {
      files.push_back(refused(std::string("las-scale-") + kAxes[axis] + "-" + v.name,
                              with(sound, las_at::kScale + 8 * axis, v.number)));
    }
    for (const Value& v : {Value{"nan", kNan}, Value{"inf", kInf}, Value{"-inf", -kInf}}) {
      files.push_back(refused(std::string("las-offset-") + kAxes[axis] + "-" + v.name,
                              with(sound, las_at::kOffset + 8 * axis, v.number))
                          .at(las_at::kOffset + 8 * axis));
    }
  }
  files.push_back(
      refused("las-scale-1e299-offset-1.7e308", with(with(sound, las_at::kScale, 1e299), las_at::kOffset, 1.7e308)));
}

/// Odd but computable.
void add_extreme_scales(DamagedFiles& files) {
  const std::string sound = sound_las(2, 0);
  for (const Value& v : {Value{"negative", -0.01}, Value{"1e290", 1e290}, Value{"1e-300", 1e-300},
                         Value{"denormal", std::numeric_limits<double>::denorm_min()}}) {
    files.push_back(
        read_whole(std::string("las-scale-") + v.name, with(sound, las_at::kScale, v.number), kSoundPoints));
  }
  for (const Value& v : {Value{"1e300", 1e300}, Value{"-1e300", -1e300}}) {
    files.push_back(
        read_whole(std::string("las-offset-") + v.name, with(sound, las_at::kOffset, v.number), kSoundPoints));
  }
  std::string mixed = with(sound, las_at::kScale, 1e290);
  put(mixed, las_at::kScale + 8, 1e-290);
  files.push_back(read_whole("las-scales-of-580-decades", mixed, kSoundPoints));
}

/// The box of the header is only a claim.
void add_bounds(DamagedFiles& files) {
  const std::string sound = sound_las(2, 0);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::size_t max_at = las_at::kBounds + 16 * axis;
    const std::string suffix(1, "xyz"[axis]);
    const auto add = [&](const std::string& name, std::size_t place, double value) {
      files.push_back(
          reported("las-bounds-" + name + "-" + suffix, with(sound, place, value), "bounds-invalid", kSoundPoints));
    };
    add("max-nan", max_at, kNan);
    add("min-nan", max_at + 8, kNan);
    add("max-inf", max_at, kInf);
    add("swapped", max_at, -1e9);
  }
  std::string zero = sound;
  for (std::size_t i = 0; i < 6; ++i) put(zero, las_at::kBounds + 8 * i, 0.0);
  files.push_back(read_whole("las-bounds-zero", zero, kSoundPoints));
}

/// Integers at the ends of their range.
void add_extreme_points(DamagedFiles& files) {
  LasPlan plan = sound_plan(4, 6, 3);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    put(plan.points[0], 4 * axis, std::numeric_limits<std::int32_t>::min());
    put(plan.points[1], 4 * axis, std::numeric_limits<std::int32_t>::max());
  }
  files.push_back(read_whole("las-points-at-the-ends-of-int32", sound_las(plan), 3));
}

}  // namespace

DamagedFiles las_coordinate_cases() {
  DamagedFiles files;
  add_scales(files);
  add_extreme_scales(files);
  add_bounds(files);
  add_extreme_points(files);
  return files;
}

}  // namespace arris::test
