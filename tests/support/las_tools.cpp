#include "support/las_tools.h"

#include <cstring>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace arris::test {
namespace {

template <typename T>
T get(const std::string& bytes, std::size_t at) {
  T value;
  if (at + sizeof value > bytes.size()) throw std::runtime_error("LAS file too short");
  std::memcpy(&value, bytes.data() + at, sizeof value);
  return value;
}

template <typename T>
void put(std::string& bytes, std::size_t at, T value) {
  std::memcpy(bytes.data() + at, &value, sizeof value);
}

}  // namespace

std::string file_bytes(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw std::runtime_error("cannot read " + path.string());
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

void write_bytes(const std::filesystem::path& path, const std::string& bytes) {
  std::ofstream file(path, std::ios::binary);
  file << bytes;
  if (!file) throw std::runtime_error("cannot write " + path.string());
}

std::array<std::int32_t, 3> LasView::position(std::uint64_t i) const {
  std::array<std::int32_t, 3> xyz{};
  std::memcpy(xyz.data(), record(i), sizeof xyz);
  return xyz;
}

LasView view_las(const std::filesystem::path& path) {
  LasView view;
  view.bytes = file_bytes(path);
  const auto minor = get<std::uint8_t>(view.bytes, 25);
  view.offset_to_points = get<std::uint32_t>(view.bytes, 96);
  view.record_bytes = get<std::uint16_t>(view.bytes, 105);
  view.points = minor >= 4 ? get<std::uint64_t>(view.bytes, 247) : get<std::uint32_t>(view.bytes, 107);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    view.scale[axis] = get<double>(view.bytes, 131 + 8 * axis);
    view.offset[axis] = get<double>(view.bytes, 155 + 8 * axis);
  }
  return view;
}

std::vector<std::filesystem::path> split_las(const std::filesystem::path& path, int parts,
                                             const std::filesystem::path& folder) {
  const LasView whole = view_las(path);
  const auto minor = get<std::uint8_t>(whole.bytes, 25);
  std::vector<std::filesystem::path> paths;
  for (int part = 0; part < parts; ++part) {
    const std::uint64_t begin = whole.points * static_cast<std::uint64_t>(part) / static_cast<std::uint64_t>(parts);
    const std::uint64_t end = whole.points * static_cast<std::uint64_t>(part + 1) / static_cast<std::uint64_t>(parts);
    std::string bytes = whole.bytes.substr(0, whole.offset_to_points);
    bytes.append(whole.record(begin), (end - begin) * whole.record_bytes);
    const bool legacy = get<std::uint32_t>(whole.bytes, 107) != 0;
    put(bytes, 107, static_cast<std::uint32_t>(legacy ? end - begin : 0));
    if (minor >= 4) {
      put(bytes, 247, end - begin);
      put<std::uint64_t>(bytes, 235, 0);
      put<std::uint32_t>(bytes, 243, 0);
    }
    paths.push_back(folder / ("part" + std::to_string(part) + ".las"));
    write_bytes(paths.back(), bytes);
  }
  return paths;
}

void write_las(const std::filesystem::path& path, const std::vector<std::array<std::int32_t, 3>>& points, double scale,
               std::array<double, 3> offset) {
  std::string bytes(227 + 20 * points.size(), '\0');
  std::memcpy(bytes.data(), "LASF", 4);
  put<std::uint8_t>(bytes, 24, 1);
  put<std::uint8_t>(bytes, 25, 2);
  put<std::uint16_t>(bytes, 94, 227);
  put<std::uint32_t>(bytes, 96, 227);
  put<std::uint16_t>(bytes, 105, 20);
  put(bytes, 107, static_cast<std::uint32_t>(points.size()));
  put(bytes, 111, static_cast<std::uint32_t>(points.size()));
  for (std::size_t axis = 0; axis < 3; ++axis) {
    put(bytes, 131 + 8 * axis, scale);
    put(bytes, 155 + 8 * axis, offset[axis]);
    double least = 0.0;
    double most = 0.0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double world = points[i][axis] * scale + offset[axis];
      least = i == 0 ? world : std::min(least, world);
      most = i == 0 ? world : std::max(most, world);
    }
    put(bytes, 179 + 16 * axis, most);
    put(bytes, 187 + 16 * axis, least);
  }
  for (std::size_t i = 0; i < points.size(); ++i) std::memcpy(bytes.data() + 227 + 20 * i, points[i].data(), 12);
  write_bytes(path, bytes);
}

}  // namespace arris::test
