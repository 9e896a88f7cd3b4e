#include "pipeline/frontier_estimate.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "survey_of.h"

namespace arris::pipeline {
namespace {

using test::survey_of;

constexpr std::int32_t kPatchSteps = 3'000;

using Points = std::vector<LatticePoint>;

/// 40 m by 40 m with a point every 10 cm.
Points ground() {
  Points points;
  for (std::int32_t x = 0; x < 40'000; x += 100) {
    for (std::int32_t y = 0; y < 40'000; y += 100) points.push_back({x, y, 0});
  }
  return points;
}

/// A third of the scan: 3 m by 3 m with a point every centimetre, less than the noise.
void add_patch(std::int32_t x0, std::int32_t y0, Points& points) {
  std::mt19937 random(7);
  for (std::int32_t x = 0; x < kPatchSteps; x += 10) {
    for (std::int32_t y = 0; y < kPatchSteps; y += 10)
      points.push_back({x0 + x, y0 + y, static_cast<std::int32_t>(random() % 60)});
  }
}

struct Samples {
  Samples(const tiling::Survey& survey, double points)
      : large(survey, kFrontierCellSpacings, points), small(survey, kSmallFrontierCellSpacings, points) {}
  void draw(const Points& points) {
    for (CellSample* sample : {&large, &small}) {
      for (std::size_t i = 0; i < points.size(); ++i) {
        const LatticePoint place = sample->place_of(points[i]);
        if (sample->draws(place)) sample->add(place, points[i], i);
      }
    }
  }
  double bytes_per_point(const tiling::Survey& survey) const {
    SegmentParameters parameters;
    parameters.neighbours = 8;
    parameters.max_radius = 1.0;
    return frontier_bytes_per_point({large, small}, {}, survey, parameters);
  }

  CellSample large, small;
};

/// The patch is in a large cell that is not drawn, and its middle in a small one that is.
bool is_drawn_by_small_cells_only(const Samples& samples, std::int32_t x, std::int32_t y) {
  const LatticePoint middle{x + kPatchSteps / 2, y + kPatchSteps / 2, 30};
  const LatticePoint begin{x, y, 30}, end{x + kPatchSteps, y + kPatchSteps, 30};
  return samples.small.draws(samples.small.place_of(middle)) && !samples.large.draws(samples.large.place_of(middle)) &&
         samples.large.place_of(begin) == samples.large.place_of(end);
}

Points scan_with_patch(std::int32_t x, std::int32_t y) {
  Points points = ground();
  add_patch(x, y, points);
  return points;
}

TEST(FrontierEstimate, DensePatchThatNoLargeCellShows_CountsByItsPoints) {
  constexpr double kDrawn = 60'000.0;
  const Samples anywhere(survey_of(scan_with_patch(0, 0)), kDrawn);  // Where the patch is does not change the cells.
  std::int32_t at = 0;
  while (at < 36 * 36 && !is_drawn_by_small_cells_only(anywhere, at % 36 * 1'000, at / 36 * 1'000)) ++at;
  ASSERT_LT(at, 36 * 36) << "no place for the patch";
  const Points points = scan_with_patch(at % 36 * 1'000, at / 36 * 1'000);
  const tiling::Survey survey = survey_of(points);
  Samples some(survey, kDrawn), all(survey, 1e9);
  some.draw(points);
  all.draw(points);
  const double expected = all.bytes_per_point(survey);
  ASSERT_GT(expected, 1.0) << "the patch is on the frontier";
  EXPECT_NEAR(some.bytes_per_point(survey) / expected, 1.0, 0.35);
}

}  // namespace
}  // namespace arris::pipeline
