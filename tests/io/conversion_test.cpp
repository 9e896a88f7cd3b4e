#include <cmath>
#include <limits>

#include "io/las_grid.h"
#include "io_helpers.h"
#include "las_builder.h"
#include "ply_builder.h"

namespace arris::test {
namespace {

const std::vector<ColumnSpec> kColumns{{"Id", ColumnType::kUint32, "number"}};
std::string row_of(std::uint64_t id) {
  std::string bytes(4, '\0');
  put<std::uint32_t>(bytes, 0, static_cast<std::uint32_t>(id + 1000));
  return bytes;
}
bool all(std::uint64_t) {
  return true;
}

class Conversion : public ::testing::Test {
 protected:
  TempFolder folder_;
};

TEST_F(Conversion, LasToPly_CarriesTheFieldsOfEveryFormat) {
  for (int format = 0; format <= 10; ++format) {
    LasPlan plan;
    plan.minor = 4;
    plan.format = format;
    plan.record_bytes = kFormatBytes[static_cast<std::size_t>(format)] + 3;
    plan.points = make_records(9, plan.record_bytes, static_cast<unsigned>(format));
    plan.vlrs = {{"LASF_Projection", 2112, "CRS"}};
    write_new(folder_ / "in.las", build_las(plan));
    std::filesystem::remove(folder_ / "out.ply");
    const auto warnings = write_kept(
        folder_ / "out.ply", {folder_ / "in.las"}, kColumns, [](std::uint64_t id) { return id != 4; }, row_of);
    EXPECT_HAS(warnings.at(0), "flags");
    const AllPoints read = read_all(folder_ / "out.ply");
    ASSERT_EQ(read.records.size(), 8U);
    const bool wide = format >= 6;
    for (std::size_t out = 0; out < 8; ++out) {
      const std::size_t in = out < 4 ? out : out + 1;
      const std::string& p = plan.points[in];
      const std::string& q = read.records[out];
      for (std::size_t axis = 0; axis < 3; ++axis) {
        EXPECT_EQ(read.world[out][axis], get<std::int32_t>(p, 4 * axis) * plan.scale[axis] + plan.offset[axis]);
      }
      EXPECT_EQ(get<std::uint16_t>(q, 24), get<std::uint16_t>(p, 12));
      EXPECT_EQ(q[26], p[14] & (wide ? 15 : 7));
      EXPECT_EQ(get<std::uint8_t>(q, 27), wide ? get<std::uint8_t>(p, 14) >> 4 : (p[14] >> 3) & 7);
      EXPECT_EQ(get<std::uint8_t>(q, 28), wide ? get<std::uint8_t>(p, 16) : p[15] & 31);
      EXPECT_EQ(get<float>(q, 29),
                wide ? static_cast<float>(get<std::int16_t>(p, 18) * 0.006) : get<std::int8_t>(p, 16));
      EXPECT_EQ(q[33], p[17]);
      EXPECT_EQ(get<std::uint16_t>(q, 34), get<std::uint16_t>(p, wide ? 20 : 18));
      std::size_t at = 36;
      if (format != 0 && format != 2) {
        EXPECT_EQ(q.substr(at, 8), p.substr(wide ? 22 : 20, 8));
        at += 8;
      }
      const std::size_t colour = format == 2                                  ? 20
                                 : format == 3 || format == 5                 ? 28
                                 : format == 7 || format == 8 || format == 10 ? 30
                                                                              : 0;
      if (colour != 0) {
        EXPECT_EQ(q.substr(at, 6), p.substr(colour, 6));
        at += 6;
      }
      EXPECT_EQ(q.substr(at), row_of(in));
    }
  }
}

TEST_F(Conversion, PlyToLas_CarriesWhatItRecognises) {
  for (const std::string format : {"ascii", "binary_little_endian", "binary_big_endian"}) {
    for (const bool colour : {false, true}) {
      std::vector<PlyColumn> columns{{"classification", "uchar"},
                                     {"x", "double"},
                                     {"list", "int", "uchar"},
                                     {"y", "double"},
                                     {"z", "double"},
                                     {"intensity", "ushort"},
                                     {"curvature", "float"},
                                     {"gps_time", "double"}};
      if (colour) columns.insert(columns.end(), {{"red", "uchar"}, {"green", "uchar"}, {"blue", "uchar"}});
      PlyTable vertices{"vertex", columns, {}};
      for (int i = 0; i < 5; ++i) {
        std::vector<PlyCell> row{{200.0 + i}, {1000000.5 + i}, PlyCell(static_cast<std::size_t>(i), 3.0),
                                 {-2.25 * i}, {i * 0.0001},    {60000.0 + i},
                                 {0.5},       {1e9 + i / 8.0}};
        if (colour) row.insert(row.end(), {{255.0}, {static_cast<double>(i)}, {0.0}});
        vertices.rows.push_back(row);
      }
      write_new(folder_ / "in.ply", build_ply({format, "\n", {}, {vertices}}));
      std::filesystem::remove(folder_ / "out.las");
      const auto warnings = write_kept(folder_ / "out.las", {folder_ / "in.ply"}, kColumns, all, row_of);
      EXPECT_HAS(warnings.at(0), "list, curvature");
      const LasParts parts = read_parts(file_bytes(folder_ / "out.las"));
      EXPECT_EQ(parts.minor, 4);
      EXPECT_EQ(parts.format, colour ? 7 : 6);
      EXPECT_EQ(parts.legacy_points, 0U);
      ASSERT_EQ(parts.records.size(), 5U);
      EXPECT_EQ(parts.by_return[0], 5U);
      ASSERT_EQ(parts.vlrs.size(), 1U);
      EXPECT_EQ(parts.vlrs[0].payload.substr(4, 3), std::string("Id\0", 3));
      const auto source = io::open_point_source(folder_ / "out.las");
      for (std::size_t i = 0; i < 5; ++i) {
        const std::string& r = parts.records[i];
        const double n = static_cast<double>(i);
        const std::array<double, 3> expected{1000000.5 + n, -2.25 * n, n * 0.0001};
        for (std::size_t axis = 0; axis < 3; ++axis) {
          const double world =
              get<std::int32_t>(r, 4 * axis) * source->info().scale[axis] + source->info().offset[axis];
          EXPECT_NEAR(world, expected[axis], source->info().scale[axis] * 0.5001);
        }
        EXPECT_EQ(get<std::uint16_t>(r, 12), 60000 + i);
        EXPECT_EQ(r[14], 0x11);
        EXPECT_EQ(get<std::uint8_t>(r, 16), 200 + i);
        EXPECT_EQ(get<double>(r, 22), 1e9 + n / 8.0);
        if (colour) {
          EXPECT_EQ(get<std::uint16_t>(r, 30), 65535);
          EXPECT_EQ(get<std::uint16_t>(r, 32), 257 * i);
        }
        EXPECT_EQ(r.substr(colour ? 36 : 30), row_of(i));
      }
    }
  }
}

TEST_F(Conversion, PlyToLas_LeavesOutPointsWithoutPlace) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  PlyTable vertices{
      "vertex", {{"x"}, {"y"}, {"z"}}, {{{1.0}, {2.0}, {3.0}}, {{nan}, {0.0}, {0.0}}, {{4.0}, {5.0}, {6.0}}}};
  write_new(folder_ / "in.ply", build_ply({"binary_little_endian", "\n", {}, {vertices}}));
  const auto warnings = write_kept(folder_ / "out.las", {folder_ / "in.ply"}, kColumns, all, row_of);
  EXPECT_HAS(warnings.back(), "1 points without finite coordinates");
  const LasParts parts = read_parts(file_bytes(folder_ / "out.las"));
  ASSERT_EQ(parts.records.size(), 2U);
  EXPECT_EQ(parts.records[1].substr(30), row_of(2));
}

TEST_F(Conversion, MixedInputs_AreRefused) {
  write_new(folder_ / "a.las", build_las({}));
  write_new(folder_ / "b.ply", build_ply({"ascii", "\n", {}, {make_vertices({{"x"}, {"y"}, {"z"}}, 3)}}));
  const io::InputSet inputs({folder_ / "a.las", folder_ / "b.ply"});
  for (const char* name : {"out.las", "out.ply"}) {
    EXPECT_HAS(message_of<ConfigError>([&] { io::create_kept_point_writer(folder_ / name, inputs, {}, {}); }),
               "one is LAS, the other PLY");
  }
}

TEST(LasGrid, EveryExtent_FitsWithASensibleStep) {
  for (const double centre : {0.0, 0.3, 500000.0, -6e6}) {
    for (const double half : {1e-6, 0.05, 1.0, 50.0, 1e4, 2e5, 1e7}) {
      io::WorldExtent extent;
      extent.min = {centre - half, -half, centre - half / 2};
      extent.max = {centre + half, half, centre + half / 2};
      const io::LasGrid grid = io::choose_las_grid(extent);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        for (const double world : {extent.min[axis], extent.max[axis]}) {
          const auto stored = grid.stored(axis, world);
          ASSERT_TRUE(stored.has_value()) << centre << " " << half;
          EXPECT_NEAR(*stored * grid.scale + grid.offset[axis], world, 0.5001 * grid.scale + std::abs(world) * 1e-15);
        }
      }
      if (half >= 5.0 && half <= 1e5) {
        EXPECT_EQ(grid.scale, 0.0001);
      }
      if (half < 5.0 && half >= 1e-3) {
        EXPECT_GE(2 * half / grid.scale, 0.99e5);
      }
    }
  }
  EXPECT_EQ(io::choose_las_grid({}).scale, 0.0001);
  io::WorldExtent huge;
  huge.min = {-1e300, 0, 0};
  huge.max = {1e300, 0, 0};
  EXPECT_HAS(message_of<ConfigError>([&] { io::choose_las_grid(huge); }), "do not fit");
}

}  // namespace
}  // namespace arris::test
