// Tables of segments and their outlines as files.

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "core/error.h"
#include "merge/outline_rings.h"
#include "pipeline/outline_output.h"
#include "pipeline/segment_text.h"
#include "support/las_tools.h"
#include "support/temp_folder.h"

namespace arris::pipeline {
namespace {

merge::SegmentRow row_with_normal(double x, double y, double z) {
  merge::SegmentRow row;
  row.segment_id = 7;
  row.points = 1234567890123;
  row.area = 12.5;
  row.rms = 0.0123;
  row.centroid = {651000.12345, 6862000.5, 35.25};
  row.normal = {x, y, z};
  return row;
}

TEST(SegmentRow, Slope_GoesDownhillClockwiseFromNorth) {
  // The normal leans towards where the surface goes down.
  EXPECT_NEAR(*row_with_normal(0.0, 0.6, 0.8).azimuth_deg(), 0.0, 1e-12);
  EXPECT_NEAR(*row_with_normal(0.6, 0.0, 0.8).azimuth_deg(), 90.0, 1e-12);
  EXPECT_NEAR(*row_with_normal(0.0, -0.6, 0.8).azimuth_deg(), 180.0, 1e-12);
  EXPECT_NEAR(*row_with_normal(-0.6, 0.0, 0.8).azimuth_deg(), 270.0, 1e-12);
  EXPECT_NEAR(*row_with_normal(0.6, 0.0, -0.8).azimuth_deg(), 270.0, 1e-12);
  EXPECT_NEAR(row_with_normal(0.6, 0.0, 0.8).inclination_deg(), 36.8698976, 1e-6);
  EXPECT_NEAR(row_with_normal(1.0, 0.0, 0.0).inclination_deg(), 90.0, 1e-12);
  EXPECT_EQ(row_with_normal(0.0, 0.0, 1.0).inclination_deg(), 0.0);
  EXPECT_FALSE(row_with_normal(0.001, 0.0, 1.0).azimuth_deg().has_value());
  EXPECT_TRUE(row_with_normal(0.002, 0.0, 1.0).azimuth_deg().has_value());
}

TEST(SegmentText, Csv_HasAHeaderAndARowEach) {
  const test::TempFolder folder;
  std::vector<merge::SegmentRow> rows{row_with_normal(0.6, 0.0, 0.8), row_with_normal(0.0, 0.0, 1.0)};
  rows[1].area_from_outline = true;
  write_segments(folder / "a.CSV", rows, false);
  EXPECT_EQ(test::file_bytes(folder / "a.CSV"),
            "segment_id,points,area,area_from,rms,x,y,z,nx,ny,nz,inclination_deg,azimuth_deg\n"
            "7,1234567890123,12.5,points,0.0123,651000.1234,6862000.5000,35.2500,0.600000,0.000000,0.800000,36.870,"
            "90.000\n"
            "7,1234567890123,12.5,outline,0.0123,651000.1234,6862000.5000,35.2500,0.000000,0.000000,1.000000,0.000,\n");
}

TEST(SegmentText, Json_IsAnArrayOfObjects) {
  const test::TempFolder folder;
  const std::vector<merge::SegmentRow> rows{row_with_normal(0.6, 0.0, 0.8), row_with_normal(0.0, 0.0, 1.0)};
  write_segments(folder / "a.json", rows, false);
  const auto json = nlohmann::json::parse(test::file_bytes(folder / "a.json"));
  ASSERT_EQ(json.size(), 2U);
  EXPECT_EQ(json[0]["segment_id"], 7);
  EXPECT_EQ(json[0]["points"], 1234567890123);
  EXPECT_EQ(json[0]["area_from"], "points");
  EXPECT_EQ(json[0]["azimuth_deg"], 90.0);
  EXPECT_TRUE(json[1]["azimuth_deg"].is_null());
  write_segments(folder / "b.json", {}, false);
  EXPECT_TRUE(nlohmann::json::parse(test::file_bytes(folder / "b.json")).empty());
}

TEST(SegmentOutput, Names_AreCheckedBefore) {
  const test::TempFolder folder;
  EXPECT_NO_THROW(check_text_output({}, "--table", false));
  EXPECT_NO_THROW(check_text_output(folder / "a.csv", "--table", false));
  EXPECT_THROW(check_text_output(folder / "a.txt", "--table", false), ConfigError);
  EXPECT_NO_THROW(check_outline_output(folder / "a.GPKG", "--outlines", false));
  EXPECT_NO_THROW(check_outline_output(folder / "a.obj", "--outlines", false));
  EXPECT_THROW(check_outline_output(folder / "a.shp", "--outlines", false), ConfigError);
  test::write_bytes(folder / "old.obj", "x");
  EXPECT_THROW(check_outline_output(folder / "old.obj", "--outlines", false), ConfigError);
  EXPECT_NO_THROW(check_outline_output(folder / "old.obj", "--outlines", true));
}

/// A square of 100 steps on the plane z = 50, whose first corner is a step above it.
struct Square {
  Lattice lattice{0.01, {1000.0, 2000.0, 0.0}};
  SegmentPlane plane;
  merge::SegmentOutline outline;

  Square() {
    plane.centroid = {50.0, 50.0, 50.0};
    const std::vector<LatticePoint> p{{0, 0, 51}, {100, 0, 50}, {100, 100, 50}, {0, 100, 50}};
    std::vector<OutlineEdge> edges;
    for (std::uint64_t i = 0; i < 4; ++i) edges.push_back({7, i, (i + 1) % 4, p[i], p[(i + 1) % 4]});
    outline = merge::link_outline(edges, plane, lattice);
  }
};

TEST(OutlineOutput, Vertices_AreOnThePlane) {
  const Square square;
  const auto features = polygon_features(square.outline, square.plane, row_with_normal(0.0, 0.0, 1.0), square.lattice);
  ASSERT_EQ(features.size(), 1U);
  EXPECT_EQ(features[0].segment_id, 7U);
  EXPECT_NEAR(features[0].area, 1.0, 1e-9);
  EXPECT_FALSE(features[0].azimuth_deg.has_value());
  ASSERT_EQ(features[0].outer.size(), 4U);
  for (const auto& position : features[0].outer) EXPECT_NEAR(position[2], 0.5, 1e-12);
  EXPECT_NEAR(features[0].outer[2][0], 1001.0, 1e-9);
  EXPECT_NEAR(features[0].outer[2][1], 2001.0, 1e-9);
}

TEST(OutlineOutput, Extension_PicksTheFormat) {
  const Square square;
  const test::TempFolder folder;
  for (const char* name : {"a.gpkg", "a.obj"}) {
    OutlineOutput output(folder / name, false, {}, square.lattice);
    output.add(square.outline, square.plane, row_with_normal(0.0, 0.0, 1.0));
    EXPECT_FALSE(std::filesystem::exists(folder / name));
    output.commit();
  }
  EXPECT_EQ(test::file_bytes(folder / "a.gpkg").substr(0, 15), "SQLite format 3");
  EXPECT_EQ(test::file_bytes(folder / "a.obj"),
            "# Outlines of planar segments\ng segment_7\n"
            "v 1000.000 2000.000 0.500\nv 1001.000 2000.000 0.500\nv 1001.000 2001.000 0.500\n"
            "v 1000.000 2001.000 0.500\nl 1 2 3 4 1\n");
}

}  // namespace
}  // namespace arris::pipeline
