#include "sound_las.h"

#include <algorithm>

namespace arris::test {
namespace {

std::string sound_record(std::uint64_t index, int format, std::size_t record_bytes) {
  std::string record(record_bytes, '\0');
  put<std::int32_t>(record, 0, static_cast<std::int32_t>(100 * index));
  put<std::int32_t>(record, 4, static_cast<std::int32_t>(50 * index));
  put<std::int32_t>(record, 8, static_cast<std::int32_t>(index));
  record[14] = format >= 6 ? '\x11' : '\x09';  // Return 1 of 1.
  return record;
}

}  // namespace

LasPlan sound_plan(int minor, int format, std::uint64_t points, std::size_t extra_bytes) {
  LasPlan plan;
  plan.minor = minor;
  plan.format = format;
  plan.record_bytes = kFormatBytes[static_cast<std::size_t>(format)] + extra_bytes;
  for (std::uint64_t i = 0; i < points; ++i) plan.points.push_back(sound_record(i, format, plan.record_bytes));
  return plan;
}

std::string sound_las(const LasPlan& plan) {
  std::string bytes = build_las(plan);
  const std::uint64_t points = plan.points.size();
  if (plan.format < 6) put<std::uint32_t>(bytes, las_at::kLegacyByReturn, static_cast<std::uint32_t>(points));
  if (plan.minor >= 4) put<std::uint64_t>(bytes, las_at::kByReturn, points);
  for (std::size_t axis = 0; axis < 3 && points > 0; ++axis) {
    std::int32_t least = get<std::int32_t>(plan.points[0], 4 * axis);
    std::int32_t largest = least;
    for (const std::string& record : plan.points) {
      least = std::min(least, get<std::int32_t>(record, 4 * axis));
      largest = std::max(largest, get<std::int32_t>(record, 4 * axis));
    }
    put<double>(bytes, las_at::kBounds + 16 * axis, largest * plan.scale[axis] + plan.offset[axis]);
    put<double>(bytes, las_at::kBounds + 16 * axis + 8, least * plan.scale[axis] + plan.offset[axis]);
  }
  return bytes;
}

}  // namespace arris::test
