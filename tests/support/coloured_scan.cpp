#include "support/coloured_scan.h"

#include <cstring>

#include "support/las_tools.h"

namespace arris::test {
namespace {

template <typename T>
void append(std::string& bytes, T value) {
  const std::size_t at = bytes.size();
  bytes.resize(at + sizeof value);
  std::memcpy(bytes.data() + at, &value, sizeof value);
}

}  // namespace

void write_coloured_las(const std::filesystem::path& path, const std::vector<ColouredPoint>& points) {
  std::vector<std::array<std::int32_t, 3>> positions;
  for (const ColouredPoint& p : points) positions.push_back(p.position);
  write_las(path, positions);
  const LasView plain = view_las(path);
  constexpr std::uint16_t kRecordBytes = 26;
  constexpr char kFirstOfOne = 1 | 1 << 3;  // Return, as the header counts them.
  std::string bytes = plain.bytes.substr(0, plain.offset_to_points);
  bytes[104] = 2;
  std::memcpy(bytes.data() + 105, &kRecordBytes, sizeof kRecordBytes);
  for (std::size_t i = 0; i < points.size(); ++i) {
    bytes.append(plain.record(i), plain.record_bytes);
    bytes[bytes.size() - plain.record_bytes + 14] = kFirstOfOne;
    for (const double channel : points[i].colour) append(bytes, static_cast<std::uint16_t>(channel));
  }
  write_bytes(path, bytes);
}

void write_coloured_ply(const std::filesystem::path& path, const std::vector<ColouredPoint>& points,
                        const std::string& type) {
  std::string bytes = "ply\nformat binary_little_endian 1.0\nelement vertex " + std::to_string(points.size()) + "\n";
  for (const char* name : {"double x", "double y", "double z"}) bytes += std::string("property ") + name + "\n";
  for (const char* name : {"red", "green", "blue"}) bytes += "property " + type + " " + name + "\n";
  bytes += "end_header\n";
  for (const ColouredPoint& p : points) {
    for (const std::int32_t step : p.position) append(bytes, 0.001 * step);
    for (const double channel : p.colour) {
      if (type == "uchar") append(bytes, static_cast<std::uint8_t>(channel));
      if (type == "ushort") append(bytes, static_cast<std::uint16_t>(channel));
      if (type == "float") append(bytes, static_cast<float>(channel));
    }
  }
  write_bytes(path, bytes);
}

std::vector<ColouredPoint> coloured_room(int side, double full) {
  std::vector<ColouredPoint> points;
  std::uint32_t state = 5;
  const auto random = [&](std::uint32_t below) {
    return static_cast<std::int32_t>((state = state * 1664525U + 1013904223U) >> 16) % static_cast<std::int32_t>(below);
  };
  constexpr std::int32_t kSpacing = 10;
  // A face: its normal's axis, where it lies on that axis, and its square on the two others.
  const auto face = [&](std::size_t axis, std::int32_t at, std::array<std::int32_t, 3> corner, int points_wide) {
    for (int i = 0; i < points_wide; ++i) {
      for (int j = 0; j < points_wide; ++j) {
        ColouredPoint p{corner, {}};
        p.position[axis] = at + random(3) - 1;
        p.position[(axis + 1) % 3] += kSpacing * i + random(5) - 2;
        p.position[(axis + 2) % 3] += kSpacing * j + random(5) - 2;
        const bool half = i * 2 < points_wide;
        for (std::size_t c = 0; c < 3; ++c) {
          const double share = c == axis ? 1.0 : half ? 0.5 : 0.1;
          p.colour[c] = full * share * (1.0 - 0.05 * random(3));
        }
        points.push_back(p);
      }
    }
  };
  for (std::size_t axis = 0; axis < 3; ++axis) face(axis, 0, {0, 0, 0}, side);
  const std::int32_t low = kSpacing * side / 4;
  const int wide = side / 3;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    face(axis, low + kSpacing * wide, {low, low, low}, wide);
    face(axis, low, {low, low, low}, wide);
  }
  return points;
}

}  // namespace arris::test
