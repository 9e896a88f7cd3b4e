#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>
#include <unistd.h>

#include <bit>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "core/error.h"
#include "evaluate/truth.h"
#include "random_edges.h"

namespace arris::evaluate {
namespace {

constexpr const char* kHead = "# arris truth 1\n# spacing=0.25\n";
constexpr const char* kColumns = "kind,role,shape,angle_deg,x0,y0,z0,x1,y1,z1,x2,y2,z2,sweep_deg\n";

Truth parse(const std::string& text) {
  std::istringstream in(text);
  return read_truth_csv(in, "truth.csv");
}

std::string complaint(const std::string& text) {
  try {
    parse(text);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

RC_GTEST_PROP(TruthCsv_WriteThenRead, AnyTruth_IsTheSameToTheLastBit, ()) {
  Truth truth;
  truth.edges = *rc::gen::container<std::vector<TruthEdge>>(any_edge());
  // Coordinates with all 53 bits in use, of any size.
  for (TruthEdge& edge : truth.edges) {
    const double wild = *rc::gen::map(rc::gen::arbitrary<std::uint64_t>(), [](std::uint64_t bits) {
      const double value = std::bit_cast<double>(bits);
      return std::isfinite(value) && std::abs(value) < 1e150 ? value : 1.0 / 3.0;
    });
    edge.a.x = wild;
  }
  truth.properties = {{"scene", "block"}, {"spacing", exact_text(0.1)}};
  std::ostringstream out;
  write_truth_csv(out, truth);
  RC_ASSERT(parse(out.str()) == truth);
}

TEST(TruthCsv_Read, WindowsLineEndsBlankLinesAndMissingFinalNewline_AreAccepted) {
  const Truth truth = parse(
      "# arris truth 1\r\n# scene=a=b\r\n\r\n"
      "kind,role,shape,angle_deg,x0,y0,z0,x1,y1,z1,x2,y2,z2,sweep_deg\r\nconvex,ridge,segment,90,0,0,0,1,0,0,0,0,0,0");
  ASSERT_EQ(truth.edges.size(), 1U);
  EXPECT_EQ(truth.edges[0].role, "ridge");
  EXPECT_EQ(truth.properties.at("scene"), "a=b");
}

TEST(TruthCsv_Read, DamagedLine_IsNamedWithItsNumber) {
  const std::string good = "convex,box,segment,90,0,0,0,1,0,0,0,0,0,0\n";
  for (const std::string bad :
       {"bent,box,segment,90,0,0,0,1,0,0,0,0,0,0", "convex,b x,segment,90,0,0,0,1,0,0,0,0,0,0",
        "convex,box,spline,90,0,0,0,1,0,0,0,0,0,0", "convex,box,segment,90,0,0,0,1,0,0,0,0,0",
        "convex,box,segment,90,0,0,0,1,0,0,0,0,0,0,0", "convex,box,segment,90,0,0,nan,1,0,0,0,0,0,0",
        "convex,box,segment,90,0,0,inf,1,0,0,0,0,0,0", "convex,box,segment,90,0,0,,1,0,0,0,0,0,0",
        "convex,box,segment,90,0,0,1x,1,0,0,0,0,0,0", "convex,box,segment,90,-1e308,0,0,1e308,0,0,0,0,0,0",
        "rim_convex,rim,arc,90,0,0,0,0,0,2,1,0,0,360", "rim_convex,rim,arc,90,0,0,0,0,0,1,0,0,0,360",
        "rim_convex,rim,arc,90,0,0,0,0,0,1,1,0,1,360", "rim_convex,rim,arc,90,0,0,0,0,0,1,1,0,0,361",
        "rim_convex,rim,arc,90,0,0,0,0,0,1,1,0,0,0"}) {
    const std::string text = complaint(kHead + std::string(kColumns) + good + bad + "\n");
    EXPECT_NE(text.find("truth.csv, line 5"), std::string::npos) << bad << " gave: " << text;
  }
}

TEST(TruthCsv_Spacing, Columns_AreWrittenIfNeededAndReadBack) {
  Truth truth;
  truth.edges = {make_segment(EdgeKind::kConvex, "a", {0, 0, 0}, {1, 0, 0}, 90.0)};
  std::ostringstream without, with;
  write_truth_csv(without, truth);
  EXPECT_EQ(without.str().find("spacing"), std::string::npos);
  truth.edges.push_back(truth.edges[0]);
  truth.edges[1].spacing = 0.1;
  truth.edges[1].spacing_max = 0.3;
  write_truth_csv(with, truth);
  EXPECT_EQ(parse(with.str()), truth);
  const std::string head = kHead + std::string(kColumns);
  const std::string wide = head.substr(0, head.size() - 1) + ",spacing,spacing_max\n";
  EXPECT_NE(complaint(wide + "convex,box,segment,90,0,0,0,1,0,0,0,0,0,0\n").find("16 fields"), std::string::npos);
  EXPECT_NE(complaint(wide + "convex,box,segment,90,0,0,0,1,0,0,0,0,0,0,-1,0\n").find("line 4"), std::string::npos);
}

TEST(TruthCsv_Read, OtherOrCutFiles_AreRefused) {
  EXPECT_NE(complaint(""), "");
  EXPECT_NE(complaint("x,y,z\n1,2,3\n"), "");
  EXPECT_NE(complaint(kHead), "");
  EXPECT_NE(complaint(std::string("# arris truth 1\n") + std::string(100000, 'x')), "");
}

TEST(TruthCsv_Number, MissingOrUselessProperty_GivesTheDefault) {
  Truth truth;
  truth.properties = {{"spacing", "0.25"}, {"noise", "-1"}, {"seed", "x"}};
  EXPECT_EQ(truth.number("spacing", 9.0), 0.25);
  EXPECT_EQ(truth.number("noise", 9.0), 9.0);
  EXPECT_EQ(truth.number("seed", 9.0), 9.0);
  EXPECT_EQ(truth.number("absent", 9.0), 9.0);
}

TEST(TruthCsv_File, ExistingFile_IsKeptUnlessOverwritingIsAllowed) {
  const auto path = std::filesystem::temp_directory_path() / ("arris-truth-" + std::to_string(getpid()) + ".csv");
  Truth truth;
  truth.edges = {make_segment(EdgeKind::kConvex, "a", {0, 0, 0}, {1, 0, 0}, 90.0)};
  write_truth_csv(path, truth, false);
  EXPECT_EQ(read_truth_csv(path), truth);
  Truth other;
  EXPECT_THROW(write_truth_csv(path, other, false), ConfigError);
  EXPECT_EQ(read_truth_csv(path), truth);
  write_truth_csv(path, other, true);
  EXPECT_EQ(read_truth_csv(path), other);
  EXPECT_FALSE(std::filesystem::exists(path.string() + ".partial"));
  std::filesystem::remove(path);
}

TEST(TruthCsv_File, FileThatCannotBeOpened_IsAnIoErrorThatNamesIt) {
  EXPECT_THROW(read_truth_csv("/nonexistent/truth.csv"), IoError);
  EXPECT_THROW(write_truth_csv("/nonexistent/truth.csv", Truth{}, true), IoError);
}

}  // namespace
}  // namespace arris::evaluate
