// Where segments of known solids end and meet.

#include "features/segment_contours/segment_contours.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>

#include "core/columns.h"
#include "random_clouds.h"
#include "segment_testing.h"

namespace arris {
namespace {

const Lattice kMillimetres{0.001, {0.0, 0.0, 0.0}};
constexpr double kSpacing = 100.0;  ///< Steps.

/// Patches of jittered grids, one segment each.
struct Scan {
  std::vector<LatticePoint> positions;
  std::vector<std::uint32_t> labels;

  /// A parallelogram at `corner`, `n` x `m` points along two unit directions.
  void add(std::uint32_t label, const Vector3& corner, const Vector3& u, int n, const Vector3& v, int m) {
    std::mt19937 random(label);
    std::uniform_real_distribution<double> jitter(-0.2, 0.2);
    for (int i = 0; i < n; ++i) {
      for (int j = 0; j < m; ++j) {
        const double a = kSpacing * (i + 0.5 + jitter(random)), b = kSpacing * (j + 0.5 + jitter(random));
        const auto at = [&](std::size_t axis) {
          return static_cast<std::int32_t>(std::lround(corner[axis] + a * u[axis] + b * v[axis]));
        };
        positions.push_back({at(0), at(1), at(2)});
        labels.push_back(label);
      }
    }
  }
  TilePoints tile() const {
    TilePoints tile;
    tile.core = tile.covered = test::everything();
    tile.positions.assign(positions.begin(), positions.end());
    for (std::size_t i = 0; i < positions.size(); ++i) tile.ids.push_back(i);
    return tile;
  }
  SegmentContours contours(const SegmentContourParameters& parameters = {}) const {
    return analyse_segment_contours(tile(), labels, test::planes_of(positions, labels, kSpacing), kMillimetres,
                                    parameters);
  }
};

constexpr Vector3 kX{1, 0, 0}, kY{0, 1, 0}, kZ{0, 0, 1}, kDown{0, 0, -1};

/// Checks that the fold points of a scan are those within a spacing of the line x = z = 0, and their side and angle.
void expect_fold_at_y_axis(const Scan& scan, std::uint8_t side, double angle_deg) {
  std::map<std::uint64_t, ContourRecord> folds;
  for (const ContourRecord& record : scan.contours().records) {
    if (record.classes & kFold) folds[record.id] = record;
  }
  ASSERT_FALSE(folds.empty());
  for (std::size_t i = 0; i < scan.positions.size(); ++i) {
    const LatticePoint& p = scan.positions[i];
    const double distance = std::hypot(p.x, p.z);
    EXPECT_EQ(folds.count(i), distance < kSpacing ? 1U : 0U) << p.x << " " << p.y << " " << p.z;
    if (folds.count(i) == 0) continue;
    const ContourRecord& record = folds[i];
    EXPECT_EQ(record.classes, kFold | side);
    EXPECT_NEAR(record.fold_angle_deg, angle_deg, 0.2);
    EXPECT_NEAR(record.to_edge[0], -0.001 * p.x, 0.002);
    EXPECT_NEAR(record.to_edge[1], 0.0, 0.002);
    EXPECT_NEAR(record.to_edge[2], -0.001 * p.z, 0.002);
    EXPECT_GT(record.score, 0.4F);
    EXPECT_LE(record.score, 1.0F);
  }
}

TEST(SegmentFolds, EdgeOfABox_IsConvex) {
  Scan scan;
  scan.add(1, {0, 0, 0}, kX, 20, kY, 30);
  scan.add(2, {0, 0, 0}, kDown, 20, kY, 30);
  expect_fold_at_y_axis(scan, kConvex, 90.0);
}

TEST(SegmentFolds, FootOfAWall_IsConcave) {
  Scan scan;
  scan.add(1, {0, 0, 0}, kX, 20, kY, 30);
  scan.add(2, {0, 0, 0}, kZ, 20, kY, 30);
  expect_fold_at_y_axis(scan, kConcave, 90.0);
}

TEST(SegmentFolds, FloorOnBothSidesOfTheWall_IsConcaveToo) {
  Scan scan;
  scan.add(1, {-2000, 0, 0}, kX, 40, kY, 30);
  scan.add(2, {0, 0, 0}, kZ, 20, kY, 30);
  expect_fold_at_y_axis(scan, kConcave, 90.0);
}

TEST(SegmentFolds, RidgeOfARoof_HasItsInteriorAngle) {
  const double c = std::cos(0.3), s = std::sin(0.3);
  Scan scan;
  scan.add(1, {0, 0, 0}, {c, 0, -s}, 20, kY, 30);
  scan.add(2, {0, 0, 0}, {-c, 0, -s}, 20, kY, 30);
  expect_fold_at_y_axis(scan, kConvex, 180.0 - 2.0 * 0.3 * 180.0 / 3.14159265);
}

TEST(SegmentFolds, ValleyOfARoof_IsConcave) {
  const double c = std::cos(0.3), s = std::sin(0.3);
  Scan scan;
  scan.add(1, {0, 0, 0}, {c, 0, s}, 20, kY, 30);
  scan.add(2, {0, 0, 0}, {-c, 0, s}, 20, kY, 30);
  expect_fold_at_y_axis(scan, kConcave, 180.0 - 2.0 * 0.3 * 180.0 / 3.14159265);
}

TEST(SegmentFolds, ViewFromBelow_TurnsSidesAround) {
  Scan scan;
  scan.add(1, {0, 0, 0}, kX, 20, kY, 30);
  scan.add(2, {0, 0, 0}, kDown, 20, kY, 30);
  SegmentContourParameters parameters;
  parameters.view = ArrisParameters::View::kPoint;
  parameters.viewpoint = {1.0, 1.5, -1.0};
  for (const ContourRecord& record : scan.contours(parameters).records) {
    if (record.classes & kFold) {
      EXPECT_EQ(record.classes, kFold | kConcave);
    }
  }
}

TEST(SegmentFolds, GapOfThreeSpacings_IsTwoBoundaries) {
  Scan scan;
  scan.add(1, {350, 0, 0}, kX, 20, kY, 30);
  scan.add(2, {0, 0, -350}, kDown, 20, kY, 30);
  int beside_the_gap = 0;
  for (const ContourRecord& record : scan.contours().records) {
    EXPECT_EQ(record.classes, kBoundary);
    const LatticePoint& p = scan.positions[record.id];
    beside_the_gap += std::hypot(p.x, p.z) < 460.0;
  }
  EXPECT_GE(beside_the_gap, 58);
}

TEST(SegmentBoundaries, EndsAreBoundariesAndFoldsAreNot) {
  Scan scan;
  scan.add(1, {0, 0, 0}, kX, 20, kY, 30);
  scan.add(2, {0, 0, 0}, kDown, 20, kY, 30);
  for (const ContourRecord& record : scan.contours().records) {
    const LatticePoint& p = scan.positions[record.id];
    if (record.classes & kFold) continue;
    EXPECT_EQ(record.classes, kBoundary);
    EXPECT_GT(record.score, 0.0F);
    const bool rim = p.y < kSpacing || p.y > 29 * kSpacing || p.x > 19 * kSpacing || p.z < -19 * kSpacing;
    EXPECT_TRUE(rim) << p.x << " " << p.y << " " << p.z;
  }
}

TEST(SegmentBoundaries, ParallelStep_EndsBothSides) {
  Scan scan;
  scan.add(1, {-2000, 0, 0}, kX, 20, kY, 30);
  scan.add(2, {0, 0, 1000}, kX, 20, kY, 30);
  int at_the_step = 0;
  for (const ContourRecord& record : scan.contours().records) {
    EXPECT_EQ(record.classes, kBoundary);
    at_the_step += std::abs(scan.positions[record.id].x) < 100;
  }
  EXPECT_GE(at_the_step, 57);  // A few stand back behind their neighbours.
}

TEST(SegmentBoundaries, SurfaceCutIntoTwoSegments_HasNoBoundaryAtTheSeam) {
  Scan scan;
  scan.add(1, {-2000, 0, 0}, kX, 20, kY, 30);
  scan.add(2, {0, 0, 0}, {std::cos(0.1), 0, std::sin(0.1)}, 20, kY, 30);
  for (const ContourRecord& record : scan.contours().records) {
    EXPECT_EQ(record.classes, kBoundary);
    const LatticePoint& p = scan.positions[record.id];
    EXPECT_TRUE(std::abs(p.x) > 100 || p.y < 100 || p.y > 2900) << p.x << " " << p.y;
  }
}

TEST(SegmentBoundaries, PointsWithoutSegment_HaveNoContours) {
  Scan scan;
  scan.add(1, {0, 0, 0}, kX, 10, kY, 10);
  scan.labels.assign(scan.labels.size(), 0);
  const SegmentContours contours = scan.contours();
  EXPECT_TRUE(contours.records.empty());
  EXPECT_TRUE(contours.edges.empty());
}

TEST(SegmentOutlineEdges, Plate_IsGoneRoundOnceCounterclockwise) {
  Scan scan;
  scan.add(1, {0, 0, 0}, kX, 20, kY, 30);
  const SegmentContours contours = scan.contours();
  EXPECT_TRUE(std::is_sorted(contours.edges.begin(), contours.edges.end()));
  double twice_area = 0.0;
  for (const OutlineEdge& e : contours.edges) {
    EXPECT_EQ(e.segment, 1U);
    EXPECT_EQ(e.from_position, scan.positions[e.from]);
    EXPECT_EQ(e.to_position, scan.positions[e.to]);
    twice_area += double(e.from_position.x) * e.to_position.y - double(e.from_position.y) * e.to_position.x;
  }
  EXPECT_NEAR(twice_area, 2.0 * 19 * 29 * kSpacing * kSpacing, 0.02 * 2.0 * 19 * 29 * kSpacing * kSpacing);
  EXPECT_NEAR(double(contours.edges.size()), 96.0, 8.0);
}

}  // namespace
}  // namespace arris
