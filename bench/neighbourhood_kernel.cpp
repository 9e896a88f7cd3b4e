/// @file The neighbourhood engine beside nanoflann and Eigen, one thread, the same points in the same Morton order:
/// k nearest neighbours, and with them covariance, eigenvalues and eigenvectors.
///
///   bench_neighbourhood_kernel [scan.las] [--benchmark_filter=...]
///
/// Without a scan: a million points on the faces of a cube, 25 lattice steps apart, with noise of a tenth of that.

#include <benchmark/benchmark.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <nanoflann.hpp>
#include <random>
#include <vector>

#include "core/parallel.h"
#include "features/neighbourhood/neighbour_search.h"
#include "features/neighbourhood/plane_fit.h"
#include "features/supervoxel/least_direction.h"
#include "io/point_source.h"
#include "tiling/morton.h"

namespace {

using arris::LatticePoint;

constexpr std::size_t kMostPoints = 1'000'000;

std::vector<LatticePoint> cube() {
  constexpr double kSpacing = 25.0;
  constexpr int kFaces = 6;
  const double side = kSpacing * std::sqrt(static_cast<double>(kMostPoints) / kFaces);
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> along(0.0, side);
  std::normal_distribution<double> off(0.0, 0.1 * kSpacing);
  std::vector<LatticePoint> points;
  for (std::size_t i = 0; i < kMostPoints; ++i) {
    std::array<double, 3> p{along(random), along(random), i % 2 == 1 ? side : 0.0};
    std::rotate(p.begin(), p.begin() + static_cast<int>(i % kFaces) / 2, p.end());
    for (double& c : p) c += off(random);
    points.push_back({static_cast<std::int32_t>(std::lround(p[0])), static_cast<std::int32_t>(std::lround(p[1])),
                      static_cast<std::int32_t>(std::lround(p[2]))});
  }
  return points;
}

/// The first points of a file with scaled integers.
std::vector<LatticePoint> scan(const char* path) {
  const auto source = arris::io::open_point_source(path);
  std::vector<LatticePoint> points;
  arris::io::PointBatch batch;
  while (points.size() < kMostPoints && source->read(batch, {})) {
    for (std::size_t i = 0; i < batch.count && source->info().scaled_integers; ++i) {
      points.push_back({batch.ix[i], batch.iy[i], batch.iz[i]});
    }
  }
  return points;
}

/// Distinct points in Morton order, as both engines get them.
struct Cloud {
  std::vector<LatticePoint> points;
  std::vector<std::uint64_t> ids;
  std::vector<std::array<float, 3>> floats;  ///< Relative to the first point.

  explicit Cloud(std::vector<LatticePoint> unordered) : points(std::move(unordered)) {
    std::sort(points.begin(), points.end(), arris::tiling::z_order_less);
    points.erase(std::unique(points.begin(), points.end()), points.end());
    for (const LatticePoint& p : points) {
      ids.push_back(ids.size());
      floats.push_back({static_cast<float>(p.x - points[0].x), static_cast<float>(p.y - points[0].y),
                        static_cast<float>(p.z - points[0].z)});
    }
  }

  // What nanoflann asks for.
  std::size_t kdtree_get_point_count() const { return floats.size(); }
  float kdtree_get_pt(std::size_t i, std::size_t axis) const { return floats[i][axis]; }
  template <class Box>
  bool kdtree_get_bbox(Box&) const {
    return false;
  }
};

void count_points(benchmark::State& state, const Cloud& cloud) {
  state.counters["points/s"] =
      benchmark::Counter(static_cast<double>(cloud.points.size()), benchmark::Counter::kIsIterationInvariantRate);
}

/// Every point's k neighbours, bucket by bucket as run_queries() does.
template <class Use>
void for_all_neighbours(const arris::PointTree& tree, std::size_t k, Use&& use) {
  arris::SearchLimits limits;
  limits.k = k;
  limits.max_reach = 1e6;
  limits.max_d2 = 1'000'000'000'000;
  arris::NeighbourSearch search(tree, limits);
  std::vector<std::uint32_t> slots;
  for (std::size_t bucket = 0; bucket < tree.buckets(); ++bucket) {
    slots.clear();
    for (std::size_t slot = tree.bucket_begin(bucket); slot < tree.bucket_begin(bucket + 1); ++slot) {
      slots.push_back(static_cast<std::uint32_t>(slot));
    }
    search.run(slots, use);
  }
}

void arris_tree(benchmark::State& state, const Cloud& cloud) {
  const arris::ThreadLimit one(1);
  for (auto _ : state) benchmark::DoNotOptimize(arris::PointTree(cloud.points, cloud.ids));
  count_points(state, cloud);
}

void arris_search(benchmark::State& state, const Cloud& cloud) {
  const arris::PointTree tree(cloud.points, cloud.ids);
  for (auto _ : state) {
    double sum = 0.0;
    for_all_neighbours(tree, static_cast<std::size_t>(state.range(0)),
                       [&](std::uint32_t, const arris::Neighbours& found) { sum += found.d2[found.count - 1]; });
    benchmark::DoNotOptimize(sum);
  }
  count_points(state, cloud);
}

/// n² times the covariance of the point and its neighbours.
arris::SymmetricMatrix<double> covariance(const arris::Neighbours& found) {
  double x = 0, y = 0, z = 0, xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0;
  for (std::size_t i = 0; i < found.count; ++i) {
    const double dx = found.dx[i], dy = found.dy[i], dz = found.dz[i];
    x += dx, y += dy, z += dz;
    xx += dx * dx, xy += dx * dy, xz += dx * dz, yy += dy * dy, yz += dy * dz, zz += dz * dz;
  }
  const double n = static_cast<double>(found.count + 1);
  return {n * xx - x * x, n * xy - x * y, n * xz - x * z, n * yy - y * y, n * yz - y * z, n * zz - z * z};
}

void arris_frames(benchmark::State& state, const Cloud& cloud) {
  const arris::PointTree tree(cloud.points, cloud.ids);
  std::vector<arris::Vector3> normals(cloud.points.size());
  for (auto _ : state) {
    for_all_neighbours(tree, static_cast<std::size_t>(state.range(0)),
                       [&](std::uint32_t slot, const arris::Neighbours& found) {
                         normals[slot] = arris::principal_frame(covariance(found)).e3;
                       });
    benchmark::DoNotOptimize(normals.data());
  }
  count_points(state, cloud);
}

/// As the methods do it: eight matrices at once.
void arris_normals(benchmark::State& state, const Cloud& cloud) {
  const arris::PointTree tree(cloud.points, cloud.ids);
  std::vector<arris::Vector3> normals(cloud.points.size());
  for (auto _ : state) {
    arris::LeastDirections solver;
    std::array<std::uint32_t, arris::LeastDirections::kCount> waiting{};
    std::size_t used = 0;
    const auto solve = [&] {
      solver.solve();
      for (std::size_t i = 0; i < used; ++i) normals[waiting[i]] = solver.direction(i);
      used = 0;
    };
    for_all_neighbours(tree, static_cast<std::size_t>(state.range(0)),
                       [&](std::uint32_t slot, const arris::Neighbours& found) {
                         waiting[used] = slot;
                         solver.set(used, covariance(found));
                         if (++used == waiting.size()) solve();
                       });
    solve();
    benchmark::DoNotOptimize(normals.data());
  }
  count_points(state, cloud);
}

using FlannTree =
    nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<float, Cloud>, Cloud, 3, std::uint32_t>;

nanoflann::KDTreeSingleIndexAdaptorParams leaf_of(const benchmark::State& state) {
  return nanoflann::KDTreeSingleIndexAdaptorParams(static_cast<std::size_t>(state.range(1)));
}

void nanoflann_tree(benchmark::State& state, const Cloud& cloud) {
  for (auto _ : state) benchmark::DoNotOptimize(FlannTree(3, cloud, leaf_of(state)));
  count_points(state, cloud);
}

/// Calls use(point, neighbours with itself first).
template <class Use>
void for_all_flann(const benchmark::State& state, const Cloud& cloud, const FlannTree& tree, Use&& use) {
  std::vector<std::uint32_t> found(static_cast<std::size_t>(state.range(0)) + 1);
  std::vector<float> d2(found.size());
  for (std::size_t i = 0; i < cloud.floats.size(); ++i) {
    tree.knnSearch(cloud.floats[i].data(), found.size(), found.data(), d2.data());
    use(i, found, d2);
  }
}

void nanoflann_search(benchmark::State& state, const Cloud& cloud) {
  const FlannTree tree(3, cloud, leaf_of(state));
  for (auto _ : state) {
    double sum = 0.0;
    for_all_flann(state, cloud, tree, [&](std::size_t, const auto&, const auto& d2) { sum += d2.back(); });
    benchmark::DoNotOptimize(sum);
  }
  count_points(state, cloud);
}

void nanoflann_eigen(benchmark::State& state, const Cloud& cloud) {
  const FlannTree tree(3, cloud, leaf_of(state));
  std::vector<Eigen::Vector3f> normals(cloud.points.size());
  for (auto _ : state) {
    for_all_flann(state, cloud, tree, [&](std::size_t i, const auto& found, const auto&) {
      const Eigen::Map<const Eigen::Vector3f> centre(cloud.floats[i].data());
      Eigen::Vector3f sum = Eigen::Vector3f::Zero();
      Eigen::Matrix3f squares = Eigen::Matrix3f::Zero();
      for (const std::uint32_t j : found) {
        const Eigen::Vector3f d = Eigen::Map<const Eigen::Vector3f>(cloud.floats[j].data()) - centre;
        sum += d;
        squares += d * d.transpose();
      }
      const auto n = static_cast<float>(found.size());
      const Eigen::Matrix3f covariance = squares / n - sum * sum.transpose() / (n * n);
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3f> solver;
      solver.computeDirect(covariance);
      normals[i] = solver.eigenvectors().col(0);
    });
    benchmark::DoNotOptimize(normals.data());
  }
  count_points(state, cloud);
}

/// Planes through the points of a ball of 120 points, two thirds of its radius wide.
void arris_plane_fit(benchmark::State& state) {
  arris::BallPoints points;
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> along(-6.0, 6.0);
  std::normal_distribution<double> off(0.0, 0.1);
  for (std::size_t i = 0; i < 120; ++i) {
    points.x.push_back(arris::on_grid<arris::kCoordinateBits>(along(random)));
    points.y.push_back(arris::on_grid<arris::kCoordinateBits>(along(random)));
    points.z.push_back(arris::on_grid<arris::kCoordinateBits>(off(random)));
  }
  points.count = points.x.size();
  for (auto* column : {&points.x, &points.y, &points.z}) {
    column->resize(points.padded_count(), arris::BallPoints::kPaddingCoordinate);
  }
  for (auto _ : state) benchmark::DoNotOptimize(arris::fit_plane(arris::sum_within(points, 4.0)));
}

}  // namespace

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  const Cloud cloud(argc > 1 ? scan(argv[1]) : cube());
  std::printf("%zu distinct points\n", cloud.points.size());
  if (cloud.points.size() < 100) return 2;
  const auto add = [&](const char* name, void (*run)(benchmark::State&, const Cloud&)) {
    return benchmark::RegisterBenchmark(name, [run, &cloud](benchmark::State& state) { run(state, cloud); })
        ->Unit(benchmark::kMillisecond);
  };
  add("arris tree", arris_tree);
  for (const int k : {16, 30}) {
    add("arris search/k", arris_search)->Arg(k);
    add("arris search + frames/k", arris_frames)->Arg(k);
    add("arris search + normals/k", arris_normals)->Arg(k);
  }
  for (const int leaf : {10, 16, 32}) add("nanoflann tree/k/leaf", nanoflann_tree)->Args({16, leaf});
  for (const int k : {16, 30}) {
    for (const int leaf : {10, 16, 32}) {
      add("nanoflann search/k/leaf", nanoflann_search)->Args({k, leaf});
      add("nanoflann search + Eigen/k/leaf", nanoflann_eigen)->Args({k, leaf});
    }
  }
  benchmark::RegisterBenchmark("plane fit of 120 points", arris_plane_fit);
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
