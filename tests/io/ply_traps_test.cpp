/// What real PLY files get wrong or carry that readers lose; tests/README.md has the table.
#include "io/record_reader.h"
#include "io_helpers.h"
#include "ply_builder.h"

namespace arris::test {
namespace {

class PlyTraps : public ::testing::Test {
 protected:
  std::filesystem::path write(const std::string& bytes) {
    write_new(folder_ / "a.ply", bytes);
    return folder_ / "a.ply";
  }
  TempFolder folder_;
};

TEST_F(PlyTraps, P09_CutBody_IsSalvagedToItsWholeVertices) {
  for (const std::string format : {"ascii", "binary_little_endian", "binary_big_endian"}) {
    for (const bool list : {false, true}) {
      std::vector<PlyColumn> columns{{"x"}, {"y"}, {"z"}};
      if (list) columns.push_back({"l", "uchar", "int"});
      const PlyPlan plan{format, "\n", {}, {make_vertices(columns, 9)}};
      const std::string whole = build_ply(plan);
      const std::size_t begin = whole.find("end_header\n") + 11;
      std::vector<std::size_t> ends;  // Of every vertex.
      for (std::size_t i = 0, at = begin; i < 9; ++i)
        ends.push_back(at += ply_row(plan, plan.tables[0], i).size() + (format == "ascii" ? 1 : 0));
      for (std::size_t size = begin; size < whole.size() - 2; ++size) {
        const auto path = write(whole.substr(0, size));
        const auto source = io::open_point_source(path, io::Tolerance::kSalvage);
        const auto complete = [&](std::size_t end) { return end <= size; };
        const auto whole_vertices = static_cast<std::uint64_t>(std::count_if(ends.begin(), ends.end(), complete));
        // A number that ends with an ascii file may be cut, so its vertex is no whole one, unless it is the last.
        EXPECT_EQ(read_all(*source).world.size(), whole_vertices);
        ASSERT_FALSE(source->info().problems.empty());
        EXPECT_EQ(source->info().problems.back().code, "points-lost");
      }
    }
  }
}

TEST_F(PlyTraps, P09_DamageInTheMiddle_IsSalvagedUpToIt) {
  const std::string text =
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\nend_header\n"
      "1 2 3\n4 5 6\n7 oops 9\n1 1 1\n";
  message_of<InputError>([&] { read_all(write(text)); });
  const auto source = io::open_point_source(write(text), io::Tolerance::kSalvage);
  EXPECT_EQ(read_all(*source).world.size(), 2U);
  EXPECT_HAS(source->info().problems.back().text, "2 of 4 vertices are whole");
}

TEST_F(PlyTraps, P04_ElementsThatDoNotFit_AreReported) {
  PlyPlan plan{"binary_little_endian", "\n", {}, {make_vertices({{"x"}, {"y"}, {"z"}}, 3)}};
  plan.tables.push_back({"face", {{"vertex_indices", "int", "uchar"}}, {{{0, 1, 2}}, {{1, 2, 0}}}});
  const std::string whole = build_ply(plan);
  EXPECT_TRUE(io::open_point_source(write(whole))->info().problems.empty());
  const auto cut = io::open_point_source(write(whole.substr(0, whole.size() - 26)));
  ASSERT_EQ(cut->info().problems.size(), 1U);
  EXPECT_EQ(cut->info().problems[0].code, "elements-lost");
  EXPECT_EQ(read_all(*cut).world.size(), 3U);
  message_of<InputError>(
      [&] { io::open_point_source(write(whole.substr(0, whole.size() - 26)), io::Tolerance::kStrict); });
}

TEST_F(PlyTraps, P12_ExportersNames_AreUnderstood) {
  const std::vector<std::pair<std::string, std::string>> names{{"scalar_Intensity", "intensity"},
                                                               {"reflectance", "intensity"},
                                                               {"scalar_Classification", "classification"},
                                                               {"diffuse_red", "red"},
                                                               {"r", "red"},
                                                               {"scalar_GpsTime", "gps_time"},
                                                               {"scalar_ScanAngleRank", "scan_angle"},
                                                               {"scalar_Planarity", "scalar_Planarity"},
                                                               {"nx", "nx"},
                                                               {"confidence", "confidence"}};
  for (const auto& [name, common] : names) {
    const auto path = write(build_ply({"ascii", "\n", {}, {make_vertices({{name}, {"x"}, {"y"}, {"z"}}, 2)}}));
    const auto source = io::open_point_source(path);
    const auto reader = io::make_record_reader(io::InputFile(path), source->info());
    EXPECT_EQ(reader->columns()[0].name, common);
    EXPECT_EQ(reader->columns()[0].name_in_file, name);
    EXPECT_EQ(reader->find(common), 0);
    EXPECT_EQ(reader->find(name), 0);
  }
  const auto both = write(build_ply({"ascii", "\n", {}, {make_vertices({{"r"}, {"red"}, {"x"}, {"y"}, {"z"}}, 2)}}));
  const auto reader = io::make_record_reader(io::InputFile(both), io::open_point_source(both)->info());
  EXPECT_EQ(reader->columns()[0].name, "r") << "the name itself comes first";
}

TEST_F(PlyTraps, P15_WithEveryPointKept_FacesAndEdgesStay) {
  for (const std::string format : {"ascii", "binary_little_endian", "binary_big_endian"}) {
    PlyPlan plan{format, "\n", {"comment c", "obj_info o"}, {}};
    plan.tables.push_back({"before", {{"vertex_index", "int"}}, {{{2}}, {{0}}}});
    plan.tables.push_back(make_vertices({{"x"}, {"y"}, {"z"}}, 4));
    plan.tables.push_back({"face", {{"vertex_indices", "int", "uchar"}}, {{{0, 1, 2}}, {{1, 2, 3, 0}}}});
    const auto in = write(build_ply(plan));
    for (const bool every_point : {false, true}) {
      std::filesystem::remove(folder_ / "out.ply");
      io::InputSet set({in});
      io::OutputOptions options;
      options.every_point = every_point;
      const auto writer = io::create_kept_point_writer(folder_ / "out.ply", set, {}, options);
      io::PointBatch batch;
      io::ReadOptions reading;
      reading.records = true;
      while (set.read(batch, reading)) writer->append(0, batch, std::vector<std::uint32_t>{0, 1, 2, 3}, {});
      writer->commit();
      std::string out = file_bytes(folder_ / "out.ply");
      if (!every_point) {
        EXPECT_EQ(out.find("element face"), std::string::npos);
        EXPECT_EQ(writer->warnings().size(), 2U);
        continue;
      }
      EXPECT_TRUE(writer->warnings().empty());
      const std::size_t comment = out.find("comment written by arris");
      ASSERT_NE(comment, std::string::npos);
      out.erase(comment, out.find('\n', comment) - comment + 1);
      EXPECT_EQ(out, build_ply(plan));
    }
  }
}

}  // namespace
}  // namespace arris::test
