#include <algorithm>
#include <array>
#include <iterator>

#include "io_helpers.h"
#include "las_builder.h"
#include "ply_builder.h"

namespace arris::test {
namespace {

TEST(InputSet, SeveralFiles_AreOneStreamWithGlobalIds) {
  const TempFolder folder;
  std::vector<std::filesystem::path> paths;
  for (const std::size_t count : {5, 0, 7, 1}) {
    LasPlan plan;
    plan.points = make_records(count, 20, static_cast<unsigned>(count));
    paths.push_back(folder / (std::to_string(paths.size()) + ".las").c_str());
    write_new(paths.back(), build_las(plan));
  }
  paths.push_back(folder / "p.ply");
  write_new(paths.back(), build_ply({"ascii", "\n", {}, {make_vertices({{"x"}, {"y"}, {"z"}}, 3)}}));
  io::InputSet set(paths);
  EXPECT_EQ(set.points(), 16U);
  EXPECT_EQ(set.sources().size(), 5U);
  io::ReadOptions options;
  options.batch_points = 4;
  for (int pass = 0; pass < 2; ++pass) {
    io::PointBatch batch;
    std::uint64_t next = 0;
    std::vector<std::size_t> of_source(5);
    while (set.read(batch, options)) {
      EXPECT_EQ(batch.first_id, next);
      next += batch.count;
      of_source[set.source_index()] += batch.count;
      EXPECT_EQ(batch.ix.size(), set.source_index() < 4 ? batch.count : 0);
      EXPECT_EQ(batch.x.size(), set.source_index() < 4 ? 0 : batch.count);
    }
    EXPECT_EQ(next, 16U);
    EXPECT_EQ(of_source, (std::vector<std::size_t>{5, 0, 7, 1, 3}));
    EXPECT_FALSE(set.read(batch, options));
    EXPECT_EQ(batch.count, 0U);
    set.rewind();
  }
}

TEST(InputSet, SkipTo_GoesOnThereAsIfAllBeforeHadBeenRead) {
  const TempFolder folder;
  std::vector<std::filesystem::path> paths;
  for (const std::size_t count : {5, 0, 7}) {
    LasPlan plan;
    plan.points = make_records(count, 20, static_cast<unsigned>(count));
    paths.push_back(folder / (std::to_string(paths.size()) + ".las").c_str());
    write_new(paths.back(), build_las(plan));
  }
  for (const char* format : {"binary_big_endian", "ascii"}) {
    paths.push_back(folder / (std::string(format) + ".ply").c_str());
    write_new(paths.back(), build_ply({format, "\n", {}, {make_vertices({{"x"}, {"y"}, {"z"}}, 3)}}));
  }
  io::InputSet set(paths);
  std::vector<std::array<double, 3>> all;
  io::PointBatch batch;
  const auto places = [&] {
    std::vector<std::array<double, 3>> at;
    for (std::size_t i = 0; i < batch.count; ++i) {
      at.emplace_back();
      for (std::size_t axis = 0; axis < 3; ++axis)
        at.back()[axis] = io::world_coordinate(set.sources()[set.source_index()], batch, i, axis);
    }
    return at;
  };
  while (set.read(batch, {})) std::ranges::copy(places(), std::back_inserter(all));
  ASSERT_EQ(all.size(), 18U);
  io::ReadOptions two;
  two.batch_points = 2;
  for (const std::uint64_t id : {13U, 4U, 5U, 11U, 0U, 12U, 7U, 8U}) {
    ASSERT_TRUE(set.skip_to(id)) << id;
    ASSERT_TRUE(set.read(batch, two));
    EXPECT_EQ(batch.first_id, id);
    EXPECT_EQ(batch.count, id == 4 || id == 11 ? 1U : 2U) << "a batch ends with its file";
    EXPECT_EQ(places(), std::vector(all.begin() + static_cast<std::ptrdiff_t>(id),
                                    all.begin() + static_cast<std::ptrdiff_t>(id + batch.count)));
  }
  EXPECT_FALSE(set.skip_to(16)) << "where lines end is known by reading only";
  set.rewind();
  std::uint64_t again = 0;
  while (set.read(batch, {})) again += batch.count;
  EXPECT_EQ(again, 18U);
}

TEST(InputSet, FileReplacedBetweenPasses_IsRefused) {
  const TempFolder folder;
  LasPlan plan;
  plan.points = make_records(5, 20);
  write_new(folder / "a.las", build_las(plan));
  io::InputSet set({folder / "a.las"});
  plan.points.pop_back();
  write_new(folder / "a.las", build_las(plan));
  io::PointBatch batch;
  EXPECT_HAS(message_of<InputError>([&] { set.read(batch, {}); }), "changed while it was in use (5 points, now 4)");
}

TEST(InputSet, NoFiles_IsRefused) {
  message_of<ConfigError>([] { io::InputSet set({}); });
}

TEST(ExpandInputs, Folder_GivesItsScansInOrderOfTheirNames) {
  const TempFolder folder;
  for (const char* name : {"b.las", "A.LAS", "c.Ply", "a.las", "d.laz", "e.txt", "f.las.partial-3"})
    write_new(folder / name, "x");
  std::filesystem::create_directory(folder / "g.las");
  write_new(folder / "g.las/h.las", "x");
  const std::vector<std::string> arguments{folder.path().string(), (folder / "e.txt").string()};
  std::vector<std::string> names;
  for (const auto& path : io::expand_inputs(arguments)) names.push_back(path.filename().string());
  EXPECT_EQ(names, (std::vector<std::string>{"A.LAS", "a.las", "b.las", "c.Ply", "e.txt"}));
}

TEST(ExpandInputs, WhatHasNoScans_IsRefused) {
  const TempFolder folder;
  const auto refusal = [&](const std::string& argument) {
    return message_of<InputError>([&] { io::expand_inputs(std::vector<std::string>{argument}); });
  };
  EXPECT_HAS(refusal((folder / "absent").string()), "no such file");
  EXPECT_HAS(refusal(folder.path().string()), "no .las or .ply");
  write_new(folder / "a.laz", "x");
  EXPECT_HAS(refusal(folder.path().string()), ".laz files must be decompressed");
}

}  // namespace
}  // namespace arris::test
