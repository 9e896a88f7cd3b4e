/// @file What PCL reads from a PLY file, as a second opinion on the values of ours.
/// Usage: bench_pcl_ply_values FILE. Prints one line: count, then minimum, maximum and sum of x, y and z, over finite
/// values, comma-separated. Exits with 1 if PCL refuses the file.

#include <pcl/PCLPointCloud2.h>
#include <pcl/console/print.h>
#include <pcl/io/ply_io.h>

#include <cmath>
#include <cstdio>
#include <cstring>
#include <limits>

namespace {

template <typename T>
double load(const std::uint8_t* at) {
  T value;
  std::memcpy(&value, at, sizeof value);
  return static_cast<double>(value);
}

double load_field(std::uint8_t datatype, const std::uint8_t* at) {
  switch (datatype) {
    case pcl::PCLPointField::INT8:
      return load<std::int8_t>(at);
    case pcl::PCLPointField::UINT8:
      return load<std::uint8_t>(at);
    case pcl::PCLPointField::INT16:
      return load<std::int16_t>(at);
    case pcl::PCLPointField::UINT16:
      return load<std::uint16_t>(at);
    case pcl::PCLPointField::INT32:
      return load<std::int32_t>(at);
    case pcl::PCLPointField::UINT32:
      return load<std::uint32_t>(at);
    case pcl::PCLPointField::FLOAT32:
      return load<float>(at);
    default:
      return load<double>(at);
  }
}

/// False if the cloud has no such field.
bool print_axis(const pcl::PCLPointCloud2& cloud, const char* axis) {
  for (const pcl::PCLPointField& field : cloud.fields) {
    if (field.name != axis) continue;
    double least = std::numeric_limits<double>::infinity();
    double most = -least;
    long double sum = 0.0L;
    for (std::size_t i = 0; i < static_cast<std::size_t>(cloud.width) * cloud.height; ++i) {
      const double value = load_field(field.datatype, cloud.data.data() + i * cloud.point_step + field.offset);
      if (!std::isfinite(value)) continue;
      least = std::min(least, value);
      most = std::max(most, value);
      sum += static_cast<long double>(value);
    }
    std::printf(",%.17g,%.17g,%.17Lg", least, most, sum);
    return true;
  }
  return false;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  pcl::console::setVerbosityLevel(pcl::console::L_ERROR);
  pcl::PCLPointCloud2 cloud;
  pcl::PLYReader reader;
  if (reader.read(argv[1], cloud) != 0) return 1;
  std::printf("%zu", static_cast<std::size_t>(cloud.width) * cloud.height);
  for (const char* axis : {"x", "y", "z"}) {
    if (!print_axis(cloud, axis)) return 1;
  }
  std::printf("\n");
  return 0;
}
