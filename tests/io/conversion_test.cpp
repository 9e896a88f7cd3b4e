#include <cmath>
#include <limits>

#include "io/las_grid.h"
#include "io_helpers.h"
#include "las_builder.h"
#include "ply_builder.h"
#include "ply_view.h"

namespace arris::test {
namespace {

bool all(std::uint64_t) {
  return true;
}
bool has_line(const std::vector<std::string>& lines, const std::string& part) {
  return std::any_of(lines.begin(), lines.end(),
                     [&](const std::string& line) { return line.find(part) != std::string::npos; });
}

/// The fields of a LAS record by the names that conversions give them, straight from the specification.
std::map<std::string, double> fields_of(const std::string& p, int format) {
  const bool wide = format >= 6;
  std::map<std::string, double> fields;
  const auto byte = [&](std::size_t at) { return static_cast<unsigned>(static_cast<unsigned char>(p[at])); };
  fields["intensity"] = get<std::uint16_t>(p, 12);
  fields["return_number"] = byte(14) & (wide ? 15U : 7U);
  fields["number_of_returns"] = wide ? byte(14) >> 4 : (byte(14) >> 3) & 7U;
  fields["scan_direction_flag"] = (byte(wide ? 15 : 14) >> 6) & 1U;
  fields["edge_of_flight_line"] = byte(wide ? 15 : 14) >> 7;
  fields["classification"] = wide ? byte(16) : byte(15) & 31U;
  fields["classification_flags"] = wide ? byte(15) & 15U : byte(15) >> 5;
  if (wide) fields["scanner_channel"] = (byte(15) >> 4) & 3U;
  fields["scan_angle"] = wide ? static_cast<float>(get<std::int16_t>(p, 18) * 0.006) : get<std::int8_t>(p, 16);
  fields["user_data"] = byte(17);
  fields["point_source_id"] = get<std::uint16_t>(p, wide ? 20 : 18);
  if (format != 0 && format != 2) fields["gps_time"] = get<double>(p, wide ? 22 : 20);
  const std::size_t colour = format == 2                                  ? 20
                             : format == 3 || format == 5                 ? 28
                             : format == 7 || format == 8 || format == 10 ? 30
                                                                          : 0;
  if (colour != 0) {
    fields["red"] = get<std::uint16_t>(p, colour);
    fields["green"] = get<std::uint16_t>(p, colour + 2);
    fields["blue"] = get<std::uint16_t>(p, colour + 4);
  }
  if (format == 8 || format == 10) fields["nir"] = get<std::uint16_t>(p, 36);
  return fields;
}

/// Records whose every double is a number, so that comparing them means something.
std::vector<std::string> make_finite_records(std::size_t count, std::size_t bytes, int format, unsigned seed) {
  std::vector<std::string> records = make_records(count, bytes, seed);
  for (std::size_t i = 0; i < records.size(); ++i) {
    if (format != 0 && format != 2) put<double>(records[i], format >= 6 ? 22 : 20, 1e8 + static_cast<double>(i) / 8);
  }
  return records;
}

LasPlan finite_plan(int format, std::size_t points, std::size_t extra = 0, unsigned seed = 1) {
  LasPlan plan;
  plan.minor = 4;
  plan.format = format;
  plan.record_bytes = kFormatBytes[static_cast<std::size_t>(format)] + extra;
  plan.points = make_finite_records(points, plan.record_bytes, format, seed);
  return plan;
}

class Conversion : public ::testing::Test {
 protected:
  std::filesystem::path write(const char* name, const std::string& bytes) {
    write_new(folder_ / name, bytes);
    return folder_ / name;
  }
  /// Converts everything and keeps the warnings.
  std::filesystem::path convert(const char* name, const std::vector<std::filesystem::path>& inputs) {
    std::filesystem::remove(folder_ / name);
    warnings_ = write_kept(folder_ / name, inputs, kIdColumn, all, id_row);
    return folder_ / name;
  }
  TempFolder folder_;
  std::vector<std::string> warnings_;
};

TEST_F(Conversion, LasToPly_CarriesEveryFieldOfEveryFormat) {
  for (int format = 0; format <= 10; ++format) {
    SCOPED_TRACE(format);
    LasPlan plan = finite_plan(format, 9, 2 + 12 + 8 + 3, static_cast<unsigned>(format));
    const std::size_t extra = plan.record_bytes - 25;
    for (std::size_t i = 0; i < 9; ++i) {
      put<std::uint16_t>(plan.points[i], extra, static_cast<std::uint16_t>(7000 + i));
      for (std::size_t part = 0; part < 3; ++part)
        put<float>(plan.points[i], extra + 2 + 4 * part, static_cast<float>(part) + 0.5F);
      put<std::uint64_t>(plan.points[i], extra + 14, 123456789 + i);
    }
    plan.vlrs = {{"LASF_Projection", 2112, "PROJCS[\"a\",UNIT[\"metre\",1]]"},
                 {"LASF_Spec", 4, extra_entry(3, "Amplitude") + extra_entry(29, "Normal") + extra_entry(7, "Big one")}};
    const auto in = write("in.las", build_las(plan));
    const PlyView view = view_ply(file_bytes(convert("out.ply", {in})));
    EXPECT_TRUE(has_line(view.header, "comment crs PROJCS[\"a\""));
    EXPECT_TRUE(has_line(warnings_, "3 undocumented extra bytes"));
    EXPECT_EQ(has_line(warnings_, "waveforms"), format == 4 || format == 5 || format >= 9);
    ASSERT_EQ(view.vertices.size(), 9U);
    EXPECT_EQ(view.types.at("Amplitude"), "ushort");
    EXPECT_EQ(view.types.at("Normal_1"), "float");
    EXPECT_EQ(view.names.back(), "Id");
    for (std::size_t i = 0; i < 9; ++i) {
      std::map<std::string, double> expected = fields_of(plan.points[i], format);
      const std::array<const char*, 3> axes{"x", "y", "z"};
      for (std::size_t axis = 0; axis < 3; ++axis)
        expected[axes[axis]] = get<std::int32_t>(plan.points[i], 4 * axis) * plan.scale[axis] + plan.offset[axis];
      expected["Amplitude"] = 7000.0 + static_cast<double>(i);
      expected["Normal_0"] = 0.5;
      expected["Normal_1"] = 1.5;
      expected["Normal_2"] = 2.5;
      expected["Big_one"] = 123456789.0 + static_cast<double>(i);
      expected["Id"] = 1000.0 + static_cast<double>(i);
      EXPECT_EQ(view.vertices[i], expected);
    }
  }
}

TEST_F(Conversion, ScaledExtraBytes_BecomeWhatTheyMean) {
  LasPlan plan = finite_plan(0, 2, 2);
  put<std::int16_t>(plan.points[0], 20, -150);
  put<std::int16_t>(plan.points[1], 20, 300);
  std::string entry = extra_entry(4, "Height", 8 | 16);
  put<double>(entry, 112, 0.01);
  put<double>(entry, 136, 5.0);
  plan.vlrs = {{"LASF_Spec", 4, entry}};
  const PlyView view = view_ply(file_bytes(convert("out.ply", {write("in.las", build_las(plan))})));
  EXPECT_EQ(view.types.at("Height"), "double");
  EXPECT_EQ(view.vertices[0].at("Height"), -150 * 0.01 + 5.0);
  EXPECT_EQ(view.vertices[1].at("Height"), 300 * 0.01 + 5.0);
}

TEST_F(Conversion, LasToPlyToLas_GivesTheSameFieldsBack) {
  for (const int format : {0, 1, 2, 3, 6, 7, 8}) {
    SCOPED_TRACE(format);
    LasPlan plan = finite_plan(format, 20, 4, static_cast<unsigned>(40 + format));
    plan.scale = {0.001, 0.001, 0.001};
    plan.offset = {0.0, 0.0, 0.0};
    for (std::size_t i = 0; i < 20; ++i) {
      for (std::size_t axis = 0; axis < 3; ++axis)
        put<std::int32_t>(plan.points[i], 4 * axis, static_cast<std::int32_t>(10000 * axis + 37 * i));
      put<std::uint32_t>(plan.points[i], plan.record_bytes - 4, 4000000000U + static_cast<std::uint32_t>(i));
    }
    const std::string wkt = "PROJCS[\"a\",UNIT[\"metre\",1]]";
    plan.vlrs = {{"LASF_Spec", 4, extra_entry(5, "SegmentId")}, {"LASF_Projection", 2112, wkt}};
    const auto ply = convert("mid.ply", {write("in.las", build_las(plan))});
    const LasParts parts = read_parts(file_bytes(convert("out.las", {ply})));
    ASSERT_EQ(parts.records.size(), 20U);
    const bool colour = format == 2 || format == 3 || format == 7 || format == 8;
    EXPECT_EQ(parts.format, format == 8 ? 8 : colour ? 7 : 6);
    EXPECT_EQ(parts.vlrs.at(0).payload, wkt + std::string(1, '\0'));
    const std::size_t extra = kFormatBytes[static_cast<std::size_t>(parts.format)];
    for (std::size_t i = 0; i < 20; ++i) {
      std::map<std::string, double> expected = fields_of(plan.points[i], format);
      std::map<std::string, double> got = fields_of(parts.records[i], parts.format);
      if (format < 6) got.erase("scanner_channel");
      EXPECT_NEAR(got["scan_angle"], expected["scan_angle"], format < 6 ? 0.00301 : 0.0) << "steps of 0.006 degrees";
      got.erase("scan_angle");
      expected.erase("scan_angle");
      if (format == 0 || format == 2) got.erase("gps_time");
      EXPECT_EQ(got, expected);
      EXPECT_EQ(get<std::uint32_t>(parts.records[i], extra), 4000000000U + i);
    }
  }
}

TEST_F(Conversion, PlyToLas_CarriesWhatItRecognisesAndTheRestByName) {
  for (const std::string format : {"ascii", "binary_little_endian", "binary_big_endian"}) {
    for (const bool colour : {false, true}) {
      std::vector<PlyColumn> columns{{"scalar_Classification", "uchar"},
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
                                 {0.5 + i},   {1e9 + i / 8.0}};
        if (colour) row.insert(row.end(), {{255.0}, {static_cast<double>(i)}, {0.0}});
        vertices.rows.push_back(row);
      }
      const auto in = write("in.ply", build_ply({format, "\n", {"comment mine"}, {vertices}}));
      const auto out = convert("out.las", {in});
      EXPECT_TRUE(has_line(warnings_, "vertex lists list"));
      EXPECT_TRUE(has_line(warnings_, "1 comments"));
      const LasParts parts = read_parts(file_bytes(out));
      EXPECT_EQ(parts.minor, 4);
      EXPECT_EQ(parts.format, colour ? 7 : 6);
      EXPECT_EQ(parts.legacy_points, 0U);
      ASSERT_EQ(parts.records.size(), 5U);
      EXPECT_EQ(parts.by_return[0], 5U);
      ASSERT_EQ(parts.vlrs.size(), 1U);
      EXPECT_EQ(parts.vlrs[0].payload.substr(0, 40), extra_entry(9, "curvature").substr(0, 40));
      EXPECT_EQ(parts.vlrs[0].payload.substr(192 + 4, 3), std::string("Id\0", 3));
      const auto source = io::open_point_source(out);
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
        EXPECT_EQ(get<float>(r, colour ? 36 : 30), 0.5F + static_cast<float>(i));
        EXPECT_EQ(r.substr(colour ? 40 : 34), id_row(i));
      }
    }
  }
}

TEST_F(Conversion, PlyToLas_LeavesOutPointsWithoutPlace) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  PlyTable vertices{
      "vertex", {{"x"}, {"y"}, {"z"}}, {{{1.0}, {2.0}, {3.0}}, {{nan}, {0.0}, {0.0}}, {{4.0}, {5.0}, {6.0}}}};
  const auto in = write("in.ply", build_ply({"binary_little_endian", "\n", {}, {vertices}}));
  const LasParts parts = read_parts(file_bytes(convert("out.las", {in})));
  EXPECT_HAS(warnings_.back(), "1 points without finite coordinates");
  ASSERT_EQ(parts.records.size(), 2U);
  EXPECT_EQ(parts.records[1].substr(30), id_row(2));
}

TEST_F(Conversion, ValuesBeyondAField_AreCutAndCounted) {
  PlyTable vertices{"vertex", {{"x"}, {"y"}, {"z"}, {"intensity", "float"}, {"return_number", "int"}}, {}};
  for (const double v : {70000.0, -1.0, 12.4, 5.0}) vertices.rows.push_back({{1.0}, {1.0}, {1.0}, {v}, {v}});
  const auto in = write("in.ply", build_ply({"binary_little_endian", "\n", {}, {vertices}}));
  const LasParts parts = read_parts(file_bytes(convert("out.las", {in})));
  EXPECT_TRUE(has_line(warnings_, "2 values of intensity")) << "12.4 is rounded to the field's step";
  EXPECT_TRUE(has_line(warnings_, "2 values of return_number"));
  EXPECT_EQ(get<std::uint16_t>(parts.records[0], 12), 65535);
  EXPECT_EQ(get<std::uint16_t>(parts.records[1], 12), 0);
  EXPECT_EQ(parts.records[0][14] & 15, 15);
  EXPECT_EQ(parts.records[2][14] & 15, 12);
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
          EXPECT_NEAR(*stored * grid.scale[axis] + grid.offset[axis], world,
                      0.5001 * grid.scale[axis] + std::abs(world) * 1e-15);
        }
      }
      if (half >= 5.0 && half <= 1e5) {
        EXPECT_EQ(grid.scale[0], 0.0001);
      }
      if (half < 5.0 && half >= 1e-3) {
        EXPECT_GE(2 * half / grid.scale[0], 0.99e5);
      }
    }
  }
  EXPECT_EQ(io::choose_las_grid({}).scale[0], 0.0001);
  io::WorldExtent huge;
  huge.min = {-1e300, 0, 0};
  huge.max = {1e300, 0, 0};
  EXPECT_HAS(message_of<ConfigError>([&] { io::choose_las_grid(huge); }), "do not fit");
}

}  // namespace
}  // namespace arris::test
