// How well the defaults find the contours of scenes whose contours are known.

#include <gtest/gtest.h>

#include "contour_scenes.h"
#include "core/columns.h"
#include "features/liu/liu_method.h"

namespace arris {
namespace {

using test::Sampling;
using test::Scene;
using test::Score;

ContourRecords contours_of(const Scene& scene) {
  LiuParameters parameters;
  parameters.max_radius = 40.0 * scene.spacing;
  constexpr double kStep = 0.001;
  return extract_liu(test::tile_of(scene, kStep), {kStep, {0.0, 0.0, 0.0}}, parameters).records;
}

struct Case {
  double noise;
  double least_f1;
};

class BlockFolds : public testing::TestWithParam<Case> {};

TEST_P(BlockFolds, Defaults_ReachTheBar) {
  Sampling sampling;
  sampling.noise = GetParam().noise;
  const Scene scene = test::block_scene(sampling);
  const ContourRecords records = contours_of(scene);
  const Score folds = score(scene, records, kFold, scene.spacing);
  const Score all = score(scene, records, kFold | kBoundary | kWeakBoundary, scene.spacing);
  RecordProperty("f1", std::to_string(folds.f1()));
  RecordProperty("f1_union", std::to_string(all.f1()));
  EXPECT_GE(folds.f1(), GetParam().least_f1) << "precision " << folds.precision << " recall " << folds.recall;
  EXPECT_GE(all.f1(), GetParam().least_f1);  // A closed surface has no borders: the boundary test must add none.
}

INSTANTIATE_TEST_SUITE_P(Noise, BlockFolds, testing::Values(Case{0.0, 0.975}, Case{0.12, 0.945}, Case{0.2, 0.90}));

class PlateBoundaries : public testing::TestWithParam<Case> {};

TEST_P(PlateBoundaries, Defaults_ReachTheBar) {
  Sampling sampling;
  sampling.noise = GetParam().noise;
  const Scene scene = test::plates_scene(sampling, 4.0);
  const Score found = score(scene, contours_of(scene), kBoundary | kWeakBoundary, scene.spacing);
  RecordProperty("f1", std::to_string(found.f1()));
  EXPECT_GE(found.f1(), GetParam().least_f1) << "precision " << found.precision << " recall " << found.recall;
}

INSTANTIATE_TEST_SUITE_P(Noise, PlateBoundaries,
                         testing::Values(Case{0.0, 0.975}, Case{0.12, 0.965}, Case{0.2, 0.925}));

TEST(PlainSurface, Interior_HasNoContours) {
  // A plate alone: nothing is found away from its borders, neither folds nor boundaries.
  Sampling sampling;
  sampling.noise = 0.1;
  Scene scene = test::plates_scene(sampling, 40.0);
  const Score found = score(scene, contours_of(scene), kBoundary | kWeakBoundary | kFold, 2.0 * scene.spacing);
  EXPECT_GE(found.precision, 0.995);
}

TEST(GridSpacing, GivenSpacing_FindsTheSameFoldsAsTheEstimate) {
  const Scene scene = test::block_scene({});
  LiuParameters parameters;
  parameters.max_radius = 10.0;
  parameters.spacing = scene.spacing;
  const auto records = extract_liu(test::tile_of(scene, 0.001), {0.001, {0.0, 0.0, 0.0}}, parameters).records;
  EXPECT_GE(score(scene, records, kFold, scene.spacing).f1(), 0.97);
}

}  // namespace
}  // namespace arris
