// How well the contours of supervoxels follow scenes whose contours are known.

#include <gtest/gtest.h>

#include "contour_scenes.h"
#include "core/columns.h"
#include "features/zheng/zheng_method.h"
#include "supervoxel_scenes.h"

namespace arris {
namespace {

using test::Sampling;
using test::Scene;
using test::Score;
using test::SupervoxelShape;

constexpr double kStep = 0.001;

/// @param dense  the method is told a spacing so many times the scene's, and the supervoxels are as much larger.
ContourRecords contours_of(const Scene& scene, SupervoxelShape shape, bool improved, double dense = 1.0) {
  shape.cell *= dense;
  shape.voxel *= dense;
  const TilePoints tile = test::tile_of(scene, kStep);
  const test::Supervoxels supervoxels = supervoxels_of(scene, tile, kStep, shape);
  ZhengParameters parameters;
  parameters.spacing = dense * scene.spacing;
  parameters.improved = improved;
  return extract_zheng(tile, supervoxels.labels, supervoxels.table, {kStep, {0.0, 0.0, 0.0}}, parameters).records;
}

struct Case {
  bool improved;
  bool whole_voxels;
  enum Kind { kGrid, kJittered, kRandom } kind;
  double noise;
  double least_block;
  double least_plates;
};

void PrintTo(const Case& c, std::ostream* out) {
  constexpr const char* kKinds[] = {"grid", "jittered", "random"};
  *out << (c.improved ? "improved" : "literal") << (c.whole_voxels ? ", voxels, " : ", faces, ") << kKinds[c.kind]
       << ", noise " << c.noise;
}

class ZhengQuality : public testing::TestWithParam<Case> {
 protected:
  Sampling sampling() const {
    Sampling sampling;
    sampling.noise = GetParam().noise;
    sampling.random = GetParam().kind == Case::kRandom;
    sampling.jitter = GetParam().kind == Case::kGrid ? 0.0 : 0.5;
    return sampling;
  }
  void record(const Score& score) {
    RecordProperty("f1", std::to_string(score.f1()));
    RecordProperty("precision", std::to_string(score.precision));
    RecordProperty("recall", std::to_string(score.recall));
  }
  SupervoxelShape shape() const {
    SupervoxelShape shape;
    shape.whole_voxels = GetParam().whole_voxels;
    return shape;
  }
};

TEST_P(ZhengQuality, Block_ReachesTheBar) {
  const Scene scene = test::block_scene(sampling());
  const auto records = contours_of(scene, shape(), GetParam().improved);
  const Score all = score(scene, records, kFold | kBoundary, 2.0 * scene.spacing);
  record(all);
  EXPECT_GE(all.f1(), GetParam().least_block) << "precision " << all.precision << " recall " << all.recall;
}

TEST_P(ZhengQuality, Plates_ReachTheBar) {
  const Scene scene = test::plates_scene(sampling(), 4.0);
  const auto records = contours_of(scene, shape(), GetParam().improved);
  const Score all = score(scene, records, kFold | kBoundary, 2.0 * scene.spacing);
  record(all);
  EXPECT_GE(all.f1(), GetParam().least_plates) << "precision " << all.precision << " recall " << all.recall;
}

TEST(ZhengDensity, TwiceTheTypicalSpacing_IsAsGood) {
  Sampling sampling;
  sampling.noise = 0.1;
  const Scene scene = test::block_scene(sampling);
  SupervoxelShape shape;
  shape.cell = 52.0;
  shape.voxel = 4.0;
  shape.whole_voxels = true;
  const Score found = score(scene, contours_of(scene, shape, true, 0.5), kFold | kBoundary, 2.0 * scene.spacing);
  EXPECT_GE(found.f1(), 0.95) << "precision " << found.precision << " recall " << found.recall;
}

TEST(ZhengDensity, QuarterOfTheTypicalSpacing_IsSeenInDetail) {
  Sampling sampling;
  sampling.noise = 0.1;
  const Scene scene = test::block_scene(sampling);
  SupervoxelShape shape;
  shape.cell = 13.0;
  shape.whole_voxels = true;
  const Score found = score(scene, contours_of(scene, shape, true, 4.0), kFold | kBoundary, 2.0 * scene.spacing);
  EXPECT_GE(found.f1(), 0.98) << "precision " << found.precision << " recall " << found.recall;
}

/// Two half plates of 40 x 20 spacings, one `height` spacings above the other, and supervoxels of a quarter plate.
TEST(ZhengStep, ParallelHalvesBesideEachOther_EndAtTheStep) {
  for (const double height : {2.6, 3.0, 4.0}) {
    Scene scene;
    scene.spacing = 0.25;
    for (int i = 0; i < 40; ++i) {
      for (int j = 0; j < 40; ++j) {
        const bool upper = i >= 20;
        scene.points.push_back({0.25 * i, 0.25 * j, upper ? 0.25 * height : 0.0});
        scene.faces.push_back(upper ? 2 + j / 20 : j / 20);
        if (i == 19 || i == 20 || i == 0 || i == 39 || j == 0 || j == 39) scene.truth.push_back(scene.points.back());
      }
    }
    SupervoxelShape shape;
    shape.cell = 1000.0;
    const auto records = contours_of(scene, shape, true);
    const Score found = score(scene, records, kBoundary, 1e-6);
    EXPECT_EQ(found.precision, 1.0) << height;
    EXPECT_GE(found.recall, 0.97) << height;
  }
}

// Literally, seams on the cylinders are contacts: patches of 26 spacings differ by 50 degrees there.
INSTANTIATE_TEST_SUITE_P(Literal, ZhengQuality,
                         testing::Values(Case{false, false, Case::kGrid, 0.0, 0.90, 0.98},
                                         Case{false, false, Case::kJittered, 0.0, 0.92, 0.98},
                                         Case{false, false, Case::kJittered, 0.2, 0.92, 0.975},
                                         Case{false, true, Case::kGrid, 0.0, 0.86, 0.98},
                                         Case{false, true, Case::kJittered, 0.0, 0.87, 0.98},
                                         Case{false, true, Case::kJittered, 0.2, 0.89, 0.975},
                                         Case{false, true, Case::kRandom, 0.0, 0.80, 0.92},
                                         Case{false, true, Case::kRandom, 0.2, 0.82, 0.93}));

INSTANTIATE_TEST_SUITE_P(Improved, ZhengQuality,
                         testing::Values(Case{true, false, Case::kGrid, 0.0, 0.99, 0.99},
                                         Case{true, false, Case::kJittered, 0.0, 0.99, 0.99},
                                         Case{true, false, Case::kJittered, 0.2, 0.99, 0.99},
                                         Case{true, true, Case::kGrid, 0.0, 0.99, 0.99},
                                         Case{true, true, Case::kJittered, 0.0, 0.99, 0.99},
                                         Case{true, true, Case::kJittered, 0.2, 0.99, 0.99},
                                         Case{true, true, Case::kJittered, 0.4, 0.98, 0.85},
                                         Case{true, true, Case::kRandom, 0.0, 0.99, 0.99},
                                         Case{true, true, Case::kRandom, 0.2, 0.99, 0.98},
                                         Case{true, true, Case::kRandom, 0.4, 0.98, 0.90}));

}  // namespace
}  // namespace arris
