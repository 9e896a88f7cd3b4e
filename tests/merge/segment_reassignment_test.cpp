// Moments, planes and the reassignment of points near the borders of segments.

#include "merge/segment_reassignment.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <random>

#include "features/segment/tile_growth.h"
#include "merge/segment_sides.h"
#include "support/temp_folder.h"

namespace arris::merge {
namespace {

std::vector<LatticePoint> random_points(std::size_t count, std::int32_t around, std::int32_t extent,
                                        std::mt19937_64& random) {
  std::uniform_int_distribution<std::int32_t> offset(-extent, extent);
  std::vector<LatticePoint> points(count);
  for (LatticePoint& p : points) p = {around + offset(random), around - offset(random), offset(random) / 3};
  return points;
}

RC_GTEST_PROP(SegmentMoments, PlaneIsThatOfEigen_AndRemovingUndoesAdding, ()) {
  std::mt19937_64 random(*rc::gen::arbitrary<std::uint64_t>());
  const std::int32_t around = *rc::gen::element(0, 1000000, 2000000000);
  const auto points = random_points(60, around, 100000, random);
  SegmentMoments moments(2);
  for (const LatticePoint& p : points) moments.add(2, p);
  for (const LatticePoint& p : random_points(30, around, 100000, random)) {
    moments.add(2, p);
    moments.remove(2, p);
  }
  RC_ASSERT(moments.points(2) == 60U);
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  const auto vector = [&](const LatticePoint& p) {
    const LatticePoint& o = points[0];
    return Eigen::Vector3d(double(p.x) - o.x, double(p.y) - o.y, double(p.z) - o.z);
  };
  for (const LatticePoint& p : points) mean += vector(p) / 60.0;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (const LatticePoint& p : points) covariance += (vector(p) - mean) * (vector(p) - mean).transpose() / 60.0;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(covariance);
  const SegmentPlane plane = moments.plane(2);
  const Eigen::Vector3d normal(plane.normal[0], plane.normal[1], plane.normal[2]);
  RC_ASSERT(std::fabs(normal.dot(solver.eigenvectors().col(0))) > 1.0 - 1e-9);
  RC_ASSERT(std::fabs(plane.rms - std::sqrt(solver.eigenvalues()[0])) < 1e-6 * plane.rms);
  RC_ASSERT(std::fabs(plane.centroid[0] - points[0].x - mean.x()) < 1e-4);
  RC_ASSERT(plane.normal[2] >= 0.0);
}

TEST(SegmentMoments, NoPointsOrOne_NothingIsNan) {
  SegmentMoments moments(2);
  moments.add(2, {5, 6, 7});
  EXPECT_EQ(moments.plane(1).rms, 0.0);
  EXPECT_EQ(moments.plane(2).centroid, (Vector3{5.0, 6.0, 7.0}));
  EXPECT_TRUE(std::isfinite(moments.plane(2).normal[0]));
}

/// A gable: the ridge along y at x = 0, slopes of 45 degrees down to both sides, points every 10 steps, and their four
/// neighbours on the grid.
class Gable {
 public:
  static constexpr int kHalf = 10, kLength = 12, kStep = 10;

  explicit Gable(const std::filesystem::path& folder)
      : frontier(folder / "frontier", 4), duplicates(folder / "duplicates"), moments(2), folder_(folder) {}

  std::uint32_t id(int column, int row) const { return static_cast<std::uint32_t>((column + kHalf) * kLength + row); }
  LatticePoint position(int column, int row) const {
    return {column * kStep, row * kStep, -std::abs(column) * kStep + lift(column, row)};
  }
  /// Labels by `label(column, row)`; everything is frontier, column by column.
  template <class Label>
  void build(Label&& label) {
    labels.assign(static_cast<std::size_t>(2 * kHalf + 1) * kLength, 0);
    for (int c = -kHalf; c <= kHalf; ++c) {
      std::vector<std::uint32_t> words;
      for (int r = 0; r < kLength; ++r) {
        labels[id(c, r)] = label(c, r);
        const LatticePoint p = position(c, r);
        words.insert(words.end(), {id(c, r), static_cast<std::uint32_t>(p.x), static_cast<std::uint32_t>(p.y),
                                   static_cast<std::uint32_t>(p.z)});
        std::size_t added = 0;
        for (const auto& [dc, dr] : {std::pair{-1, 0}, {1, 0}, {0, -1}, {0, 1}}) {
          if (std::abs(c + dc) > kHalf || r + dr < 0 || r + dr >= kLength) continue;
          words.push_back(id(c + dc, r + dr));
          ++added;
        }
        words.insert(words.end(), 4 - added, TileGrowth::kNoId);
        if (labels[id(c, r)] != 0) moments.add(labels[id(c, r)], p);
      }
      frontier.append(words);
    }
    planes = {moments.plane(1), moments.plane(2)};
    for (SegmentPlane& plane : planes) plane.spacing = kStep;
  }
  std::uint64_t sweep(bool published) {
    SegmentParameters parameters;
    parameters.published = published;
    return reassign({parameters, 0.001, folder_}, frontier, duplicates, labels, moments, planes, {});
  }
  std::int32_t lift_steps = 0;  ///< Points of the column beside the ridge stand up by this, one in lift_every.
  int lift_every = 2;

  SegmentFrontier frontier;
  DuplicatePoints duplicates;
  PointLabels labels;
  SegmentMoments moments;
  std::vector<SegmentPlane> planes;

 private:
  std::int32_t lift(int column, int row) const { return column == 1 && row % lift_every == 0 ? lift_steps : 0; }
  std::filesystem::path folder_;
};

TEST(Reassignment, PointsWithoutSegment_GoToTheNearestPlane) {
  for (const bool published : {true, false}) {
    const test::TempFolder folder;
    Gable gable(folder.path());
    gable.build([](int c, int) { return std::abs(c) <= 2 ? 0U : c < 0 ? 1U : 2U; });
    EXPECT_EQ(gable.sweep(published), 2U * Gable::kLength);
    EXPECT_EQ(gable.sweep(published), 2U * Gable::kLength);
    gable.sweep(published);
    for (int r = 0; r < Gable::kLength; ++r) {
      EXPECT_EQ(gable.labels[gable.id(-1, r)], 1U);
      EXPECT_EQ(gable.labels[gable.id(1, r)], 2U);
      EXPECT_NE(gable.labels[gable.id(0, r)], 0U);  // On both.
    }
    EXPECT_EQ(gable.moments.points(1) + gable.moments.points(2), gable.labels.size());
    EXPECT_LT(gable.planes[0].rms, 0.5);
  }
}

TEST(Reassignment, PointsOfTheWrongSegment_ComeBackUnlessAsPublished) {
  const test::TempFolder folder;
  Gable gable(folder.path());
  gable.build([](int c, int) { return c <= 1 ? 1U : 2U; });
  EXPECT_EQ(gable.sweep(true), 0U);
  gable.sweep(false);
  for (int r = 0; r < Gable::kLength; ++r) EXPECT_EQ(gable.labels[gable.id(1, r)], 2U);
}

// Noise that lifts a point over the ridge brings it nearer to the other slope's plane, but not to that slope.
TEST(Reassignment, NoiseAboveARidge_DoesNotMovePoints) {
  const test::TempFolder folder;
  Gable gable(folder.path());
  gable.lift_steps = 12;  // With less the slope is flat, and its strays leave it.
  gable.build([](int c, int) { return c <= 0 ? 1U : 2U; });
  gable.sweep(false);
  for (int r = 0; r < Gable::kLength; ++r) EXPECT_EQ(gable.labels[gable.id(1, r)], 2U) << r;
}

TEST(Reassignment, PointsFarOffTheirFlatSegment_LeaveIt) {
  for (const bool published : {true, false}) {
    const test::TempFolder folder;
    Gable gable(folder.path());
    gable.lift_steps = 9;
    gable.lift_every = 6;
    gable.build([](int c, int) { return c <= 0 ? 1U : 2U; });
    gable.sweep(published);
    for (int r = 0; r < Gable::kLength; ++r)
      EXPECT_EQ(gable.labels[gable.id(1, r)], r % 6 == 0 && !published ? 0U : 2U) << r;
  }
}

TEST(Reassignment, PointsFarFromEveryPlane_StayWithoutSegment) {
  const test::TempFolder folder;
  Gable gable(folder.path());
  gable.lift_steps = 60;
  gable.build([](int c, int) { return c == 1 ? 0U : c < 1 ? 1U : 2U; });
  for (int sweep = 0; sweep < 3; ++sweep) gable.sweep(false);
  for (int r = 0; r < Gable::kLength; ++r) EXPECT_EQ(gable.labels[gable.id(1, r)] == 0, r % 2 == 0) << r;
}

TEST(Reassignment, DuplicatesFollowAndCount) {
  const test::TempFolder folder;
  Gable gable(folder.path());
  gable.build([](int c, int) { return std::abs(c) <= 1 ? 0U : c < 0 ? 1U : 2U; });
  TilePoints twice;
  twice.positions = {gable.position(1, 3)};
  twice.ids = {gable.id(1, 3)};
  twice.duplicates = {{gable.labels.size(), 0}};
  twice.core = {{-1000, -1000, -1000}, {1000, 1000, 1000}};
  gable.duplicates.append(twice);
  gable.labels.push_back(0);
  const std::uint64_t before = gable.moments.points(2);
  gable.sweep(false);
  EXPECT_EQ(gable.labels.back(), 2U);
  EXPECT_EQ(gable.moments.points(2), before + Gable::kLength + 1);
}

TEST(SegmentFrontier, KeepBorder_DropsWhatIsInsideOneSegment_WhateverFitsIntoMemory) {
  std::vector<std::uint32_t> from_disk;
  // Nothing, two of the three columns of the border, all.
  for (const std::uint64_t most_bytes : {std::uint64_t{0}, std::uint64_t{1000}, std::uint64_t{1} << 30}) {
    const test::TempFolder folder;
    Gable gable(folder.path());
    gable.build([](int c, int) { return c < 0 ? 1U : c == 0 ? 0U : 2U; });
    gable.frontier.keep_border(gable.labels, most_bytes);
    EXPECT_EQ(gable.frontier.records(), 3U * Gable::kLength);
    std::vector<std::uint32_t> ids;
    gable.frontier.for_each_blocks([&](std::span<const FrontierBlock> blocks) {
      for (const FrontierBlock& points : blocks) {
        for (std::size_t i = 0; i < points.size(); ++i) {
          const FrontierPoint p = points.point(i);
          EXPECT_LE(std::abs(p.position.x), Gable::kStep);
          EXPECT_GE(p.neighbours.size(), 3U);
          ids.push_back(p.id);
          ids.insert(ids.end(), p.neighbours.begin(), p.neighbours.end());
        }
      }
    });
    if (most_bytes == 0) from_disk = ids;
    EXPECT_EQ(ids, from_disk);
  }
}

TEST(SegmentSides, PointsOnBothSides_TellNothing) {
  std::vector<SegmentPlane> planes(2);
  planes[0].spacing = planes[1].spacing = 10.0;
  SegmentSides sides(planes);
  EXPECT_EQ(sides.side(1, 2), 0);
  sides.add(1, 2, {0, 0, 12});
  EXPECT_EQ(sides.side(1, 2), 1);
  EXPECT_EQ(sides.side(2, 1), 0);
  sides.add(1, 2, {0, 0, -11});
  EXPECT_EQ(sides.side(1, 2), 0);
  for (int i = 0; i < 9; ++i) sides.add(1, 2, {i, 0, -11});
  EXPECT_EQ(sides.side(1, 2), -1);
}

TEST(SegmentSides, SumsOfParts_AreTheSumOfAll) {
  std::vector<SegmentPlane> planes(2);
  planes[0].spacing = planes[1].spacing = 10.0;
  SegmentSides all(planes), part(planes);
  for (int i = 0; i < 3; ++i) all.add(1, 2, {0, 0, 12});
  part.add(1, 2, {0, 0, -12}, 3);
  all.add(part);
  EXPECT_EQ(all.side(1, 2), 0);
  part.add(2, 1, {0, 0, 5});
  all.add(part);
  EXPECT_EQ(all.side(1, 2), 0);
  EXPECT_EQ(all.side(2, 1), 1);
  all.add(part);
  EXPECT_EQ(all.side(1, 2), -1);
}

}  // namespace
}  // namespace arris::merge
