#include "labels_file.h"

#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <fstream>

#include "core/error.h"
#include "io/point_source.h"

namespace arris::bench {
namespace {

static_assert(std::endian::native == std::endian::little, "Values are written as they lie in memory.");

template <typename T>
void put(std::vector<char>& out, T value) {
  const std::size_t at = out.size();
  out.resize(at + sizeof value);
  std::memcpy(out.data() + at, &value, sizeof value);
}

}  // namespace

Cloud read_cloud(const std::filesystem::path& path) {
  const auto source = io::open_point_source(path);
  Cloud cloud;
  cloud.reserve(source->info().points);
  io::PointBatch batch;
  while (source->read(batch, {})) {
    for (std::size_t i = 0; i < batch.count; ++i) {
      std::array<double, 3> p{};
      for (std::size_t axis = 0; axis < 3; ++axis) p[axis] = io::world_coordinate(source->info(), batch, i, axis);
      if (!std::isfinite(p[0] + p[1] + p[2])) {
        throw InputError(fmt::format("{}: point {} is not finite", path.string(), cloud.size()));
      }
      cloud.push_back(p);
    }
  }
  return cloud;
}

void write_labels(const std::filesystem::path& path, const Cloud& cloud, const Labels& labels) {
  std::ofstream file(path, std::ios::binary | std::ios::trunc);
  file << "ply\nformat binary_little_endian 1.0\nelement vertex " << cloud.size()
       << "\nproperty double x\nproperty double y\nproperty double z\nproperty uchar EdgeClass\n"
       << (labels.score.empty() ? "" : "property float EdgeScore\n") << "end_header\n";
  std::vector<char> row;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    row.clear();
    for (const double coordinate : cloud[i]) put(row, coordinate);
    put(row, labels.edge[i]);
    if (!labels.score.empty()) put(row, labels.score[i]);
    file.write(row.data(), static_cast<std::streamsize>(row.size()));
  }
  file.close();
  if (!file) throw IoError(fmt::format("{}: cannot be written", path.string()));
}

}  // namespace arris::bench
