// Polygons written as GeoPackage and OBJ, read back with SQLite itself and by hand.

#include <sqlite3.h>
#include <sys/resource.h>

#include <csignal>
#include <cstring>

#include "io/geopackage_writer.h"
#include "io/obj_polygons.h"
#include "io_helpers.h"

namespace arris::io {
namespace {

namespace fs = std::filesystem;
using Row = std::vector<std::string>;

/// Rows of a query, blobs as they are, NULL as "NULL".
std::vector<Row> query(const fs::path& path, const std::string& statement) {
  sqlite3* database = nullptr;
  EXPECT_EQ(sqlite3_open_v2(path.c_str(), &database, SQLITE_OPEN_READONLY, nullptr), SQLITE_OK);
  sqlite3_stmt* prepared = nullptr;
  EXPECT_EQ(sqlite3_prepare_v2(database, statement.c_str(), -1, &prepared, nullptr), SQLITE_OK)
      << sqlite3_errmsg(database);
  std::vector<Row> rows;
  while (sqlite3_step(prepared) == SQLITE_ROW) {
    Row& row = rows.emplace_back();
    for (int i = 0; i < sqlite3_column_count(prepared); ++i) {
      const bool null = sqlite3_column_type(prepared, i) == SQLITE_NULL;
      const void* value = sqlite3_column_blob(prepared, i);
      row.push_back(null ? "NULL"
                         : std::string(static_cast<const char*>(value),
                                       static_cast<std::size_t>(sqlite3_column_bytes(prepared, i))));
    }
  }
  sqlite3_finalize(prepared);
  sqlite3_close(database);
  return rows;
}

PolygonFeature square_with_hole(std::uint32_t id, double at) {
  PolygonFeature feature;
  feature.segment_id = id;
  feature.points = 1234;
  feature.area = 99.0;
  feature.rms = 0.25;
  feature.inclination_deg = 30.0;
  feature.azimuth_deg = 270.0;
  feature.outer = {{at, 0, 1}, {at + 10, 0, 2}, {at + 10, 10, 3}, {at, 10, 4}};
  feature.holes = {{{at + 1, 1, 1}, {at + 1, 2, 1}, {at + 2, 1, 1}}};
  return feature;
}

void write(const fs::path& path, const CrsSummary& crs, int features = 2) {
  GeoPackageWriter writer(path, false, crs);
  for (int i = 0; i < features; ++i) {
    PolygonFeature feature = square_with_hole(static_cast<std::uint32_t>(i + 1), 20.0 * i);
    if (i == 1) feature.azimuth_deg.reset();
    writer.add(feature);
  }
  writer.commit();
}

template <class T>
T take(std::string_view& bytes) {
  T value;
  std::memcpy(&value, bytes.data(), sizeof value);
  bytes.remove_prefix(sizeof value);
  return value;
}

TEST(GeoPackageWriter, Rows_HaveGeometryAndAttributes) {
  const test::TempFolder folder;
  write(folder / "a.gpkg", {});
  const auto rows = query(
      folder / "a.gpkg", "SELECT fid, segment_id, points, area, rms, inclination_deg, azimuth_deg, geom FROM segments");
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_EQ(Row(rows[0].begin(), rows[0].end() - 1), (Row{"1", "1", "1234", "99.0", "0.25", "30.0", "270.0"}));
  EXPECT_EQ(rows[1][6], "NULL");
  std::string_view blob = rows[1][7];
  EXPECT_EQ(blob.substr(0, 4), std::string_view("GP\0\x05", 4));
  blob.remove_prefix(4);
  EXPECT_EQ(take<std::int32_t>(blob), -1);
  for (const double bound : {20.0, 30.0, 0.0, 10.0, 1.0, 4.0}) EXPECT_EQ(take<double>(blob), bound);
  EXPECT_EQ(take<std::uint8_t>(blob), 1);
  EXPECT_EQ(take<std::uint32_t>(blob), 1003U);
  EXPECT_EQ(take<std::uint32_t>(blob), 2U);
  EXPECT_EQ(take<std::uint32_t>(blob), 5U);
  const double outer[] = {20, 0, 1, 30, 0, 2, 30, 10, 3, 20, 10, 4, 20, 0, 1};
  for (const double c : outer) EXPECT_EQ(take<double>(blob), c);
  EXPECT_EQ(take<std::uint32_t>(blob), 4U);
  const double hole[] = {21, 1, 1, 21, 2, 1, 22, 1, 1, 21, 1, 1};
  for (const double c : hole) EXPECT_EQ(take<double>(blob), c);
  EXPECT_TRUE(blob.empty());
}

TEST(GeoPackageWriter, File_IsAGeoPackage13) {
  const test::TempFolder folder;
  const fs::path path = folder / "a.gpkg";
  write(path, {});
  EXPECT_EQ(query(path, "PRAGMA application_id")[0][0], std::to_string(0x47504B47));
  EXPECT_EQ(query(path, "PRAGMA user_version")[0][0], "10300");
  EXPECT_EQ(query(path, "PRAGMA integrity_check")[0][0], "ok");
  EXPECT_TRUE(query(path, "PRAGMA foreign_key_check").empty());
  EXPECT_EQ(test::file_bytes(path).substr(0, 16), std::string("SQLite format 3\0", 16));
  EXPECT_EQ(query(path, "SELECT srs_id FROM gpkg_spatial_ref_sys ORDER BY srs_id"),
            (std::vector<Row>{{"-1"}, {"0"}, {"4326"}}));
  EXPECT_EQ(
      query(path, "SELECT table_name, data_type, last_change, min_x, min_y, max_x, max_y, srs_id FROM gpkg_contents"),
      (std::vector<Row>{{"segments", "features", "1970-01-01T00:00:00.000Z", "0.0", "0.0", "30.0", "10.0", "-1"}}));
  EXPECT_EQ(query(path, "SELECT * FROM gpkg_geometry_columns"),
            (std::vector<Row>{{"segments", "geom", "POLYGON", "-1", "1", "0"}}));
}

TEST(GeoPackageWriter, ReferenceSystems_AreRegistered) {
  const test::TempFolder folder;
  const auto written = [&](const CrsSummary& crs) {
    const fs::path path = folder / "a.gpkg";
    fs::remove(path);
    write(path, crs, 1);
    return query(path,
                 "SELECT srs_id, organization, organization_coordsys_id, definition FROM gpkg_spatial_ref_sys "
                 "WHERE srs_id = (SELECT srs_id FROM gpkg_contents)")[0];
  };
  const std::string wkt = R"(PROJCS["RGF93 / Lambert-93",GEOGCS["RGF93"],AUTHORITY["EPSG","2154"]])";
  EXPECT_EQ(written({"RGF93 / Lambert-93", "metre", wkt, 2154}), (Row{"2154", "EPSG", "2154", wkt}));
  EXPECT_EQ(written({"EPSG:2154", "metre", "EPSG:2154", 2154}), (Row{"2154", "EPSG", "2154", "undefined"}));
  const std::string own = R"(LOCAL_CS["site"])";
  EXPECT_EQ(written({"site", "", own, 0}), (Row{"100000", "NONE", "100000", own}));
  EXPECT_EQ(written({"site", "", R"(LOCAL_CS["si)", 0})[0], "-1");
  EXPECT_EQ(written({"some citation", "", "some citation", 0})[0], "-1");
  EXPECT_EQ(written({"WGS 84", "degree", R"(GEOGCS["WGS 84"])", 4326})[0], "4326");
}

TEST(GeoPackageWriter, NoFeatures_IsAnEmptyLayer) {
  const test::TempFolder folder;
  write(folder / "a.gpkg", {}, 0);
  EXPECT_EQ(query(folder / "a.gpkg", "SELECT min_x, max_y FROM gpkg_contents"), (std::vector<Row>{{"NULL", "NULL"}}));
  EXPECT_TRUE(query(folder / "a.gpkg", "SELECT * FROM segments").empty());
}

TEST(GeoPackageWriter, SameFeatures_GiveTheSameBytes) {
  const test::TempFolder folder;
  write(folder / "a.gpkg", {}, 20000);
  write(folder / "b.gpkg", {}, 20000);
  EXPECT_GT(fs::file_size(folder / "a.gpkg"), 4000000U);
  EXPECT_TRUE(test::file_bytes(folder / "a.gpkg") == test::file_bytes(folder / "b.gpkg"));
}

TEST(GeoPackageWriter, WithoutCommit_LeavesNothing) {
  const test::TempFolder folder;
  {
    GeoPackageWriter writer(folder / "a.gpkg", false, {});
    writer.add(square_with_hole(1, 0.0));
    EXPECT_FALSE(fs::exists(folder / "a.gpkg"));
  }
  EXPECT_TRUE(fs::is_empty(folder.path()));
}

TEST(GeoPackageWriter, ExistingFile_IsRefusedOrReplaced) {
  const test::TempFolder folder;
  write(folder / "a.gpkg", {});
  const std::string before = test::file_bytes(folder / "a.gpkg");
  EXPECT_THROW(GeoPackageWriter(folder / "a.gpkg", false, {}), ConfigError);
  EXPECT_TRUE(test::file_bytes(folder / "a.gpkg") == before);
  GeoPackageWriter writer(folder / "a.gpkg", true, {});
  writer.commit();
  EXPECT_TRUE(query(folder / "a.gpkg", "SELECT * FROM segments").empty());
  EXPECT_THROW(GeoPackageWriter(folder / "absent" / "a.gpkg", true, {}), IoError);
}

TEST(GeoPackageWriter, FailingWrite_IsAnErrorAndLeavesNothing) {
  const test::TempFolder folder;
  rlimit before{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  rlimit small = before;
  small.rlim_cur = 3 << 20;
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
  const std::string text = test::message_of<IoError>([&] { write(folder / "a.gpkg", {}, 20000); });
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  EXPECT_HAS(text, "a.gpkg");
  EXPECT_HAS(text, "writing failed");
  EXPECT_TRUE(fs::is_empty(folder.path()));
}

TEST(ObjPolygonWriter, Rings_AreClosedLinesInGroups) {
  const test::TempFolder folder;
  ObjPolygonWriter writer(folder / "a.obj", false, 2);
  writer.add(square_with_hole(3, 0.0));
  PolygonFeature triangle = square_with_hole(3, 20.0);
  triangle.outer.pop_back();
  triangle.holes.clear();
  writer.add(triangle);
  triangle.segment_id = 5;
  writer.add(triangle);
  writer.commit();
  const std::string text = test::file_bytes(folder / "a.obj");
  EXPECT_EQ(text,
            "# Outlines of planar segments\n"
            "g segment_3\n"
            "v 0.00 0.00 1.00\nv 10.00 0.00 2.00\nv 10.00 10.00 3.00\nv 0.00 10.00 4.00\nl 1 2 3 4 1\n"
            "v 1.00 1.00 1.00\nv 1.00 2.00 1.00\nv 2.00 1.00 1.00\nl 5 6 7 5\n"
            "v 20.00 0.00 1.00\nv 30.00 0.00 2.00\nv 30.00 10.00 3.00\nl 8 9 10 8\n"
            "g segment_5\n"
            "v 20.00 0.00 1.00\nv 30.00 0.00 2.00\nv 30.00 10.00 3.00\nl 11 12 13 11\n");
}

}  // namespace
}  // namespace arris::io
