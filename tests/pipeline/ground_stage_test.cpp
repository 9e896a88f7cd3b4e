#include "pipeline/ground_stage.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/error.h"
#include "silent_sink.h"
#include "support/las_tools.h"
#include "support/temp_folder.h"

namespace arris::pipeline {
namespace {

using Paths = std::vector<std::filesystem::path>;

/// A point in centimetres and its class.
struct Classified {
  std::array<std::int32_t, 3> at;
  char label;
};

/// A slope of ground, and over its middle a roof 3 m above it with a chimney foot 1 m above it.
std::vector<Classified> house_on_slope() {
  std::vector<Classified> points;
  for (int x = 0; x < 4000; x += 50) {
    for (int y = 0; y < 4000; y += 50) {
      const bool roof = x > 1000 && x < 3000 && y > 1000 && y < 3000;
      points.push_back({{x, y, 5000 + x / 5 + (roof ? 300 : 0)}, roof ? '\x06' : '\x02'});
    }
  }
  points.push_back({{2000, 2000, 5000 + 400 + 100}, '\x06'});
  return points;
}

class GroundStage : public ::testing::Test {
 protected:
  std::filesystem::path las(const char* name, const std::vector<Classified>& points,
                            std::array<double, 3> offset = {}) {
    std::vector<std::array<std::int32_t, 3>> positions;
    for (const Classified& point : points) positions.push_back(point.at);
    test::write_las(folder_ / name, positions, 0.01, offset);
    std::string bytes = test::file_bytes(folder_ / name);
    const test::LasView view = test::view_las(folder_ / name);
    for (std::size_t i = 0; i < points.size(); ++i)
      bytes[view.offset_to_points + i * view.record_bytes + 15] = points[i].label;
    test::write_bytes(folder_ / name, bytes);
    return folder_ / name;
  }
  /// Ascii, in metres.
  std::filesystem::path ply(const char* name, const std::vector<Classified>& points, bool classes) {
    std::string text = "ply\nformat ascii 1.0\nelement vertex " + std::to_string(points.size()) +
                       "\nproperty double x\nproperty double y\nproperty double z\n" +
                       (classes ? "property uchar classification\n" : "") + "end_header\n";
    for (const Classified& point : points) {
      for (const std::int32_t c : point.at) text += std::to_string(0.01 * c) + " ";
      text += (classes ? std::to_string(point.label) : "") + "\n";
    }
    test::write_bytes(folder_ / name, text);
    return folder_ / name;
  }
  GroundModel ground(io::InputSet& inputs) {
    test::SilentSink sink;
    return read_ground(inputs, sink, CancelToken());
  }
  /// By global id, 1 for points that are excluded.
  static std::vector<int> excluded(io::InputSet& inputs) {
    std::vector<int> all;
    io::PointBatch batch;
    inputs.rewind();
    while (inputs.read(batch, {})) {
      for (std::size_t i = 0; i < batch.count; ++i) all.push_back(!batch.excluded.empty() && batch.excluded[i] != 0);
    }
    return all;
  }
  void keep_above(io::InputSet& inputs, double height) {
    inputs.add_filter(above_ground(std::make_shared<const GroundModel>(ground(inputs)), height, inputs.sources()));
  }
  test::TempFolder folder_;
};

TEST_F(GroundStage, PointsNearTheGround_AreExcluded) {
  const std::vector<Classified> points = house_on_slope();
  std::vector<int> expected;
  for (const Classified& point : points) expected.push_back(point.label == 2);
  expected.back() = 1;  // The foot of the chimney.
  for (const std::array<double, 3>& offset : {std::array<double, 3>{0, 0, 0}, {431000.5, 5412000.25, 300.0}}) {
    io::InputSet inputs({las("a.las", points, offset)});
    keep_above(inputs, 1.5);
    for (int pass = 0; pass < 2; ++pass) EXPECT_EQ(excluded(inputs), expected);
  }
  io::InputSet inputs({ply("a.ply", points, true)});
  keep_above(inputs, 1.5);
  EXPECT_EQ(excluded(inputs), expected);
}

TEST_F(GroundStage, ExclusionsOfTheInputs_LeaveTheGroundWhereItIs) {
  const std::vector<Classified> points = house_on_slope();
  io::InputSet inputs({las("a.las", points)});
  io::PointExclusion buildings;
  buildings.only_classes.set(6);
  inputs.exclude(buildings);
  inputs.add_filter([](std::size_t, io::PointBatch& batch) { batch.excluded[0] = 1; });
  const GroundModel model = ground(inputs);
  EXPECT_NEAR(model.height_at(20.0, 20.0), 54.0, 0.02);
  EXPECT_NEAR(model.height_at(5.0, 5.0), 51.0, 0.02);
}

TEST_F(GroundStage, FilesInAnyOrder_ExcludeTheSamePoints) {
  const std::vector<Classified> points = house_on_slope();
  const std::filesystem::path whole = las("whole.las", points);
  Paths parts = test::split_las(whole, 4, folder_.path());
  io::InputSet inputs({whole});
  const GroundModel model = ground(inputs);
  std::ranges::rotate(parts, parts.begin() + 3);
  io::InputSet rotated(parts);
  const GroundModel other = ground(rotated);
  for (double x = -20.0; x < 60.0; x += 0.9) {
    for (double y = -20.0; y < 60.0; y += 0.9) ASSERT_EQ(model.height_at(x, y), other.height_at(x, y));
  }
}

TEST_F(GroundStage, UnclassifiedPly_IsJudgedByTheGroundOfTheOtherInputs) {
  io::InputSet inputs(
      {las("a.las", house_on_slope()), ply("b.ply", {{{2000, 1500, 5450}, 0}, {{2000, 1500, 5600}, 0}}, false)});
  keep_above(inputs, 1.5);
  const std::vector<int> found = excluded(inputs);
  EXPECT_EQ(found[found.size() - 2], 1);
  EXPECT_EQ(found.back(), 0);
}

TEST_F(GroundStage, PointsThatAreNotFinite_AreLeftAlone) {
  test::write_bytes(folder_ / "a.ply",
                    "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
                    "property uchar classification\nend_header\n0 0 0 2\nnan 0 0 2\n0 0 -inf 6\n0 0 1 6\n");
  io::InputSet inputs({folder_ / "a.ply"});
  keep_above(inputs, 1.5);
  EXPECT_EQ(excluded(inputs), (std::vector<int>{1, 0, 0, 1}));
}

TEST_F(GroundStage, NoGround_IsRefusedWithTheRemedy) {
  for (const std::filesystem::path& path :
       {las("a.las", {{{0, 0, 0}, 6}, {{1, 2, 3}, 1}}), ply("b.ply", {{{0, 0, 0}, 0}}, false), las("c.las", {})}) {
    io::InputSet inputs({path});
    try {
      ground(inputs);
      ADD_FAILURE() << path;
    } catch (const InputError& error) {
      EXPECT_STREQ(error.what(),
                   "no point is classified as ground (class 2); classify the scan or leave out --min-height");
    }
  }
}

}  // namespace
}  // namespace arris::pipeline
