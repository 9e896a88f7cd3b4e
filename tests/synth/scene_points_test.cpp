#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>

#include "scene_testing.h"
#include "support/sanitizers.h"

namespace arris::synth {
namespace {

std::vector<std::string> scene_names() {
  std::vector<std::string> names;
  for (const SceneInfo& scene : list_scenes()) names.push_back(scene.name);
  return names;
}

/// Signed distance to the block's surface, built from solids and not from faces: negative inside.
double block_distance(double x, double y, double z) {
  const double bx = std::abs(x - 12) - 12, by = std::abs(y - 12) - 12, bz = std::abs(z - 6) - 6;
  const double box = std::hypot(std::max(bx, 0.0), std::hypot(std::max(by, 0.0), std::max(bz, 0.0))) +
                     std::min(std::max({bx, by, bz}), 0.0);
  const double cr = std::hypot(x - 12, y - 12) - 7, ch = std::abs(z - 6) - 12;
  const double cylinder = std::hypot(std::max(cr, 0.0), std::max(ch, 0.0)) + std::min(std::max(cr, ch), 0.0);
  return std::min(box, cylinder);
}

class EveryScene : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Scenes, EveryScene, testing::ValuesIn(scene_names()),
                         [](const auto& test) { return test.param; });

TEST_P(EveryScene, PointsWithoutNoise_LieOnFaces) {
  for (const std::string& sampling : list_samplings()) {
    SceneRequest request = request_of(GetParam(), 4000);
    request.sampling = sampling;
    const Scene scene(request);
    for (const io::FreshPoint& p : all_points(scene)) {
      if (p.classification == 7) continue;
      ASSERT_LT(scene.distance({p.x, p.y, p.z}), 1e-9) << sampling;
    }
  }
}

TEST_P(EveryScene, AnyBlockSize_GivesTheSamePoints) {
  SceneRequest request = request_of(GetParam(), 20000);
  request.noise = 0.01;
  request.outliers = 0.01;
  request.seed = 42;
  const auto whole = all_points(Scene(request), 10'000'000);
  for (const std::size_t block_points : {1, 777, 30000}) {
    const auto parts = all_points(Scene(request), block_points);
    ASSERT_EQ(parts.size(), whole.size());
    EXPECT_TRUE(std::equal(parts.begin(), parts.end(), whole.begin(), same));
  }
  request.seed = 43;
  const auto other = all_points(Scene(request));
  EXPECT_FALSE(other.size() == whole.size() && std::equal(other.begin(), other.end(), whole.begin(), same));
}

TEST_P(EveryScene, NumberAskedFor_IsDelivered) {
  ARRIS_SKIP_UNDER_SANITIZERS;
  for (const std::string& sampling : list_samplings()) {
    SceneRequest request = request_of(GetParam(), 200000);
    request.sampling = sampling;
    const Scene scene(request);
    const double count = static_cast<double>(all_points(scene).size());
    EXPECT_NEAR(count / 200000, 1.0, 0.02) << sampling;
    EXPECT_NEAR(scene.expected_points() / 200000, 1.0, 0.02) << sampling;
  }
}

TEST_P(EveryScene, Outliers_AreTheShareAskedFor) {
  ARRIS_SKIP_UNDER_SANITIZERS;
  SceneRequest request = request_of(GetParam(), 100000);
  request.outliers = 0.05;
  const auto points = all_points(Scene(request));
  const auto outliers =
      std::count_if(points.begin(), points.end(), [](const auto& p) { return p.classification == 7; });
  EXPECT_NEAR(static_cast<double>(outliers) / static_cast<double>(points.size()), 0.05, 0.005);
}

TEST(Block_Points, IndependentSolidModel_AgreesWithEveryPoint) {
  for (const std::string& sampling : list_samplings()) {
    SceneRequest request = request_of("block", 50000);
    request.sampling = sampling;
    for (const io::FreshPoint& p : all_points(Scene(request))) ASSERT_NEAR(block_distance(p.x, p.y, p.z), 0.0, 1e-9);
  }
}

TEST(Block_Grid, SharedEdges_AreNotSampledTwice) {
  SceneRequest request = request_of("block");
  request.spacing = 0.5;
  request.sampling = "grid";
  const auto points = all_points(Scene(request));
  // Half a spacing from the edge on either face: 0.5 s * sqrt(2) apart, a little less where the cut of cells is
  // rounded.
  std::map<std::array<int, 3>, std::vector<const io::FreshPoint*>> cells;
  const auto cell = [](const io::FreshPoint& p) {
    return std::array<int, 3>{int(std::floor(p.x)), int(std::floor(p.y)), int(std::floor(p.z))};
  };
  for (const auto& p : points) cells[cell(p)].push_back(&p);
  double least = 1e9, clipped = 1e9;
  for (const auto& p : points) {
    const auto c = cell(p);
    const bool near_joint = std::abs(std::hypot(p.x - 12, p.y - 12) - 7) < 1.0;  // Cells that circles cut lie anyhow.
    for (int i = 0; i < 27; ++i) {
      const auto found = cells.find({c[0] + i % 3 - 1, c[1] + i / 3 % 3 - 1, c[2] + i / 9 - 1});
      if (found == cells.end()) continue;
      for (const auto* q : found->second) {
        if (q == &p) continue;
        const double distance = std::hypot(p.x - q->x, std::hypot(p.y - q->y, p.z - q->z));
        (near_joint ? clipped : least) = std::min(near_joint ? clipped : least, distance);
      }
    }
  }
  EXPECT_GT(least, 0.69 * 0.5);
  EXPECT_GT(clipped, 0.0);
}

TEST(Spacing_Given, DensityOfAPlane_IsOnePerSpacingSquared) {
  for (const std::string sampling : {"grid", "jittered", "random", "scan"}) {
    SceneRequest request = request_of("plane");
    request.spacing = 0.02;
    request.sampling = sampling;
    const Scene scene(request);
    EXPECT_DOUBLE_EQ(scene.spacing(), 0.02);
    EXPECT_NEAR(static_cast<double>(all_points(scene).size()), 250000.0, 2500.0) << sampling;
  }
}

TEST(Sampling_Gradient, DensityAtTheTwoEnds_IsTenToOne) {
  SceneRequest request = request_of("plane", 400000);
  request.sampling = "gradient";
  double dense = 0, sparse = 0;
  for (const auto& p : all_points(Scene(request))) {
    if (p.x < 0.2) ++dense;
    if (p.x > 9.8) ++sparse;
  }
  EXPECT_NEAR(dense / sparse, 10.0, 1.0);
}

TEST(Sampling_Random, CountsPerCell_ArePoisson) {
  SceneRequest request = request_of("plane", 250000);
  request.sampling = "random";
  std::vector<double> counts(2500, 0.0);
  for (const auto& p : all_points(Scene(request))) {
    ++counts[static_cast<std::size_t>(p.x / 0.2) * 50 + static_cast<std::size_t>(p.y / 0.2)];
  }
  EXPECT_NEAR(mean(counts), 100.0, 1.0);
  EXPECT_NEAR(standard_deviation(counts), 10.0, 0.8);
}

TEST(Sampling_Jittered, Points_StayWithinTheirCells) {
  SceneRequest request = request_of("plane");
  request.spacing = 0.1;
  for (const auto& p : all_points(Scene(request))) {
    for (const double place : {p.x / 0.1, p.y / 0.1}) {
      const double in_cell = place - std::floor(place);
      ASSERT_GT(in_cell, 0.2 - 1e-9);
      ASSERT_LT(in_cell, 0.8 + 1e-9);
    }
  }
}

TEST(Sphere_Random, Heights_AreUniformAsOnASphere) {
  SceneRequest request = request_of("sphere", 200000);
  request.sampling = "random";
  std::vector<double> heights;
  for (const auto& p : all_points(Scene(request))) heights.push_back(p.z / 5.0);
  EXPECT_NEAR(mean(heights), 0.0, 0.01);
  EXPECT_NEAR(standard_deviation(heights), 1.0 / std::sqrt(3.0), 0.005);
}

TEST(Noise_SurfaceScene, IsIsotropicGaussianAndMovesNothingElse) {
  SceneRequest request = request_of("block", 100000);
  const auto clean = all_points(Scene(request));
  request.noise = 0.05;
  const auto noisy = all_points(Scene(request));
  ASSERT_EQ(clean.size(), noisy.size());
  std::array<std::vector<double>, 3> moves;
  std::vector<double> products;
  for (std::size_t i = 0; i < clean.size(); ++i) {
    moves[0].push_back(noisy[i].x - clean[i].x);
    moves[1].push_back(noisy[i].y - clean[i].y);
    moves[2].push_back(noisy[i].z - clean[i].z);
    products.push_back(moves[0].back() * moves[1].back());
  }
  for (const auto& axis : moves) {
    EXPECT_NEAR(mean(axis), 0.0, 0.001);
    EXPECT_NEAR(standard_deviation(axis), 0.05, 0.001);
  }
  EXPECT_NEAR(mean(products), 0.0, 5e-5);
}

TEST(Plates_Gap, IsGivenInSpacingsWhateverTheNumberOfPoints) {
  for (const std::uint64_t points : {5000, 50000}) {
    SceneRequest request = request_of("plates", points);
    request.options["gap_spacings"] = 8.0;
    const Scene scene(request);
    double low = 1e9, high = -1e9;
    for (const auto& p : all_points(scene)) {
      low = std::min(low, p.z);
      high = std::max(high, p.z);
    }
    EXPECT_NEAR(high - low, 8.0 * scene.spacing(), 1e-12);
  }
}

TEST(Stream_End, StaysAtTheEndAndOtherStreamsAreIndependent) {
  const Scene scene(request_of("plane", 1000));
  const auto a = scene.stream(), b = scene.stream(10);
  std::vector<io::FreshPoint> block;
  while (a->next(block)) {
  }
  EXPECT_TRUE(block.empty());
  EXPECT_FALSE(a->next(block));
  EXPECT_TRUE(b->next(block));
}

}  // namespace
}  // namespace arris::synth
