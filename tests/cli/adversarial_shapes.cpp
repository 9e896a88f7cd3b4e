#include "adversarial_shapes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <fstream>
#include <numbers>
#include <stdexcept>

#include "support/las_stream.h"
#include "support/las_tools.h"

namespace arris::test {
namespace {

using Position = std::array<std::int32_t, 3>;  ///< In millimetres.
using Paths = std::vector<std::filesystem::path>;
using Shape = std::function<Position(std::uint32_t i)>;

/// Uniform in [0, 1): a function of its arguments alone (SplitMix64).
double random_of(std::uint32_t i, std::uint32_t stream) {
  std::uint64_t z = (std::uint64_t{i} << 3 | stream) * 0x9E3779B97F4A7C15ULL;
  z = (z ^ z >> 30) * 0xBF58476D1CE4E5B9ULL;
  z = (z ^ z >> 27) * 0x94D049BB133111EBULL;
  return static_cast<double>((z ^ z >> 31) >> 11) * 0x1p-53;
}

std::int32_t random_below(std::int32_t end, std::uint32_t i, std::uint32_t stream) {
  return static_cast<std::int32_t>(end * random_of(i, stream));
}

Paths write_shape(const std::filesystem::path& path, std::uint32_t points, const Shape& shape, int extra_doubles = 0) {
  LasStream file(path, 0.001, extra_doubles);
  for (std::uint32_t i = 0; i < points; ++i) file.add(shape(i));
  file.finish();
  return {path};
}

std::int32_t side_of(std::uint32_t points, double power) {
  return static_cast<std::int32_t>(std::ceil(std::pow(points, power)));
}

/// Roofs of 12.8 m in lines of points 5 cm apart, as a scanner on an aircraft sees them.
Shape lines_of_roofs(std::uint32_t points) {
  const auto side = static_cast<std::uint32_t>(side_of(points, 0.5));
  return [=](std::uint32_t i) -> Position {
    const auto x = static_cast<std::int32_t>(i % side), y = static_cast<std::int32_t>(i / side);
    const std::int32_t from_ridge = std::abs(x % 256 - 128);
    return {50 * x + random_below(20, i, 0), 50 * y + random_below(20, i, 1),
            8000 - 30 * from_ridge + 2000 * (y / 256 % 2) + random_below(4, i, 2)};
  };
}

Paths coincident(const std::filesystem::path& folder, std::uint32_t points) {
  return write_shape(folder / "coincident.las", points, [](std::uint32_t) -> Position { return {1234, -567, 89}; });
}

Paths solid_cube(const std::filesystem::path& folder, std::uint32_t points) {
  const std::int32_t side = side_of(points, 1.0 / 3.0);
  return write_shape(folder / "cube.las", points, [=](std::uint32_t i) -> Position {
    const auto n = static_cast<std::int32_t>(i);
    return {100 * (n % side) + random_below(100, i, 0), 100 * (n / side % side) + random_below(100, i, 1),
            100 * (n / side / side) + random_below(100, i, 2)};
  });
}

/// One point in ten over a square kilometre, the others on a roof of 4 m.
Paths hot_tile(const std::filesystem::path& folder, std::uint32_t points) {
  return write_shape(folder / "hot.las", points, [](std::uint32_t i) -> Position {
    if (i % 10 == 0)
      return {random_below(1'000'000, i, 0) - 500'000, random_below(1'000'000, i, 1) - 500'000, random_below(20, i, 2)};
    const std::int32_t x = random_below(4000, i, 0);
    return {x, random_below(4000, i, 1), 6000 - std::abs(x - 2000) / 2 + random_below(3, i, 2)};
  });
}

/// A round of ground whose density falls with the square of the range, and a wall, twice: 1000 km apart.
Paths two_stations(const std::filesystem::path& folder, std::uint32_t points) {
  return write_shape(folder / "stations.las", points, [](std::uint32_t i) -> Position {
    const std::int32_t station = i % 2 == 0 ? -500'000'000 : 500'000'000;
    const double azimuth = 2.0 * std::numbers::pi * random_of(i, 0);
    const double range = 1000.0 * std::pow(100.0, random_of(i, 1));  // 1 m to 100 m.
    const double x = range * std::cos(azimuth), y = range * std::sin(azimuth);
    if (x > 20'000.0) {  // The wall takes what would lie behind it.
      return {station + 20'000 + random_below(6, i, 2), static_cast<std::int32_t>(y * 20'000.0 / x),
              static_cast<std::int32_t>(1700.0 * (1.0 - 20'000.0 / x))};
    }
    return {station + static_cast<std::int32_t>(x), static_cast<std::int32_t>(y), random_below(6, i, 2)};
  });
}

/// Roofs, and a point 10^9 m away, in coordinates of type double.
Paths far_point(const std::filesystem::path& folder, std::uint32_t points) {
  const Shape shape = lines_of_roofs(points - 1);
  const auto path = folder / "far.ply";
  std::ofstream file(path, std::ios::binary);
  file << "ply\nformat binary_little_endian 1.0\nelement vertex " << points
       << "\nproperty double x\nproperty double y\nproperty double z\nend_header\n";
  for (std::uint32_t i = 0; i < points; ++i) {
    std::array<double, 3> xyz{1e9, 0.0, 0.0};
    if (i != points / 2) {
      const Position p = shape(i - (i > points / 2 ? 1 : 0));
      for (std::size_t axis = 0; axis < 3; ++axis) xyz[axis] = 0.001 * p[axis];
    }
    std::array<char, sizeof xyz> bytes{};
    std::memcpy(bytes.data(), xyz.data(), sizeof xyz);
    file.write(bytes.data(), bytes.size());
  }
  file.close();
  if (!file) throw std::runtime_error("cannot write " + path.string());
  return {path};
}

/// Single points all over a cube of 4000 km.
Paths lone_points(const std::filesystem::path& folder, std::uint32_t points) {
  return write_shape(folder / "lone.las", points, [](std::uint32_t i) -> Position {
    Position p{};
    for (std::uint32_t axis = 0; axis < 3; ++axis)
      p[axis] = static_cast<std::int32_t>(4e9 * (random_of(i, axis) - 0.5));
    return p;
  });
}

Paths hundred_files(const std::filesystem::path& folder, std::uint32_t points) {
  const Shape shape = lines_of_roofs(points);
  Paths paths;
  for (std::uint32_t part = 0; part < 100; ++part) {
    const auto bound = [&](std::uint32_t k) { return static_cast<std::uint32_t>(std::uint64_t{points} * k / 100); };
    const std::uint32_t begin = bound(part);
    paths.push_back(folder / ("part" + std::to_string(100 + part) + ".las"));
    write_shape(paths.back(), bound(part + 1) - begin, [&](std::uint32_t i) { return shape(begin + i); });
  }
  return paths;
}

Paths extra_bytes(const std::filesystem::path& folder, std::uint32_t points) {
  return write_shape(folder / "extra.las", points, lines_of_roofs(points), 7);
}

Paths line_order(const std::filesystem::path& folder, std::uint32_t points) {
  return write_shape(folder / "lines.las", points, lines_of_roofs(points));
}

/// The points of line_order, each far from the last.
Paths scattered_order(const std::filesystem::path& folder, std::uint32_t points) {
  const Shape shape = lines_of_roofs(points);
  constexpr std::uint64_t kPrime = 2'654'435'761;  // Visits all where it does not divide their number.
  return write_shape(folder / "scattered.las", points,
                     [&](std::uint32_t i) { return shape(static_cast<std::uint32_t>(kPrime * i % points)); });
}

}  // namespace

const std::vector<AdversarialShape>& adversarial_shapes() {
  static const std::vector<AdversarialShape> shapes{
      {"coincident", coincident},          {"solid_cube", solid_cube},   {"hot_tile", hot_tile},
      {"two_stations", two_stations},      {"far_point", far_point},     {"lone_points", lone_points},
      {"hundred_files", hundred_files},    {"extra_bytes", extra_bytes}, {"line_order", line_order},
      {"scattered_order", scattered_order}};
  return shapes;
}

const AdversarialShape& adversarial_shape(const std::string& name) {
  const auto found = std::ranges::find(adversarial_shapes(), name, &AdversarialShape::name);
  if (found == adversarial_shapes().end()) throw std::out_of_range("no shape " + name);
  return *found;
}

}  // namespace arris::test
