#include "evaluate/evaluation_text.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>

namespace arris::evaluate {
namespace {

ContourEvaluation sample(bool with_points) {
  Truth truth;
  truth.properties["spacing"] = "0.5";
  truth.edges = {make_segment(EdgeKind::kConvex, "ridge", {0, 0, 0}, {10, 0, 0}, 90.0)};
  std::vector<PredictedPoint> points;
  if (with_points) points = {{1, 0, 0, 0xff, 1.0F}, {1, 9, 0, 0xff, 1.0F}};
  return evaluate_contours(points, truth, {});
}

TEST(EvaluationText_Json, Results_CanBeReadBack) {
  const ContourEvaluation evaluation = sample(true);
  const auto json = nlohmann::json::parse(to_json(evaluation));
  EXPECT_EQ(json["schema"], 1);
  EXPECT_EQ(json["detections"], 2);
  ASSERT_EQ(json["tolerances"].size(), evaluation.tolerances.size());
  const auto& row = json["tolerances"][1];
  EXPECT_EQ(row["tolerance_spacings"], 1.0);
  EXPECT_EQ(row["precision"], 0.5);
  EXPECT_EQ(row["recall"], *evaluation.tolerances[1].recall);
  EXPECT_EQ(row["recall_by_kind"]["convex"], *evaluation.tolerances[1].recall);
  EXPECT_TRUE(row["ceiling"].is_null());
}

TEST(EvaluationText_Json, UndefinedFigures_AreNull) {
  const auto json = nlohmann::json::parse(to_json(sample(false)));
  EXPECT_TRUE(json["tolerances"][0]["precision"].is_null());
  EXPECT_TRUE(json["hausdorff"].is_null());
}

TEST(EvaluationText_Csv, EveryLine_HasAsManyCellsAsNames) {
  std::istringstream text(to_csv(sample(true)));
  std::string line;
  std::getline(text, line);
  const auto commas = std::count(line.begin(), line.end(), ',');
  EXPECT_TRUE(line.starts_with("tolerance,tolerance_spacings,true_positives,"));
  int rows = 0;
  for (; std::getline(text, line); ++rows) EXPECT_EQ(std::count(line.begin(), line.end(), ','), commas);
  EXPECT_EQ(rows, 4);
}

TEST(EvaluationText_Table, EveryTolerance_HasALine) {
  const std::string text = to_table(sample(true));
  EXPECT_NE(text.find("precision"), std::string::npos);
  EXPECT_NE(text.find("0.5000"), std::string::npos);
  EXPECT_NE(text.find("convex"), std::string::npos);
  EXPECT_EQ(text.find("rim_convex"), std::string::npos);
  EXPECT_EQ(text.back(), '\n');
}

}  // namespace
}  // namespace arris::evaluate
