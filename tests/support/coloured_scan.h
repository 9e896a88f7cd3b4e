#pragma once
/// @file Scans with colours, written byte by byte.

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace arris::test {

struct ColouredPoint {
  std::array<std::int32_t, 3> position;  ///< Steps of 1 mm.
  std::array<double, 3> colour;          ///< As stored.
};

/// LAS 1.2, point format 2, scale 0.001.
void write_coloured_las(const std::filesystem::path& path, const std::vector<ColouredPoint>& points);

/// Binary little-endian, x y z as double. @param type  of red, green and blue: "uchar", "ushort" or "float".
void write_coloured_ply(const std::filesystem::path& path, const std::vector<ColouredPoint>& points,
                        const std::string& type);

/// A coloured room corner with a box in it, 0.01 m apart with some noise: floor, two walls, five faces of the box, each
/// in two colours of up to `full` per channel. About `side` squared points per large face.
std::vector<ColouredPoint> coloured_room(int side, double full);

}  // namespace arris::test
