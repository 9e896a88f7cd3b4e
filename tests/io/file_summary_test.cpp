#include "io/file_summary.h"

#include "io_helpers.h"
#include "las_builder.h"
#include "ply_builder.h"

namespace arris::test {
namespace {

std::string field(const io::FileSummary& summary, const std::string& name) {
  for (const auto& [key, value] : summary.header) {
    if (key == name) return value;
  }
  return "(absent)";
}

std::string codes(const io::FileSummary& summary) {
  std::string all;
  for (const io::Problem& problem : summary.problems) all += problem.code + ";";
  return all;
}

/// GeoTIFF keys: a citation at [0, length) of the texts, and a projected code.
std::string geo_keys(std::uint16_t count, std::uint16_t length, std::uint16_t code) {
  std::string keys(24, '\0');
  put<std::uint16_t>(keys, 0, 1);
  put<std::uint16_t>(keys, 6, count);
  put<std::uint16_t>(keys, 8, 1026);
  put<std::uint16_t>(keys, 10, 34737);
  put<std::uint16_t>(keys, 12, length);
  put<std::uint16_t>(keys, 16, 3072);
  put<std::uint16_t>(keys, 20, 1);
  put<std::uint16_t>(keys, 22, code);
  return keys;
}

class Summary : public ::testing::Test {
 protected:
  io::FileSummary of(const std::string& bytes) {
    write_new(folder_ / "a", bytes);
    return io::summarize_file(folder_ / "a");
  }
  TempFolder folder_;
};

TEST_F(Summary, LasHeaderRecordsAndExtraBytes_AreListed) {
  LasPlan plan;
  plan.minor = 4;
  plan.format = 6;
  plan.record_bytes = 30 + 2 + 12 + 5;
  plan.points = make_records(3, plan.record_bytes);
  plan.vlrs = {{"LASF_Spec", 4, extra_entry(3, "Amplitude") + extra_entry(29, "Normal")},
               {"evil\x1b[31m", 9, "abc", "tab\there"}};
  plan.evlrs = {{"far", 12, std::string(70, 'e')}};
  std::string bytes = build_las(plan);
  put<double>(bytes, 179, 12.5);
  put<double>(bytes, 187, -3.0);
  const io::FileSummary summary = of(bytes);
  EXPECT_EQ(field(summary, "version"), "1.4");
  EXPECT_EQ(field(summary, "file source id"), "77");
  EXPECT_EQ(field(summary, "generating software"), "SOFTWARE");
  EXPECT_EQ(field(summary, "points (64 bit)"), "3");
  EXPECT_EQ(field(summary, "scale"), "0.01 0.01 0.001");
  ASSERT_TRUE(summary.claimed_bounds.has_value());
  EXPECT_EQ(summary.claimed_bounds->max[0], 12.5);
  EXPECT_EQ(summary.claimed_bounds->min[0], -3.0);
  ASSERT_EQ(summary.records.size(), 3U);
  EXPECT_EQ(summary.records[1].user_id, "evil?[31m");
  EXPECT_EQ(summary.records[1].description, "tab?here");
  EXPECT_EQ(summary.records[1].length, 3U);
  EXPECT_TRUE(summary.records[2].extended);
  EXPECT_EQ(summary.records[2].length, 70U);
  ASSERT_EQ(summary.attributes.size(), 3U);
  EXPECT_EQ(summary.attributes[0].name + " " + summary.attributes[0].type, "Amplitude uint16");
  EXPECT_EQ(summary.attributes[1].name + " " + summary.attributes[1].type, "Normal float[3]");
  EXPECT_EQ(summary.attributes[2].type, "undocumented");
  EXPECT_EQ(summary.attributes[2].size_bytes, 5U);
  EXPECT_EQ(codes(summary), "");
}

TEST_F(Summary, Crs_IsWktElseCitation) {
  LasPlan plan;
  EXPECT_EQ(of(build_las(plan)).crs.name, "");
  plan.vlrs = {{"LASF_Projection", 2112, ""},
               {"LASF_Projection", 34735, geo_keys(2, 12, 25832)},
               {"LASF_Projection", 34737, std::string("ETRS89 UTM|\0xx", 14)}};
  EXPECT_EQ(of(build_las(plan)).crs.name, "ETRS89 UTM (EPSG:25832)");
  EXPECT_EQ(of(build_las(plan)).crs.epsg, 25832);
  plan.vlrs[2].payload = "";
  EXPECT_EQ(of(build_las(plan)).crs.name, "EPSG:25832");
  plan.vlrs.push_back({"LASF_Projection", 2112, std::string("PROJCS[\"a\tb\"]\0junk", 18)});
  EXPECT_EQ(of(build_las(plan)).crs.text, "PROJCS[\"a?b\"]");
  EXPECT_EQ(of(build_las(plan)).crs.name, "a?b");
}

TEST_F(Summary, DamagedGeoKeys_AreIgnored) {
  for (const std::size_t size : {0, 1, 7, 8, 9, 15, 16, 23, 24}) {
    for (const int claimed : {0, 1, 2, 3, 65535}) {
      const auto count = static_cast<std::uint16_t>(claimed);
      LasPlan plan;
      plan.vlrs = {{"LASF_Projection", 34735, geo_keys(count, 65535, 40000).substr(0, size)},
                   {"LASF_Projection", 34737, "UTM"}};
      const std::string crs = of(build_las(plan)).crs.name;
      EXPECT_EQ(crs, size >= 16 && count >= 1 ? "UTM" : "");
    }
  }
}

TEST_F(Summary, WhatIsWrong_IsListed) {
  LasPlan plan;
  plan.minor = 4;
  plan.format = 6;
  plan.record_bytes = 31;
  plan.points = make_records(3, 31);
  plan.vlrs = {{"LASF_Spec", 4, extra_entry(10, "long") + "?"}};
  std::string bytes = build_las(plan) + "trailing";
  put<std::uint16_t>(bytes, 6, 0);
  put<double>(bytes, 179, -1.0);
  EXPECT_EQ(codes(of(bytes)), "bounds-invalid;wkt-bit;trailing-bytes;extra-bytes-length;extra-bytes-mismatch;");
}

TEST_F(Summary, Ply_ListsPropertiesCommentsAndElements) {
  const PlyTable faces{"face", {{"vertex_indices", "int", "uchar"}}, {{{0, 1, 2}}}};
  const io::FileSummary summary =
      of(build_ply({"binary_little_endian",
                    "\n",
                    {"comment scanned\x07today"},
                    {make_vertices({{"x", "double"}, {"y"}, {"z"}, {"l", "int", "uchar"}}, 3), faces}}));
  EXPECT_EQ(field(summary, "format"), "binary_little_endian");
  EXPECT_EQ(field(summary, "comment"), "scanned?today");
  ASSERT_EQ(summary.records.size(), 1U);
  EXPECT_EQ(summary.records[0].user_id, "face");
  ASSERT_EQ(summary.attributes.size(), 4U);
  EXPECT_EQ(summary.attributes[0].type, "double");
  EXPECT_EQ(summary.attributes[0].size_bytes, 8U);
  EXPECT_EQ(summary.attributes[3].type, "list uchar int");
  EXPECT_FALSE(summary.claimed_bounds.has_value());
}

}  // namespace
}  // namespace arris::test
