#include <unistd.h>

#include <cmath>
#include <limits>

#include "io_helpers.h"
#include "ply_builder.h"

namespace arris::test {
namespace {

const std::vector<std::string> kFormats{"ascii", "binary_little_endian", "binary_big_endian"};

class PlySource : public ::testing::Test {
 protected:
  std::filesystem::path write(const std::string& bytes) {
    write_new(folder_ / "a.ply", bytes);
    return folder_ / "a.ply";
  }
  std::string refusal(const std::string& bytes) {
    return message_of<InputError>([&] { read_all(write(bytes)); });
  }
  /// Reads the plan's file twice and compares with its vertices.
  void expect_reads(const PlyPlan& plan) {
    const PlyTable* vertices = nullptr;
    for (const PlyTable& table : plan.tables) {
      if (table.name == "vertex") vertices = &table;
    }
    const auto source = io::open_point_source(write(build_ply(plan)));
    EXPECT_FALSE(source->info().scaled_integers);
    for (const bool records : {true, false}) {
      source->rewind();
      const AllPoints all = read_all(*source, records, records ? 3 : 1000);
      ASSERT_EQ(all.world.size(), vertices->rows.size());
      for (std::size_t i = 0; i < all.world.size(); ++i) {
        const std::array<double, 3> expected{1.5 * static_cast<double>(i), -static_cast<double>(i),
                                             static_cast<double>(i) / 4};
        for (std::size_t c = 0; c < vertices->columns.size(); ++c) {
          const PlyColumn& column = vertices->columns[c];
          const int axis = column.name == "x" ? 0 : column.name == "y" ? 1 : column.name == "z" ? 2 : -1;
          if (axis < 0) continue;
          const bool fraction = column.type == "float" || column.type == "double";
          const bool ascii = plan.format == "ascii";
          const double value = expected[static_cast<std::size_t>(axis)];
          EXPECT_EQ(all.world[i][static_cast<std::size_t>(axis)], fraction || ascii ? value : std::trunc(value)) << i;
        }
        if (records) {
          EXPECT_EQ(all.records[i], ply_row(plan, *vertices, i));
        }
      }
    }
  }
  TempFolder folder_;
};

const std::vector<std::vector<PlyColumn>> kColumns{
    {{"x"}, {"y"}, {"z"}},
    {{"x", "double"}, {"y", "double"}, {"z", "double"}},
    {{"z", "double"}, {"nx"}, {"y"}, {"red", "uchar"}, {"x", "float"}, {"deep", "double"}},
    {{"flag", "uchar"}, {"x"}, {"y"}, {"z"}},
    {{"near", "int", "uchar"}, {"x"}, {"y", "double"}, {"z"}},
    {{"x"}, {"near", "double", "int"}, {"y"}, {"far", "uchar", "ushort"}, {"z"}, {"t", "ushort"}},
    {{"x", "int"}, {"y", "short"}, {"z", "char"}},
};

TEST_F(PlySource, EveryFormatOrderAndLineEnd_ReadsTheSamePoints) {
  const PlyTable faces{"face", {{"vertex_indices", "int", "uchar"}}, {{{0, 1, 2}}, {{}}, {{0, 1, 2, 3}}}};
  const PlyTable camera{"camera", {{"a"}, {"b", "double"}}, {{{1.0}, {2.0}}}};
  for (const std::string& format : kFormats) {
    for (const std::string line_end : {"\n", "\r\n", "\r"}) {
      for (const auto& columns : kColumns) {
        for (const std::size_t count : {0, 1, 10}) {
          SCOPED_TRACE(format + " " + std::to_string(line_end.size()) + " " + columns[0].name + " " +
                       std::to_string(count));
          const PlyTable vertices = make_vertices(columns, count);
          const std::vector<std::string> comments{"comment made by a test", "obj_info num_cols 3", "comment", ""};
          expect_reads({format, line_end, comments, {vertices}});
          expect_reads({format, line_end, {}, {camera, vertices}});
          expect_reads({format, line_end, {}, {faces, camera, vertices, {"empty", {}, {}}}});
          expect_reads({format, line_end, {}, {vertices, faces}});
        }
      }
    }
  }
}

TEST_F(PlySource, EveryTypeName_IsUnderstood) {
  for (const std::string& format : kFormats) {
    for (const char* type : {"char", "int8", "uchar", "uint8", "short", "int16", "ushort", "uint16", "int", "int32",
                             "uint", "uint32", "float", "float32", "double", "float64"}) {
      PlyPlan plan{format, "\n", {}, {{"vertex", {{"x", type}, {"y", type}, {"z", type}}, {{{1.0}, {100.0}, {3.0}}}}}};
      const AllPoints all = read_all(write(build_ply(plan)));
      EXPECT_EQ(all.world.at(0), (std::array<double, 3>{1.0, 100.0, 3.0})) << format << " " << type;
    }
  }
}

TEST_F(PlySource, ManyPoints_CrossEveryInternalBlock) {
  for (const std::string& format : kFormats) {
    for (const std::size_t lists : {0, 1}) {
      std::vector<PlyColumn> columns{{"x", "double"}, {"y", "double"}, {"z", "double"}};
      if (lists > 0) columns.push_back({"near", "int", "uchar"});
      const std::size_t count = 120001;
      write(build_ply({format, "\n", {}, {make_vertices(columns, count)}}));
      const AllPoints all = read_all(folder_ / "a.ply", false, 50000);
      ASSERT_EQ(all.world.size(), count);
      for (std::size_t i = 0; i < count; ++i) {
        const double n = static_cast<double>(i);
        ASSERT_EQ(all.world[i], (std::array<double, 3>{1.5 * n, -n, n / 4})) << format << " " << i;
      }
    }
  }
}

std::string ascii(const std::string& body, int count, const std::string& extra = "") {
  return "ply\nformat ascii 1.0\nelement vertex " + std::to_string(count) +
         "\nproperty float x\nproperty float y\nproperty float z\n" + extra + "end_header\n" + body;
}

TEST_F(PlySource, AsciiNumbersOfAllSpellings_AreUnderstood) {
  const AllPoints all = read_all(
      write(ascii("+1.5 .5 5.\n1e-3 -2E+2 1e400\n  nan\tinf   -inf\n1.#QNAN -1.#IND -1.#INF\n\n\n3\n4 5 7\n8 9", 6)));
  EXPECT_EQ(all.world[0], (std::array<double, 3>{1.5, 0.5, 5.0}));
  EXPECT_EQ(all.world[1][0], 1e-3);
  EXPECT_EQ(all.world[1][1], -200.0);
  EXPECT_TRUE(std::isinf(all.world[1][2]));
  EXPECT_TRUE(std::isnan(all.world[2][0]));
  EXPECT_EQ(all.world[2][1], std::numeric_limits<double>::infinity());
  EXPECT_EQ(all.world[2][2], -std::numeric_limits<double>::infinity());
  EXPECT_TRUE(std::isnan(all.world[3][0]) && std::isnan(all.world[3][1]));
  EXPECT_EQ(all.world[3][2], -std::numeric_limits<double>::infinity());
  EXPECT_EQ(all.world[4], (std::array<double, 3>{3, 4, 5}));
  EXPECT_EQ(all.world[5], (std::array<double, 3>{7, 8, 9}));
  EXPECT_EQ(all.records[4], "3\n4 5");
}

TEST_F(PlySource, AsciiDigits_AreAllKept) {
  EXPECT_EQ(read_all(write(ascii("5123456.7891 0.1 -0\n", 1))).world[0],
            (std::array<double, 3>{5123456.7891, 0.1, -0.0}));
}

TEST_F(PlySource, BinaryNan_IsDelivered) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const std::string& format : kFormats) {
    PlyPlan plan{format, "\n", {}, {{"vertex", {{"x"}, {"y", "double"}, {"z"}}, {{{nan}, {nan}, {1.0}}}}}};
    const AllPoints all = read_all(write(build_ply(plan)));
    EXPECT_TRUE(std::isnan(all.world[0][0]) && std::isnan(all.world[0][1]));
    EXPECT_EQ(all.world[0][2], 1.0);
  }
}

TEST_F(PlySource, DamagedAscii_IsRefusedWithItsPlace) {
  EXPECT_HAS(refusal(ascii("10 20 30\n4 5", 2)), "vertex 2 of 2");
  EXPECT_HAS(refusal(ascii("1 2 3\n4 5 x\n", 2)), "\"x\" is not a number");
  EXPECT_HAS(refusal(ascii("1,5 2 3\n", 1)), "point");
  EXPECT_HAS(refusal(ascii("1 2 3\n", 1000000)), "counts 1000000 vertices");
  EXPECT_HAS(refusal(ascii("1 2 3 x\n", 1, "property int a\n")), "\"x\" is not a number");
  EXPECT_HAS(refusal(ascii("1 2 3 -1\n", 1, "property list int int a\n")), "length of a list");
  EXPECT_HAS(refusal(ascii("1 2 3 99999999999999999999\n", 1, "property list int int a\n")), "length of a list");
  EXPECT_HAS(refusal(ascii("1 2 3 4\n5 6 7 8\n", 2)), "fewer properties than the lines have");
  EXPECT_EQ(read_all(write(ascii("1 2 3\n4 5 6\n7 8 9\n", 2))).world.size(), 2U);
}

TEST_F(PlySource, DamagedHeader_IsRefusedWithItsLine) {
  const std::string head = "ply\nformat ascii 1.0\n";
  const std::string vertex = "element vertex 1\nproperty float x\nproperty float y\nproperty float z\n";
  const std::string end = "end_header\n1 2 3\n";
  EXPECT_EQ(read_all(write(head + vertex + end)).world.size(), 1U);
  EXPECT_EQ(read_all(write("ply\ncomment early\nformat ascii 1.0\n" + vertex + end)).world.size(), 1U);
  EXPECT_HAS(refusal("ply\n" + vertex + end), "format");
  EXPECT_HAS(refusal("ply\nformat wide 1.0\n" + vertex + end), "line 2: unknown format");
  EXPECT_HAS(refusal(head + "format ascii 1.0\n" + vertex + end), "line 3: a second");
  EXPECT_EQ(read_all(write(head + "Created by hand\n" + vertex + end)).world.size(), 1U);
  EXPECT_HAS(refusal(head + vertex + "\x1b[31mred\n" + end), "unknown keyword \"?[31mred\"");
  EXPECT_HAS(refusal(head + "property float x\n" + vertex + end), "before any element");
  EXPECT_HAS(refusal(head + vertex + "property float x\n" + end), "line 7: a second property \"x\"");
  EXPECT_HAS(refusal(head + vertex + vertex + end), "a second element");
  EXPECT_HAS(refusal(head + vertex + "property real r\n" + end), "unknown type \"real\"");
  EXPECT_HAS(refusal(head + vertex + "property list float int r\n" + end), "integer type");
  EXPECT_HAS(refusal(head + vertex + "property float\n" + end), "expected \"property");
  EXPECT_HAS(refusal(head + vertex), "\"end_header\" is missing");
  EXPECT_HAS(refusal(head + "element point 1\nproperty float x\n" + end), "no element \"vertex\", only: point");
  EXPECT_HAS(refusal(head + "element vertex 1\nproperty float x\nproperty float y\n" + end), "no property \"z\"");
  EXPECT_HAS(refusal(head + "element vertex 1\nproperty float x\nproperty float y\nproperty list int int z\n" + end),
             "no property \"z\"");
  for (const char* count : {"-1", "1.5", "18446744073709551616", "x", "0x10"}) {
    EXPECT_HAS(refusal(head + "element vertex " + count + "\n" + vertex.substr(17) + end), "not a number of elements");
  }
}

TEST_F(PlySource, HeaderBombs_AreRefusedAtOnce) {
  EXPECT_HAS(refusal("ply\nformat ascii 1.0\ncomment " + std::string(2 << 20, 'x')), "1 MiB");
  std::string many = "ply\nformat ascii 1.0\nelement vertex 1\n";
  for (int i = 0; i < 200000; ++i) many += "property int " + std::to_string(i) + "\n";
  EXPECT_HAS(refusal(many), "1 MiB");
  EXPECT_EQ(read_all(write("ply\nformat ascii 1.0\ncomment " + std::string(100000, 'x') + "\n" +
                           ascii("1 2 3\n", 1).substr(21)))
                .world.size(),
            1U);
}

TEST_F(PlySource, BinaryCutShort_IsRefusedWithNumbers) {
  for (const std::string format : {"binary_little_endian", "binary_big_endian"}) {
    const std::string whole = build_ply({format, "\n", {}, {make_vertices(kColumns[0], 10)}});
    for (std::size_t lost = 1; lost <= 24; ++lost) {
      const std::string text = refusal(whole.substr(0, whole.size() - lost));
      EXPECT_HAS(text, "10 vertex records of 12 bytes");
      EXPECT_HAS(text, "holds " + std::to_string((120 - lost) / 12));
    }
    const std::string lists = build_ply({format, "\n", {}, {make_vertices(kColumns[4], 10)}});
    for (std::size_t lost = 1; lost <= 30; ++lost) refusal(lists.substr(0, lists.size() - lost));
  }
}

TEST_F(PlySource, CountsAndListLengthsThatOverflow_AreRefused) {
  const std::string start = "ply\nformat binary_little_endian 1.0\nelement vertex ";
  const std::string xyz = "\nproperty float x\nproperty float y\nproperty float z\n";
  for (const char* count : {"18446744073709551615", "1537228672809129302", "4294967296"}) {
    EXPECT_HAS(refusal(start + count + xyz + "end_header\n" + std::string(48, '\0')), "holds 4");
    EXPECT_HAS(refusal(start + count + xyz + "property list uchar int l\nend_header\n" + std::string(48, '\0')),
               "at most 3");
  }
  EXPECT_HAS(refusal(start + "1" + xyz + "property list uint double l\nend_header\n" + std::string(12, '\0') +
                     "\xff\xff\xff\xff"),
             "length 4294967295");
  EXPECT_HAS(refusal(start + "1" + xyz + "property list int double l\nend_header\n" + std::string(12, '\0') +
                     "\xff\xff\xff\xff"),
             "length -1");
  EXPECT_HAS(refusal(start + "1" + xyz + "property list uint uchar l\nend_header\n" + std::string(12, '\0') +
                     std::string("\xff\xff\x0f\0", 4)),
             "ends at byte");
}

TEST_F(PlySource, MoreThan32BitsOfPoints_AreCounted) {
  constexpr std::uint64_t kPoints = (std::uint64_t{1} << 32) + 5;
  const std::string header = "ply\nformat binary_little_endian 1.0\nelement vertex " + std::to_string(kPoints) +
                             "\nproperty float x\nproperty float y\nproperty float z\nend_header\n";
  const auto path = write(header);
  if (::truncate(path.c_str(), static_cast<off_t>(header.size() + 12 * kPoints)) != 0)
    GTEST_SKIP() << "no sparse file of 51 GB here";
  const auto source = io::open_point_source(path);
  EXPECT_EQ(source->info().points, kPoints);
  io::PointBatch batch;
  EXPECT_TRUE(source->read(batch, {}));
}

}  // namespace
}  // namespace arris::test
