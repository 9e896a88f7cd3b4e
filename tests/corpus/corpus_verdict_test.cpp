/// @file Every real scan against the table that an independent reader made: read or refused, why, and every value.

#include <gtest/gtest.h>

#include <regex>

#include "../io/las_builder.h"
#include "core/error.h"
#include "found_values.h"
#include "io/file_summary.h"
#include "support/las_tools.h"
#include "support/shared_data.h"
#include "verdict_table.h"

namespace arris::test {
namespace {

using io::Tolerance;

/// What the message of a refusal must say, per class of error.
const std::map<std::string, std::string> kMessageParts{
    {"compressed", "LAZ"},
    {"truncated", "whole points; copy or export the file again"},
    {"no-vertex", "no element \"vertex\""},
    {"no-xyz", "no property \"z\""},
    {"ascii-token", "is not the length of a list"},
};

std::string message_of_opening(const std::filesystem::path& path, Tolerance tolerance) {
  try {
    find_values(*io::open_point_source(path, tolerance));
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

/// "<path>: byte <N>: <what>; <what to do>", on one line, with a byte that the file has.
void expect_shape(const std::string& message, const std::filesystem::path& path) {
  const std::string start = path.string() + ": byte ";
  ASSERT_TRUE(message.starts_with(start)) << message;
  std::smatch match;
  const std::string rest = message.substr(start.size());
  ASSERT_TRUE(std::regex_match(rest, match, std::regex("([0-9]+): ([^;\n]+)(; [^\n]+)"))) << message;
  EXPECT_LE(std::stoull(match[1]), std::filesystem::file_size(path)) << message;
}

void expect_near_sum(const std::string& expected, long double found, long double scale) {
  EXPECT_NEAR(static_cast<double>(std::strtold(expected.c_str(), nullptr) - found), 0.0,
              2.3e-16 * static_cast<double>(scale))
      << expected;
}

void expect_values(const Verdict& verdict, const FoundValues& found) {
  EXPECT_EQ(found.count, verdict.count);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (verdict.is_las()) {
      EXPECT_EQ(std::to_string(static_cast<long long>(found.sums[axis])), verdict.sums[axis]);
    } else {
      expect_near_sum(verdict.sums[axis], found.sums[axis], found.absolute[axis]);
    }
    EXPECT_EQ(found.min[axis] <= found.max[axis], verdict.has_extent);
    if (!verdict.has_extent) continue;
    EXPECT_EQ(found.min[axis], verdict.min[axis]);
    EXPECT_EQ(found.max[axis], verdict.max[axis]);
  }
  EXPECT_EQ(found.digest, std::stoull(verdict.digest, nullptr, 16));
}

void expect_attribute(const std::string& expected, const std::optional<long double>& found) {
  EXPECT_EQ(found.has_value(), !expected.empty());
  if (found) expect_near_sum(expected, *found, std::abs(*found) + 1.0L);
}

std::set<std::string> codes_of(const std::vector<io::Problem>& problems) {
  std::set<std::string> codes;
  for (const io::Problem& problem : problems) codes.insert(problem.code);
  return codes;
}

/// Elements behind the vertices of an ascii file are not read: its problem stays unseen.
const std::set<std::string> kUnseenBehindVertices{"mikedh+trimesh/models/fuze_ascii.ply"};

std::set<std::string> expected_codes(const Verdict& verdict) {
  return kUnseenBehindVertices.contains(verdict.path) ? std::set<std::string>{} : verdict.problems;
}

class CorpusVerdict : public ::testing::TestWithParam<Verdict> {
 protected:
  void SetUp() override {
    const auto path = shared_data(GetParam().path.c_str());
    if (!path) GTEST_SKIP() << "shared data is not here: " << GetParam().path;
    path_ = *path;
  }
  std::filesystem::path path_;
};

class CorpusReadFile : public CorpusVerdict {};
class CorpusRefusedFile : public CorpusVerdict {};
class CorpusLasFile : public CorpusVerdict {};

template <class Takes>
std::vector<Verdict> verdicts_where(const Takes& takes) {
  std::vector<Verdict> verdicts = load_verdicts();
  std::erase_if(verdicts, [&](const Verdict& verdict) { return !takes(verdict); });
  return verdicts;
}

TEST_P(CorpusReadFile, HasTheValuesOfTheTable) {
  const Verdict& verdict = GetParam();
  const auto source = io::open_point_source(path_);
  EXPECT_EQ(source->info().points, verdict.count);
  const FoundValues found = find_values(*source);
  expect_values(verdict, found);
  expect_attribute(verdict.intensity, found.intensity);
  expect_attribute(verdict.red, found.red);
  EXPECT_EQ(codes_of(source->info().problems), expected_codes(verdict));
  EXPECT_EQ(io::summarize_file(path_).info.points, verdict.count);
}

TEST_P(CorpusRefusedFile, SaysWhy) {
  const Verdict& verdict = GetParam();
  const std::string message = message_of_opening(path_, Tolerance::kUsual);
  ASSERT_FALSE(message.empty()) << "was read";
  ASSERT_TRUE(kMessageParts.contains(verdict.error)) << verdict.error;
  EXPECT_NE(message.find(kMessageParts.at(verdict.error)), std::string::npos) << message;
  expect_shape(message, path_);
}

TEST_P(CorpusVerdict, Strict_RefusesWhatHasProblems) {
  const Verdict& verdict = GetParam();
  const std::string message = message_of_opening(path_, Tolerance::kStrict);
  EXPECT_EQ(message.empty(), verdict.read && expected_codes(verdict).empty()) << message;
  if (!message.empty()) expect_shape(message, path_);
}

TEST_P(CorpusVerdict, Salvage_ReadsTheWholePointsThatAreThere) {
  const Verdict& verdict = GetParam();
  if (!verdict.has_points()) {
    EXPECT_FALSE(message_of_opening(path_, Tolerance::kSalvage).empty());
    return;
  }
  const auto source = io::open_point_source(path_, Tolerance::kSalvage);
  EXPECT_EQ(source->info().points, verdict.count);
  expect_values(verdict, find_values(*source));
  std::set<std::string> codes = expected_codes(verdict);
  if (!verdict.read) codes.insert("points-lost");
  EXPECT_EQ(codes_of(source->info().problems), codes);
}

/// The VLRs of this file run into its points, which the small reader does not forgive.
constexpr const char* kBeyondSecondReader = "PDAL+PDAL/test/data/las/bad_vlr_count.las";

TEST_P(CorpusLasFile, Records_EqualThoseOfTheSecondReader) {
  const FoundValues found = find_values(*io::open_point_source(path_));
  std::string expected;
  for (const std::string& record : read_parts(file_bytes(path_)).records) expected += record;
  EXPECT_EQ(found.records.size(), expected.size());
  EXPECT_TRUE(found.records == expected);
}

const auto kNameOf = [](const auto& file) { return test_name(file.param, file.index); };
INSTANTIATE_TEST_SUITE_P(Corpus, CorpusVerdict, ::testing::ValuesIn(load_verdicts()), kNameOf);
INSTANTIATE_TEST_SUITE_P(Corpus, CorpusReadFile,
                         ::testing::ValuesIn(verdicts_where([](const Verdict& v) { return v.read; })), kNameOf);
INSTANTIATE_TEST_SUITE_P(Corpus, CorpusRefusedFile,
                         ::testing::ValuesIn(verdicts_where([](const Verdict& v) { return !v.read; })), kNameOf);
INSTANTIATE_TEST_SUITE_P(Corpus, CorpusLasFile, ::testing::ValuesIn(verdicts_where([](const Verdict& v) {
                           return v.read && v.is_las() && v.path != kBeyondSecondReader;
                         })),
                         kNameOf);

TEST(CorpusTable, FilesOfTheFolder_AreThoseOfTheTable) {
  ARRIS_SHARED_DATA_OR_SKIP(index, "INDEX.md");
  const std::filesystem::path folder = index.parent_path();
  std::set<std::string> there;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    std::string extension = entry.path().extension().string();
    for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    if (!entry.is_regular_file() || (extension != ".las" && extension != ".ply" && extension != ".laz")) continue;
    there.insert(std::filesystem::relative(entry.path(), folder).generic_string());
  }
  std::set<std::string> listed;
  for (const Verdict& verdict : load_verdicts()) listed.insert(verdict.path);
  EXPECT_EQ(there, listed);
}

TEST(CorpusTable, Crs_IsFound) {
  ARRIS_SHARED_DATA_OR_SKIP(wkt, "laspy+laspy/tests/data/1_4_w_evlr.las");
  EXPECT_FALSE(io::summarize_file(wkt).crs.name.empty());
  ARRIS_SHARED_DATA_OR_SKIP(keys, "IGNF+ctview/data/las/test_data_0000_0000_LA93_IGN69_ground.las");
  EXPECT_NE(io::summarize_file(keys).crs.name.find("93"), std::string::npos);
}

}  // namespace
}  // namespace arris::test
