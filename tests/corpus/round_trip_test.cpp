/// @file Every real scan through the real program with all points kept: without our columns, the output is the input.

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "../io/las_builder.h"
#include "strip.h"
#include "support/arris_process.h"
#include "support/las_tools.h"
#include "support/shared_data.h"
#include "support/temp_folder.h"
#include "verdict_table.h"

namespace arris::test {
namespace {

constexpr std::uintmax_t kSmallBytes = 300'000;

class RoundTrip : public ::testing::TestWithParam<Verdict> {
 protected:
  void SetUp() override {
    const auto path = shared_data(GetParam().path.c_str());
    if (!path) GTEST_SKIP() << "shared data is not here: " << GetParam().path;
    input_ = file_bytes(*path);
    const std::string output = folder_ / (GetParam().is_las() ? "out.las" : "out.ply");
    std::vector<std::string> arguments{"extract",   path->string(), "--keep-all", "--no-boundary",
                                       "--no-fold", "-q",           "-o",         output};
    if (!GetParam().read) arguments.emplace_back("--salvage");
    const ProcessResult run = run_arris(arguments);
    ASSERT_EQ(run.exit_code, 0) << run.err;
    output_ = file_bytes(output);
  }
  TempFolder folder_;
  std::string input_;
  std::string output_;
};

/// Exactly the fields that contradict the points differ, and hold what the table says.
void expect_only_wrong_fields(const Verdict& verdict, const std::string& input, const std::string& stripped) {
  std::set<std::string> expected;
  for (const auto& [field, value] : verdict.wrong_fields) {
    expected.insert(field);
    EXPECT_EQ(field_value(stripped, field), value) << field;
  }
  EXPECT_EQ(differing_fields(input, stripped), expected);
}

using LasRoundTrip = RoundTrip;

TEST_P(LasRoundTrip, StrippedOutput_EqualsTheInput) {
  const std::string stripped = strip_las(output_, extract_columns());
  if (GetParam().read) return expect_only_wrong_fields(GetParam(), input_, stripped);
  // Salvaged: the whole records that are there; what is left of the next one belongs to no point.
  const std::size_t points_at = get<std::uint32_t>(input_, 96);
  const std::size_t whole = points_at + GetParam().count * get<std::uint16_t>(input_, 105);
  ASSERT_GE(stripped.size(), whole);
  EXPECT_EQ(input_.size() - whole,
            input_.size() > whole ? (input_.size() - points_at) % get<std::uint16_t>(input_, 105) : 0U);
  expect_only_wrong_fields(GetParam(), input_.substr(0, whole), stripped.substr(0, whole));
}

using PlyRoundTrip = RoundTrip;

/// Before the first element, a line that begins with no keyword of PLY is a comment that broke.
std::vector<std::string> mended(std::vector<std::string> header) {
  for (std::string& line : header) {
    const std::string word = line.substr(0, line.find(' '));
    if (word == "element") break;
    if (word != "ply" && word != "format" && word != "comment" && word != "obj_info") line.insert(0, "comment ");
  }
  return header;
}

TEST_P(PlyRoundTrip, StrippedOutput_EqualsTheInput) {
  const PlyParts input = split_ply(input_);
  const PlyParts stripped = strip_ply(output_, extract_columns());
  const bool broken_comment = GetParam().problems.contains("ply-keyword");
  EXPECT_EQ(stripped.header, broken_comment ? mended(input.header) : input.header);
  EXPECT_EQ(stripped.line_end, input.line_end);
  EXPECT_EQ(stripped.ascii, input.ascii);
  EXPECT_TRUE(stripped.tokens == input.tokens) << stripped.tokens.size() << " tokens of " << input.tokens.size();
  EXPECT_TRUE(stripped.body == input.body) << stripped.body.size() << " bytes of " << input.body.size();
}

std::vector<Verdict> chosen(bool las, bool small) {
  std::vector<Verdict> chosen;
  for (const Verdict& verdict : load_verdicts()) {
    const auto path = shared_data(verdict.path.c_str());
    const bool is_small = !path || std::filesystem::file_size(*path) < kSmallBytes;
    // A file without a single whole point has nothing to go round.
    const bool wanted = verdict.read || (verdict.has_points() && verdict.count > 0);
    if (wanted && verdict.is_las() == las && is_small == small) chosen.push_back(verdict);
  }
  return chosen;
}

std::string name_of(const ::testing::TestParamInfo<Verdict>& file) {
  return test_name(file.param, file.index);
}

INSTANTIATE_TEST_SUITE_P(Small, LasRoundTrip, ::testing::ValuesIn(chosen(true, true)), name_of);
INSTANTIATE_TEST_SUITE_P(Large, LasRoundTrip, ::testing::ValuesIn(chosen(true, false)), name_of);
INSTANTIATE_TEST_SUITE_P(Small, PlyRoundTrip, ::testing::ValuesIn(chosen(false, true)), name_of);
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(LasRoundTrip);

}  // namespace
}  // namespace arris::test
