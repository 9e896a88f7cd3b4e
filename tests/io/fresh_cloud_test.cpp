#include "io/attribute_reader.h"
#include "io_helpers.h"
#include "las_builder.h"

namespace arris::test {
namespace {

std::vector<io::FreshPoint> make_points(std::size_t count) {
  std::vector<io::FreshPoint> points(count);
  for (std::size_t i = 0; i < count; ++i) {
    const double n = static_cast<double>(i);
    points[i].x = 100.0 + n * 0.0013;
    points[i].y = -n * 0.0117;
    points[i].z = n * 0.0004;
    points[i].intensity = static_cast<std::uint16_t>(i * 3);
    points[i].classification = static_cast<std::uint8_t>(i);
    points[i].point_source_id = static_cast<std::uint16_t>(i / 7);
    points[i].red = static_cast<std::uint16_t>(i);
    points[i].green = static_cast<std::uint16_t>(i + 1);
    points[i].blue = static_cast<std::uint16_t>(i + 2);
  }
  return points;
}

TEST(FreshCloud, LasAndPly_HoldTheSameRoundedPoints) {
  const TempFolder folder;
  const std::size_t count = 10000;
  const std::vector<io::FreshPoint> points = make_points(count);
  for (const bool colour : {false, true}) {
    io::FreshCloud cloud;
    cloud.scale = 0.001;
    cloud.offset = {100.0, 0.0, -5.0};
    cloud.colour = colour;
    for (const char* name : {"a.las", "a.ply"}) {
      const auto writer = io::create_fresh_cloud_writer(folder / name, cloud, {true});
      writer->append(std::span(points).first(1));
      writer->append({});
      writer->append(std::span(points).subspan(1));
      writer->commit();
    }
    const LasParts parts = read_parts(file_bytes(folder / "a.las"));
    EXPECT_EQ(parts.minor, 4);
    EXPECT_EQ(parts.format, colour ? 7 : 6);
    EXPECT_EQ(parts.points, count);
    EXPECT_EQ(parts.by_return[0], count);
    const AllPoints ply = read_all(folder / "a.ply");
    ASSERT_EQ(ply.world.size(), count);
    for (std::size_t i = 0; i < count; ++i) {
      const std::string& record = parts.records[i];
      const std::array<double, 3> wanted{points[i].x, points[i].y, points[i].z};
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const double world = get<std::int32_t>(record, 4 * axis) * cloud.scale + cloud.offset[axis];
        ASSERT_NEAR(world, wanted[axis], 0.000501);
        ASSERT_EQ(ply.world[i][axis], world);
        ASSERT_LE(parts.min[axis], world);
        ASSERT_GE(parts.max[axis], world);
      }
      ASSERT_EQ(get<std::uint16_t>(record, 12), points[i].intensity);
      ASSERT_EQ(get<std::uint8_t>(record, 16), points[i].classification);
      ASSERT_EQ(get<std::uint16_t>(record, 20), points[i].point_source_id);
      ASSERT_EQ(get<std::uint16_t>(ply.records[i], 24), points[i].intensity);
      ASSERT_EQ(get<std::uint8_t>(ply.records[i], 26), points[i].classification);
      ASSERT_EQ(get<std::uint16_t>(ply.records[i], 27), points[i].point_source_id);
      if (!colour) continue;
      ASSERT_EQ(get<std::uint16_t>(record, 30), points[i].red);
      ASSERT_EQ(get<std::uint16_t>(record, 34), points[i].blue);
      ASSERT_EQ(ply.records[i].substr(29, 6), record.substr(30, 6));
    }
  }
}

TEST(FreshCloud, LabelColumn_IsReadBackAndChangesNothingElse) {
  const TempFolder folder;
  std::vector<io::FreshPoint> points = make_points(5000);
  for (std::size_t i = 0; i < points.size(); ++i) points[i].label = static_cast<std::uint32_t>(4'000'000'000U - i);
  for (const bool colour : {false, true}) {
    for (const std::string extension : {".las", ".ply"}) {
      io::FreshCloud cloud;
      cloud.colour = colour;
      const auto write = [&](const std::string& name) {
        const auto writer = io::create_fresh_cloud_writer(folder.path() / name, cloud, {true});
        writer->append(points);
        writer->commit();
      };
      write("plain" + extension);
      cloud.label = ColumnSpec{"FaceId", ColumnType::kUint32, "number of the surface"};
      write("labelled" + extension);
      const AllPoints plain = read_all(folder.path() / ("plain" + extension));
      const AllPoints labelled = read_all(folder.path() / ("labelled" + extension));
      EXPECT_EQ(labelled.world, plain.world);
      for (std::size_t i = 0; i < points.size(); ++i) {
        const std::size_t size = plain.records[i].size();
        ASSERT_EQ(labelled.records[i].substr(0, size), plain.records[i]);
        ASSERT_EQ(labelled.records[i].size(), size + 4);
        ASSERT_EQ(get<std::uint32_t>(labelled.records[i], size), points[i].label);
      }
      const auto source = io::open_point_source(folder.path() / ("labelled" + extension));
      EXPECT_TRUE(source->info().problems.empty());
      io::AttributeReader attributes(folder.path() / ("labelled" + extension), {"FaceId"});
      ASSERT_TRUE(attributes.has(0));
      io::PointBatch batch;
      std::vector<double> values;
      ASSERT_TRUE(source->read(batch, {.records = true}));
      attributes.read(batch, 0, values);
      EXPECT_EQ(values.at(7), 4e9 - 7);
    }
  }
}

TEST(FreshCloud, NoPoints_GiveValidFiles) {
  const TempFolder folder;
  for (const char* name : {"a.las", "a.ply"}) {
    io::create_fresh_cloud_writer(folder / name, {}, {})->commit();
    EXPECT_EQ(io::open_point_source(folder / name)->info().points, 0U);
    EXPECT_TRUE(io::open_point_source(folder / name)->info().problems.empty());
  }
}

TEST(FreshCloud, PointOutsideTheScale_IsRefused) {
  const TempFolder folder;
  for (const char* name : {"a.las", "a.ply"}) {
    const auto writer = io::create_fresh_cloud_writer(folder / name, {}, {});
    std::vector<io::FreshPoint> points(1);
    points[0].y = 3e6;
    EXPECT_HAS(message_of<ConfigError>([&] { writer->append(points); }), "y = 3000000");
  }
  io::FreshCloud cloud;
  cloud.label = ColumnSpec{"FaceId", ColumnType::kUint8, ""};
  EXPECT_HAS(message_of<ConfigError>([&] { io::create_fresh_cloud_writer(folder / "b.las", cloud, {}); }), "32-bit");
  cloud.scale = 0.0;
  message_of<ConfigError>([&] { io::create_fresh_cloud_writer(folder / "b.las", cloud, {}); });
}

}  // namespace
}  // namespace arris::test
