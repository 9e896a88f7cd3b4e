/// Reading speed of the readers against the barest loop that could do the same: pread a block, decode x, y, z.
///   read_speed FOLDER [POINTS]     writes its files there (best on a file system in memory), median of five runs
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <string>
#include <vector>

#include "io/point_source.h"
#include "io/point_writer.h"

namespace {

constexpr std::size_t kBlock = std::size_t{256} << 10;

double cpu_seconds() {
  struct rusage usage {};
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

template <typename Work>
double median_seconds(Work&& work) {
  std::vector<double> runs;
  for (int i = 0; i < 5; ++i) {
    const double before = cpu_seconds();
    work();
    runs.push_back(cpu_seconds() - before);
  }
  std::sort(runs.begin(), runs.end());
  return runs[2];
}

std::vector<arris::io::FreshPoint> some_points(std::size_t first, std::size_t count) {
  std::vector<arris::io::FreshPoint> points(count);
  for (std::size_t i = 0; i < count; ++i) {
    const auto n = static_cast<double>(first + i);
    points[i].x = 500000.0 + std::fmod(n * 0.618033, 1000.0);
    points[i].y = 5000000.0 + std::fmod(n * 0.414213, 1000.0);
    points[i].z = std::fmod(n * 0.732050, 100.0);
    points[i].intensity = static_cast<std::uint16_t>(first + i);
  }
  return points;
}

void write_fresh(const std::filesystem::path& path, std::size_t count) {
  arris::io::OutputOptions options;
  options.overwrite = true;
  arris::io::FreshCloud cloud;
  cloud.offset = {500000.0, 5000000.0, 0.0};
  const auto writer = arris::io::create_fresh_cloud_writer(path, cloud, options);
  for (std::size_t first = 0; first < count; first += 65536)
    writer->append(some_points(first, std::min<std::size_t>(65536, count - first)));
  writer->commit();
}

void write_ascii(const std::filesystem::path& path, std::size_t count) {
  std::FILE* file = std::fopen(path.c_str(), "wb");
  fmt::print(file,
             "ply\nformat ascii 1.0\nelement vertex {}\nproperty double x\nproperty double y\nproperty double z\n"
             "property ushort intensity\nend_header\n",
             count);
  for (std::size_t first = 0; first < count; first += 65536) {
    for (const auto& p : some_points(first, std::min<std::size_t>(65536, count - first)))
      fmt::print(file, "{:.3f} {:.3f} {:.3f} {}\n", p.x, p.y, p.z, p.intensity);
  }
  std::fclose(file);
}

double sum_of(const std::filesystem::path& path) {
  const auto source = arris::io::open_point_source(path);
  arris::io::PointBatch batch;
  double sum = 0.0;
  while (source->read(batch, {})) {
    for (const auto* axis : {&batch.ix, &batch.iy, &batch.iz}) {
      if (!axis->empty()) sum += (*axis)[0];
    }
    if (!batch.x.empty()) sum += batch.x[0];
  }
  return sum;
}

/// x, y, z of type T at the start of records, to arrays of 65 536 points.
template <typename T>
double bare_loop(const std::filesystem::path& path, std::size_t begin, std::size_t stride) {
  const int descriptor = ::open(path.c_str(), O_RDONLY);
  const std::size_t per_block = kBlock / stride;
  std::vector<char> block(per_block * stride);
  std::vector<T> x(per_block), y(per_block), z(per_block);
  double sum = 0.0;
  for (auto at = static_cast<off_t>(begin);;) {
    const ssize_t got = ::pread(descriptor, block.data(), block.size(), at);
    const std::size_t points = got <= 0 ? 0 : static_cast<std::size_t>(got) / stride;
    if (points == 0) break;
    for (std::size_t i = 0; i < points; ++i) {
      const char* record = block.data() + i * stride;
      std::memcpy(&x[i], record, sizeof(T));
      std::memcpy(&y[i], record + sizeof(T), sizeof(T));
      std::memcpy(&z[i], record + 2 * sizeof(T), sizeof(T));
    }
    sum += static_cast<double>(x[0]) + static_cast<double>(y[points - 1]) + static_cast<double>(z[points / 2]);
    at += static_cast<off_t>(points * stride);
  }
  ::close(descriptor);
  return sum;
}

template <typename Bare>
void compare(const char* name, const std::filesystem::path& path, std::size_t points, Bare&& bare) {
  double sink = sum_of(path);  // Into the cache.
  const double ours = median_seconds([&] { sink += sum_of(path); });
  const double least = median_seconds([&] { sink += bare(); });
  const double million = static_cast<double>(points) * 1e-6;
  fmt::print("{:<14} arris {:7.1f} M points/s   bare loop {:7.1f} M points/s   ratio {:.2f}   ({})\n", name,
             million / ours, million / least, least / ours, sink != 0.0);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) return 2;
  const std::filesystem::path folder = argv[1];
  const std::size_t points = argc > 2 ? std::stoul(argv[2]) : 10'000'000;
  const auto las = folder / "read_speed.las";
  const auto ply = folder / "read_speed.ply";
  const auto ascii = folder / "read_speed_ascii.ply";
  write_fresh(las, points);
  write_fresh(ply, points);
  write_ascii(ascii, points / 10);
  compare("LAS", las, points, [&] { return bare_loop<std::int32_t>(las, 375, 30); });
  const auto info = arris::io::open_point_source(ply)->info();
  const std::size_t begin = info.size_bytes - info.points * info.record_bytes;
  compare("PLY binary", ply, points, [&] { return bare_loop<double>(ply, begin, info.record_bytes); });
  double sink = sum_of(ascii);
  const double seconds = median_seconds([&] { sink += sum_of(ascii); });
  fmt::print("{:<14} arris {:7.1f} MB/s\n", "PLY ascii",
             static_cast<double>(std::filesystem::file_size(ascii)) * 1e-6 / seconds);
  for (const auto& path : {las, ply, ascii}) std::filesystem::remove(path);
}
