#include "pipeline/colour_source.h"

#include <gtest/gtest.h>

#include <limits>

#include "silent_sink.h"
#include "support/coloured_scan.h"
#include "support/las_tools.h"
#include "support/temp_folder.h"

namespace arris::pipeline {
namespace {

using test::ColouredPoint;
using Paths = std::vector<std::filesystem::path>;

/// Points somewhere with these colours.
std::vector<ColouredPoint> points_with(const std::vector<std::array<double, 3>>& colours) {
  std::vector<ColouredPoint> points;
  for (const auto& colour : colours) points.push_back({{static_cast<std::int32_t>(points.size()), 0, 0}, colour});
  return points;
}

/// Colours of all points in order; nothing if the inputs count as having none.
std::vector<RawColour> colours_of(const Paths& paths) {
  io::InputSet inputs(paths);
  const CancelToken cancel;
  test::SilentSink sink;
  const auto source = ColourSource::open(inputs, sink, cancel);
  if (!source) return {};
  std::vector<RawColour> all;
  std::vector<RawColour> batch_colours;
  io::PointBatch batch;
  io::ReadOptions options;
  options.records = true;
  options.batch_points = 2;
  inputs.rewind();
  while (inputs.read(batch, options)) {
    source->read(batch, inputs.source_index(), batch_colours);
    all.insert(all.end(), batch_colours.begin(), batch_colours.end());
  }
  return all;
}

TEST(ColourSource, LasWithBytesInItsWords_IsWidened) {
  const test::TempFolder folder;
  test::write_coloured_las(folder / "a.las", points_with({{255, 0, 128}, {1, 2, 3}}));
  EXPECT_EQ(colours_of({folder / "a.las"}), (std::vector<RawColour>{{65535, 0, 32896}, {257, 514, 771}}));
}

TEST(ColourSource, LasWithWords_IsTakenAsItIs) {
  const test::TempFolder folder;
  const std::vector<RawColour> colours{{65535, 0, 256}, {1, 2, 3}, {40000, 255, 254}};
  test::write_coloured_las(folder / "a.las", points_with({{65535, 0, 256}, {1, 2, 3}, {40000, 255, 254}}));
  EXPECT_EQ(colours_of({folder / "a.las"}), colours);
}

TEST(ColourSource, PlyOfEveryType_IsReadByItsRange) {
  const test::TempFolder folder;
  test::write_coloured_ply(folder / "byte.ply", points_with({{255, 0, 51}, {1, 1, 1}}), "uchar");
  EXPECT_EQ(colours_of({folder / "byte.ply"}), (std::vector<RawColour>{{65535, 0, 13107}, {257, 257, 257}}));
  test::write_coloured_ply(folder / "word.ply", points_with({{65535, 256, 255}}), "ushort");
  EXPECT_EQ(colours_of({folder / "word.ply"}), (std::vector<RawColour>{{65535, 256, 255}}));
  test::write_coloured_ply(folder / "float.ply", points_with({{1.0, 0.5, 0.0}, {0.25, 0.75, 0.2}}), "float");
  EXPECT_EQ(colours_of({folder / "float.ply"}), (std::vector<RawColour>{{65535, 32768, 0}, {16384, 49151, 13107}}));
}

TEST(ColourSource, FloatsThatAreNoColours_AreBlackOrFull) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const test::TempFolder folder;
  test::write_coloured_ply(folder / "a.ply", points_with({{nan, -0.5, 1.0}}), "float");
  EXPECT_EQ(colours_of({folder / "a.ply"}), (std::vector<RawColour>{{0, 0, 65535}}));
}

TEST(ColourSource, BlackMissingOrEmpty_CountsAsNone) {
  const test::TempFolder folder;
  test::write_coloured_las(folder / "black.las", points_with({{0, 0, 0}, {0, 0, 0}}));
  test::write_coloured_ply(folder / "black.ply", points_with({{0, 0, 0}}), "float");
  test::write_coloured_las(folder / "empty.las", {});
  test::write_coloured_las(folder / "coloured.las", points_with({{9, 9, 9}}));
  test::write_las(folder / "plain.las", {{0, 0, 0}});
  EXPECT_TRUE(colours_of({folder / "black.las"}).empty());
  EXPECT_TRUE(colours_of({folder / "black.ply"}).empty());
  EXPECT_TRUE(colours_of({folder / "empty.las"}).empty());
  EXPECT_TRUE(colours_of({folder / "plain.las"}).empty());
  EXPECT_TRUE(colours_of({folder / "coloured.las", folder / "plain.las"}).empty()) << "all inputs or none";
  EXPECT_EQ(colours_of({folder / "coloured.las", folder / "black.las"}).size(), 3U) << "a part may be black";
}

TEST(ColourSource, AnySplitIntoFiles_GivesTheSameColours) {
  // The first part alone would pass for 8 bits, the second for black.
  const auto points = points_with({{3, 200, 255}, {0, 7, 9}, {0, 0, 0}, {0, 0, 0}, {60000, 1, 2}, {5, 5, 300}});
  const test::TempFolder folder;
  test::write_coloured_las(folder / "whole.las", points);
  const auto whole = colours_of({folder / "whole.las"});
  ASSERT_EQ(whole.size(), 6U);
  EXPECT_EQ(colours_of(test::split_las(folder / "whole.las", 3, folder.path())), whole);
  Paths parts;
  for (std::size_t i = 0; i < points.size(); ++i) {
    parts.push_back(folder.path() / ("p" + std::to_string(i) + ".ply"));
    test::write_coloured_ply(parts.back(), {points[i]}, "ushort");
  }
  EXPECT_EQ(colours_of(parts), whole);
}

TEST(ColourSource, LasAndPly_AreJudgedEachByItsOwnRange) {
  const test::TempFolder folder;
  test::write_coloured_las(folder / "a.las", points_with({{65535, 255, 0}}));
  test::write_coloured_ply(folder / "b.ply", points_with({{255, 0, 0}}), "uchar");
  test::write_coloured_ply(folder / "c.ply", points_with({{1, 0, 0}}), "uchar");
  EXPECT_EQ(colours_of({folder / "a.las", folder / "b.ply", folder / "c.ply"}),
            (std::vector<RawColour>{{65535, 255, 0}, {65535, 0, 0}, {257, 0, 0}}));
}

}  // namespace
}  // namespace arris::pipeline
