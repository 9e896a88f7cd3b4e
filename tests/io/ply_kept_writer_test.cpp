#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include "io/ply_sharing.h"
#include "io_helpers.h"
#include "las_builder.h"
#include "ply_builder.h"

namespace arris::test {
namespace {

const std::vector<ColumnSpec> kColumns{{"EdgeClass", ColumnType::kUint8, ""},
                                       {"Score", ColumnType::kFloat32, ""},
                                       {"Id", ColumnType::kUint32, ""},
                                       {"Votes", ColumnType::kUint16, ""}};

struct OurRow {
  std::uint8_t edge;
  float score;
  std::uint32_t id;
  std::uint16_t votes;
};
OurRow our_row(std::uint64_t id) {
  return {static_cast<std::uint8_t>(id), 0.1F * static_cast<float>(id), static_cast<std::uint32_t>(id * 100000007),
          static_cast<std::uint16_t>(id * 7)};
}
std::string row_of(std::uint64_t id) {
  const OurRow row = our_row(id);
  std::string bytes(11, '\0');
  put(bytes, 0, row.edge);
  put(bytes, 1, row.score);
  put(bytes, 5, row.id);
  put(bytes, 9, row.votes);
  return bytes;
}
/// Our columns as the test's own builder encodes them.
std::string expected_row(const PlyPlan& plan, std::uint64_t id) {
  const OurRow row = our_row(id);
  if (plan.format == "ascii") {
    char text[100];
    std::snprintf(text, sizeof text, " %u ", row.edge);
    std::string line = text;
    for (int digits = 1; digits <= 9; ++digits) {  // The shortest text that gives the float back.
      std::snprintf(text, sizeof text, "%.*g", digits, static_cast<double>(row.score));
      if (std::strtof(text, nullptr) == row.score) break;
    }
    line += text;
    std::snprintf(text, sizeof text, " %u %u", row.id, row.votes);
    return line + text;
  }
  const bool big = plan.format == "binary_big_endian";
  using namespace ply_detail;
  return binary("uchar", row.edge, big) + binary("float", static_cast<double>(row.score), big) +
         binary("uint", row.id, big) + binary("ushort", row.votes, big);
}
const std::string kOurLines = "property uchar EdgeClass|property float Score|property uint Id|property ushort Votes|";

std::string with_line_end(std::string text, const std::string& line_end) {
  for (std::size_t at = 0; (at = text.find('|', at)) != std::string::npos; at += line_end.size())
    text.replace(at, 1, line_end);
  return text;
}

/// Takes the padding comment out and requires that it is there.
std::string without_count_comment(std::string text, const std::string& line_end) {
  const std::size_t at = text.find("comment written by arris");
  EXPECT_NE(at, std::string::npos);
  text.erase(at, text.find(line_end, at) + line_end.size() - at);
  return text;
}

const std::vector<std::string> kFormats{"ascii", "binary_little_endian", "binary_big_endian"};

PlyPlan random_plan() {
  PlyPlan plan;
  plan.format = *rc::gen::elementOf(kFormats);
  plan.line_end = *rc::gen::element<std::string>("\n", "\r\n", "\r");
  const int comments = *rc::gen::inRange(0, 3);
  for (int i = 0; i < comments; ++i) plan.comments.push_back(i % 2 == 0 ? "comment  some  text " : "obj_info 5");
  std::vector<PlyColumn> columns{{"x", *rc::gen::element<std::string>("float", "double")}, {"y"}, {"z", "float32"}};
  const int more = *rc::gen::inRange(0, 4);
  for (int i = 0; i < more; ++i) {
    PlyColumn column{"more" + std::to_string(i),
                     *rc::gen::element<std::string>("uchar", "short", "uint", "double", "int8"), ""};
    if (*rc::gen::inRange(0, 4) == 0) column.list = "uchar";
    const auto at = *rc::gen::inRange<std::size_t>(0, columns.size() + 1);
    columns.insert(columns.begin() + static_cast<std::ptrdiff_t>(at), column);
  }
  plan.tables = {make_vertices(columns, *rc::gen::inRange<std::size_t>(0, 20))};
  const PlyTable camera{"camera", {{"view", "float"}, {"wide", "double"}}, {{{1.5}, {2.0}}, {{3.0}, {4.0}}}};
  const PlyTable none{"face", {{"vertex_indices", "int", "uchar"}}, {}};
  if (*rc::gen::arbitrary<bool>()) plan.tables.insert(plan.tables.begin(), camera);
  if (*rc::gen::arbitrary<bool>()) plan.tables.push_back(none);
  if (plan.tables[0].name != "camera" && *rc::gen::arbitrary<bool>()) plan.tables.push_back(camera);
  return plan;
}

class PlyKept : public ::testing::Test {
 protected:
  TempFolder folder_;
};

RC_GTEST_FIXTURE_PROP(PlyKept, WithoutOurColumns_FileEqualsTheInputWithFewerVertices, ()) {
  PlyPlan plan = random_plan();
  const auto vertices =
      std::find_if(plan.tables.begin(), plan.tables.end(), [](const PlyTable& t) { return t.name == "vertex"; });
  const auto mask = *rc::gen::container<std::vector<bool>>(vertices->rows.size(), rc::gen::arbitrary<bool>());
  write_new(folder_ / "in.ply", build_ply(plan));
  const auto warnings = write_kept(
      folder_ / "out.ply", {folder_ / "in.ply"}, kColumns, [&](std::uint64_t id) { return mask[id]; }, row_of);
  RC_ASSERT(warnings.empty());

  // Build the expected file with the test's own builder: kept rows, our bytes and lines put in by hand.
  PlyTable kept = *vertices;
  kept.rows.clear();
  std::string body;
  for (std::size_t i = 0; i < mask.size(); ++i) {
    if (!mask[i]) continue;
    kept.rows.push_back(vertices->rows[i]);
    body += ply_row(plan, *vertices, i) + expected_row(plan, i) + (plan.format == "ascii" ? plan.line_end : "");
  }
  const std::string plain_body = [&] {
    std::string text;
    for (std::size_t i = 0; i < kept.rows.size(); ++i)
      text += ply_row(plan, kept, i) + (plan.format == "ascii" ? plan.line_end : "");
    return text;
  }();
  *vertices = kept;
  std::string expected = build_ply(plan);
  const std::size_t header_end = expected.find("end_header") + 10 + plan.line_end.size();
  std::size_t body_at = header_end;
  if (plan.tables[0].name == "camera") {
    for (std::size_t i = 0; i < 2; ++i)
      body_at += ply_row(plan, plan.tables[0], i).size() + (plan.format == "ascii" ? plan.line_end.size() : 0);
  }
  expected.replace(body_at, plain_body.size(), body);
  const PlyColumn& last = kept.columns.back();
  const std::string last_line =
      "property " + (last.list.empty() ? "" : "list " + last.list + " ") + last.type + " " + last.name + plan.line_end;
  const std::size_t vertex_line = expected.find("element vertex");
  expected.insert(expected.find(last_line, vertex_line) + last_line.size(), with_line_end(kOurLines, plan.line_end));
  RC_ASSERT(without_count_comment(file_bytes(folder_ / "out.ply"), plan.line_end) == expected);
  RC_ASSERT(read_all(folder_ / "out.ply").world.size() == kept.rows.size());
}

TEST_F(PlyKept, Faces_AreDroppedWithAWarning) {
  for (const std::string& format : kFormats) {
    const PlyTable faces{
        "face", {{"vertex_indices", "int", "uchar"}, {"flag", "uchar"}}, {{{0, 1, 2}, {9.0}}, {{}, {8.0}}}};
    const PlyTable edges{"edge", {{"vertex1", "int"}, {"vertex2", "int"}}, {{{0.0}, {1.0}}}};
    const PlyTable camera{"camera", {{"view", "float"}}, {{{1.5}}}};
    write_new(folder_ / "in.ply",
              build_ply({format, "\n", {}, {faces, edges, make_vertices({{"x"}, {"y"}, {"z"}}, 3), camera}}));
    std::filesystem::remove(folder_ / "out.ply");
    const auto warnings = write_kept(
        folder_ / "out.ply", {folder_ / "in.ply"}, {}, [](std::uint64_t id) { return id > 0; },
        [](std::uint64_t) { return ""; });
    ASSERT_EQ(warnings.size(), 2U);
    EXPECT_HAS(warnings[0], "element face (2 records) is left out");
    EXPECT_HAS(warnings[1], "element edge (1 records) is left out");
    PlyTable two = make_vertices({{"x"}, {"y"}, {"z"}}, 3);
    two.rows.erase(two.rows.begin());
    EXPECT_EQ(without_count_comment(file_bytes(folder_ / "out.ply"), "\n"),
              build_ply({format, "\n", {}, {two, camera}}));
  }
}

TEST_F(PlyKept, OutputFedBack_KeepsOnePaddingCommentAndNumbersNames) {
  const std::vector<ColumnSpec> one{{"Id", ColumnType::kUint8, ""}};
  const auto all = [](std::uint64_t) { return true; };
  const auto byte = [](std::uint64_t) { return "7"; };
  write_new(folder_ / "a.ply", build_ply({"ascii", "\n", {}, {make_vertices({{"x"}, {"y"}, {"z"}}, 3)}}));
  write_kept(folder_ / "b.ply", {folder_ / "a.ply"}, one, all, byte);
  const auto warnings = write_kept(folder_ / "c.ply", {folder_ / "b.ply"}, one, all, byte);
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_HAS(warnings[0], "Id_2");
  const std::string text = file_bytes(folder_ / "c.ply");
  EXPECT_EQ(without_count_comment(text, "\n").find("written by arris"), std::string::npos);
  EXPECT_HAS(text, "property uchar Id\nproperty uchar Id_2\nend_header\n0 -0 0 55 55\n");
}

TEST_F(PlyKept, SeveralInputs_ShareOneOutputIfTheirVerticesAgree) {
  const PlyTable vertices = make_vertices({{"x"}, {"y"}, {"z"}}, 3);
  write_new(folder_ / "a.ply", build_ply({"binary_big_endian", "\n", {"comment one"}, {vertices}}));
  write_new(folder_ / "b.ply", build_ply({"binary_big_endian", "\n", {"comment two"}, {vertices}}));
  write_kept(
      folder_ / "out.ply", {folder_ / "a.ply", folder_ / "b.ply"}, kColumns, [](std::uint64_t) { return true; },
      row_of);
  const AllPoints all = read_all(folder_ / "out.ply");
  ASSERT_EQ(all.world.size(), 6U);
  EXPECT_EQ(all.world[5], all.world[2]);
  const auto difference = [&](const PlyPlan& plan) {
    write_new(folder_ / "b.ply", build_ply(plan));
    return io::ply_difference(io::InputSet({folder_ / "a.ply", folder_ / "b.ply"}).sources());
  };
  EXPECT_EQ(difference({"binary_big_endian", "\n", {}, {vertices}}), "");
  EXPECT_HAS(difference({"ascii", "\n", {}, {vertices}}), "formats binary_big_endian and ascii");
  EXPECT_HAS(difference({"binary_big_endian", "\n", {}, {make_vertices({{"x"}, {"y", "double"}, {"z"}}, 3)}}),
             "vertex property 2 is float y in one and double y");
  EXPECT_HAS(difference({"binary_big_endian", "\n", {}, {make_vertices({{"x"}, {"y"}, {"z"}, {"t"}}, 3)}}),
             "vertex property 4 is nothing in one and float t");
}

}  // namespace
}  // namespace arris::test
