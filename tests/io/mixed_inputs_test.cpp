#include <cmath>

#include "io_helpers.h"
#include "las_builder.h"
#include "ply_builder.h"
#include "ply_view.h"

namespace arris::test {
namespace {

/// Inputs that differ in something: one output in the layout that holds them all.
class MixedInputs : public ::testing::Test {
 protected:
  std::filesystem::path add(const char* name, const std::string& bytes) {
    write_new(folder_ / name, bytes);
    inputs_.push_back(folder_ / name);
    return inputs_.back();
  }
  LasPlan plan(int format, std::size_t extra = 0) {
    LasPlan plan;
    plan.minor = 4;
    plan.format = format;
    plan.record_bytes = kFormatBytes[static_cast<std::size_t>(format)] + extra;
    plan.points = make_records(4, plan.record_bytes, static_cast<unsigned>(inputs_.size() + 1));
    for (std::string& point : plan.points) {
      for (std::size_t axis = 0; axis < 3; ++axis)
        put<std::int32_t>(point, 4 * axis, get<std::int32_t>(point, 4 * axis) % 100000);
    }
    return plan;
  }
  std::string merged(const char* name, bool mixed_crs = false) {
    io::InputSet set(inputs_);
    io::OutputOptions options;
    options.mixed_crs = mixed_crs;
    std::filesystem::remove(folder_ / name);
    const auto writer = io::create_kept_point_writer(folder_ / name, set, kIdColumn, options);
    io::PointBatch batch;
    io::ReadOptions reading;
    reading.records = true;
    while (set.read(batch, reading)) {
      std::vector<std::uint32_t> kept;
      std::string rows;
      for (std::size_t i = 0; i < batch.count; ++i) {
        kept.push_back(static_cast<std::uint32_t>(i));
        rows += id_row(batch.first_id + i);
      }
      writer->append(set.source_index(), batch, kept, std::as_bytes(std::span(rows)));
    }
    writer->commit();
    warnings_ = writer->warnings();
    return file_bytes(folder_ / name);
  }
  bool warned(const std::string& part) const {
    return std::any_of(warnings_.begin(), warnings_.end(),
                       [&](const std::string& line) { return line.find(part) != std::string::npos; });
  }
  static double world(const std::string& bytes, const std::string& record, std::size_t axis) {
    return get<std::int32_t>(record, 4 * axis) * get<double>(bytes, 131 + 8 * axis) +
           get<double>(bytes, 155 + 8 * axis);
  }
  TempFolder folder_;
  std::vector<std::filesystem::path> inputs_;
  std::vector<std::string> warnings_;
};

TEST_F(MixedInputs, PointFormats_GiveTheOneThatHoldsAll) {
  const LasPlan a = plan(1);
  add("a.las", build_las(a));
  const LasPlan b = plan(2);
  add("b.las", build_las(b));
  const LasParts legacy = read_parts(merged("legacy.las"));
  EXPECT_EQ(legacy.format, 3);
  ASSERT_EQ(legacy.records.size(), 8U);
  EXPECT_EQ(legacy.records[2].substr(0, 28), a.points[2].substr(0, 28));
  EXPECT_EQ(legacy.records[2].substr(28, 6), std::string(6, '\0'));
  EXPECT_EQ(legacy.records[6].substr(0, 20), b.points[2].substr(0, 20));
  EXPECT_EQ(legacy.records[6].substr(28, 6), b.points[2].substr(20, 6));
  EXPECT_EQ(legacy.records[6].substr(34), id_row(6));
  const LasPlan c = plan(8);
  add("c.las", build_las(c));
  const LasParts wide = read_parts(merged("wide.las"));
  EXPECT_EQ(wide.format, 8);
  EXPECT_EQ(wide.records[10].substr(0, 38), c.points[2].substr(0, 38));
  EXPECT_EQ(wide.records[0][16], a.points[0][15] & 31) << "classification";
  EXPECT_EQ(wide.records[0][15] & 15, static_cast<unsigned char>(a.points[0][15]) >> 5) << "its flags";
}

TEST_F(MixedInputs, ScalesAndOffsets_GiveTheFinerScaleAndKeepPlaces) {
  LasPlan a = plan(6);
  a.scale = {0.01, 0.01, 0.01};
  LasPlan b = plan(6);
  b.scale = {0.001, 0.001, 0.001};
  b.offset = {500100.0, 5000000.0, 0.0};
  add("a.las", build_las(a));
  add("b.las", build_las(b));
  const std::string bytes = merged("out.las");
  const LasParts parts = read_parts(bytes);
  EXPECT_EQ(get<double>(bytes, 131), 0.001);
  EXPECT_EQ(get<double>(bytes, 155), a.offset[0]);
  for (std::size_t i = 0; i < 8; ++i) {
    const LasPlan& from = i < 4 ? a : b;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double expected = get<std::int32_t>(from.points[i % 4], 4 * axis) * from.scale[axis] + from.offset[axis];
      EXPECT_NEAR(world(bytes, parts.records[i], axis), expected, 1e-9 * std::abs(expected) + 1e-9);
    }
    EXPECT_EQ(parts.records[i].substr(12, 18), from.points[i % 4].substr(12, 18));
  }
}

TEST_F(MixedInputs, ExtentBeyondThirtyTwoBits_MovesTheOffsetOrCoarsens) {
  LasPlan a = plan(0);
  a.scale = {1e-6, 1e-6, 1e-6};
  a.offset = {0.0, 0.0, 0.0};
  LasPlan b = plan(0);
  b.scale = {1.0, 1.0, 1.0};
  b.offset = {4e6, 0.0, 0.0};
  add("a.las", build_las(a));
  add("b.las", build_las(b));
  const std::string bytes = merged("out.las");
  EXPECT_TRUE(warned("rounded to multiples"));
  const LasParts parts = read_parts(bytes);
  ASSERT_EQ(parts.records.size(), 8U);
  const double scale = get<double>(bytes, 131);
  for (std::size_t i = 4; i < 8; ++i)
    EXPECT_NEAR(world(bytes, parts.records[i], 0), get<std::int32_t>(b.points[i - 4], 0) + 4e6, scale);
}

TEST_F(MixedInputs, ExtraBytes_AreJoinedByName) {
  LasPlan a = plan(6, 3);
  a.vlrs = {{"LASF_Spec", 4, extra_entry(3, "Amplitude") + extra_entry(1, "Mine")}};
  LasPlan b = plan(6, 4);
  b.vlrs = {{"LASF_Spec", 4, extra_entry(5, "Amplitude")}};
  for (std::size_t i = 0; i < 4; ++i) put<std::uint32_t>(b.points[i], 30, 3000000000U);
  add("a.las", build_las(a));
  add("b.las", build_las(b));
  const LasParts parts = read_parts(merged("out.las"));
  EXPECT_EQ(parts.vlrs.at(0).payload.substr(0, 40), extra_entry(5, "Amplitude").substr(0, 40));
  EXPECT_EQ(parts.vlrs.at(0).payload.substr(192, 40), extra_entry(1, "Mine").substr(0, 40));
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(get<std::uint32_t>(parts.records[i], 30), get<std::uint16_t>(a.points[i], 30));
    EXPECT_EQ(parts.records[i][34], a.points[i][32]);
    EXPECT_EQ(get<std::uint32_t>(parts.records[4 + i], 30), 3000000000U);
    EXPECT_EQ(parts.records[4 + i][34], 0);
  }
}

TEST_F(MixedInputs, SameExtraBytesInDifferentFormats_AreCopiedBitForBit) {
  LasPlan a = plan(0, 12);
  LasPlan b = plan(6, 12);
  a.vlrs = b.vlrs = {{"LASF_Spec", 4, extra_entry(10, "Range")}};  // Eight bytes; four are undocumented.
  for (LasPlan* plan : {&a, &b}) {
    for (std::string& point : plan->points) put<std::uint64_t>(point, point.size() - 12, 0x7FF0000000000001U);
  }
  add("a.las", build_las(a));
  add("b.las", build_las(b));
  const LasParts parts = read_parts(merged("out.las"));
  for (std::size_t i = 0; i < 8; ++i) {
    const std::string& original = (i < 4 ? a : b).points[i % 4];
    EXPECT_EQ(parts.records[i].substr(30, 12), original.substr(original.size() - 12)) << "a signalling NaN and all";
  }
}

TEST_F(MixedInputs, CoordinateSystems_MustAgreeUnlessForced) {
  LasPlan a = plan(6);
  a.vlrs = {{"LASF_Projection", 2112, "PROJCS[\"one\"]"}};
  LasPlan b = a;
  b.vlrs[0].payload = std::string("PROJCS[\"one\"]\0", 15);
  add("a.las", build_las(a));
  add("b.las", build_las(b));
  merged("same.las");
  EXPECT_TRUE(warnings_.empty()) << "a NUL at the end makes no difference";
  b.vlrs[0].payload = "PROJCS[\"two\"]";
  add("c.las", build_las(b));
  for (const char* name : {"out.las", "out.ply"}) {
    EXPECT_HAS(message_of<ConfigError>([&] { merged(name); }), "--mixed-crs");
    EXPECT_FALSE(std::filesystem::exists(folder_ / name));
  }
  const LasParts parts = read_parts(merged("forced.las", true));
  EXPECT_EQ(parts.vlrs.at(0).payload, a.vlrs[0].payload);
  EXPECT_TRUE(warned("name their coordinate reference systems differently"));
}

TEST_F(MixedInputs, LasAndPly_ShareOneOutput) {
  const LasPlan a = plan(7);
  add("a.las", build_las(a));
  PlyTable vertices{"vertex",
                    {{"x", "double"},
                     {"y", "double"},
                     {"z", "double"},
                     {"intensity", "ushort"},
                     {"red", "uchar"},
                     {"green", "uchar"},
                     {"blue", "uchar"},
                     {"planarity", "float"}},
                    {{{500000.0628}, {5000000.0}, {1.0}, {77.0}, {255.0}, {0.0}, {1.0}, {0.25}}}};
  add("b.ply", build_ply({"binary_big_endian", "\n", {}, {vertices}}));
  const std::string bytes = merged("out.las");
  const LasParts parts = read_parts(bytes);
  EXPECT_EQ(parts.format, 7);
  ASSERT_EQ(parts.records.size(), 5U);
  EXPECT_EQ(parts.records[1].substr(12, 24), a.points[1].substr(12));
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double expected = get<std::int32_t>(a.points[1], 4 * axis) * a.scale[axis] + a.offset[axis];
    EXPECT_NEAR(world(bytes, parts.records[1], axis), expected, 1e-9 * std::abs(expected));
  }
  EXPECT_NEAR(world(bytes, parts.records[4], 0), 500000.0628, 0.00005) << "steps of the LAS input are too coarse";
  EXPECT_EQ(get<std::uint16_t>(parts.records[4], 12), 77);
  EXPECT_EQ(get<std::uint16_t>(parts.records[4], 30), 65535);
  EXPECT_EQ(get<float>(parts.records[4], 36), 0.25F);
  EXPECT_TRUE(std::isnan(get<float>(parts.records[0], 36)));
  const PlyView view = view_ply(merged("out.ply"));
  ASSERT_EQ(view.vertices.size(), 5U);
  EXPECT_EQ(view.vertices[4].at("red"), 65535.0);
  EXPECT_EQ(view.vertices[4].at("planarity"), 0.25);
  EXPECT_EQ(view.vertices[2].at("red"), get<std::uint16_t>(a.points[2], 30));
}

TEST_F(MixedInputs, PlyLayouts_AreJoinedByName) {
  const PlyTable one = make_vertices({{"x"}, {"y"}, {"z"}, {"a", "uchar"}}, 3);
  const PlyTable two = make_vertices({{"z", "double"}, {"b", "short"}, {"x"}, {"y"}, {"a", "int"}}, 3);
  add("one.ply", build_ply({"ascii", "\n", {"comment c"}, {one}}));
  add("two.ply", build_ply({"binary_big_endian", "\n", {}, {two}}));
  const PlyView view = view_ply(merged("out.ply"));
  EXPECT_EQ(view.names, (std::vector<std::string>{"x", "y", "z", "a", "b", "Id"}));
  EXPECT_EQ(view.types.at("z"), "double");
  EXPECT_EQ(view.types.at("a"), "int");
  ASSERT_EQ(view.vertices.size(), 6U);
  for (std::size_t i = 0; i < 6; ++i) {
    const double n = static_cast<double>(i % 3);
    EXPECT_EQ(view.vertices[i].at("x"), 1.5 * n);
    EXPECT_EQ(view.vertices[i].at("z"), n / 4);
    EXPECT_EQ(view.vertices[i].at("a"), static_cast<double>(7 * (i % 3)));
    EXPECT_EQ(view.vertices[i].at("b"), i < 3 ? 0.0 : static_cast<double>(7 * (i % 3)));
  }
}

}  // namespace
}  // namespace arris::test
