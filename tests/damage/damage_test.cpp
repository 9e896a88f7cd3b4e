/// @file Every malformed file is read or refused as stated, under all tolerances, and what is said of it has its shape.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <iostream>
#include <map>
#include <regex>
#include <set>
#include <string_view>

#include "damaged_file.h"
#include "io/io_helpers.h"
#include "observe.h"

namespace arris::test {
namespace {

using io::Tolerance;

const char* name_of(Tolerance tolerance) {
  return tolerance == Tolerance::kStrict ? "strict" : tolerance == Tolerance::kUsual ? "usual" : "salvage";
}

Expectation expected_of(const DamagedFile& file, Tolerance tolerance) {
  return tolerance == Tolerance::kStrict ? file.strict() : tolerance == Tolerance::kUsual ? file.usual : file.salvage;
}

bool is_printable(std::string_view text) {
  return std::all_of(text.begin(), text.end(), [](char c) { return c >= 0x20 && c <= 0x7e; });
}

/// "NAME: byte N: what; what to do", with N in the file or a number that the file states and the message repeats.
void expect_shape(const DamagedFile& file, const std::string& message) {
  EXPECT_TRUE(is_printable(message)) << message;
  EXPECT_LT(message.size(), 1000U);
  static const std::regex kShape(R"(([^:]+): byte ([0-9]+): ([^ ].*[^ ]); ([^ ].*[^ ;]))");
  std::smatch parts;
  ASSERT_TRUE(std::regex_match(message, parts, kShape)) << message;
  EXPECT_EQ(parts[1], file.name);
  const std::uint64_t byte = std::stoull(parts[2]);
  const bool stated = parts[3].str().find(parts[2]) != std::string::npos;
  EXPECT_TRUE(byte <= file.bytes.size() || stated) << message;
  if (file.byte && file.usual.verdict == Verdict::kRefused) {
    EXPECT_EQ(byte, *file.byte) << message;
  }
}

void expect_problems_have_their_shape(const std::vector<io::Problem>& problems, const DamagedFile& file) {
  for (const io::Problem& problem : problems) {
    EXPECT_TRUE(is_printable(problem.text) && !problem.text.empty()) << problem.text;
    EXPECT_TRUE(!problem.code.empty() &&
                problem.code.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789-") == std::string::npos)
        << problem.code;
    const bool stated = problem.text.find(std::to_string(problem.byte)) != std::string::npos;
    EXPECT_TRUE(problem.byte <= file.bytes.size() || stated) << problem.text;
  }
}

std::string codes(const Observed& observed) {
  std::string all;
  for (const io::Problem& problem : observed.problems) all += problem.code + " ";
  return all;
}

void expect_verdict(const Expectation& expected, const Observed& observed) {
  switch (expected.verdict) {
    case Verdict::kRefused:
      EXPECT_TRUE(observed.refused) << "read, with " << observed.points << " points; problems: " << codes(observed);
      return;
    case Verdict::kReported:
      ASSERT_FALSE(observed.refused) << observed.message;
      EXPECT_NE(codes(observed).find(expected.code + " "), std::string::npos)
          << "expected " << expected.code << ", got " << codes(observed);
      break;
    case Verdict::kRead:
      ASSERT_FALSE(observed.refused) << observed.message;
      EXPECT_EQ(codes(observed), "");
      break;
    case Verdict::kEither:
      break;
  }
  if (expected.points) {
    EXPECT_EQ(observed.points, *expected.points);
  }
}

void expect_consistent(const DamagedFile& file, const Observed& observed) {
  EXPECT_TRUE(observed.contradictions.empty()) << observed.contradictions.front();
  EXPECT_LE(observed.points, file.bytes.size());
  if (observed.refused) expect_shape(file, observed.message);
  expect_problems_have_their_shape(observed.problems, file);
  expect_problems_have_their_shape(observed.point_problems, file);
}

TEST(DamagedFile, UnderEveryTolerance_IsReadOrRefusedAsStated) {
  for (const DamagedFile& file : damaged_files()) {
    const auto input = in_memory(file.name, file.bytes);
    for (const Tolerance tolerance : {Tolerance::kStrict, Tolerance::kUsual, Tolerance::kSalvage}) {
      SCOPED_TRACE(file.name + ", " + name_of(tolerance));
      const Observed observed = observe(input, tolerance);
      expect_consistent(file, observed);
      expect_verdict(expected_of(file, tolerance), observed);
    }
  }
}

/// A laxer tolerance never refuses what a stricter one reads, nor delivers fewer points of it.
TEST(DamagedFile, LaxerTolerance_ReadsNoLess) {
  for (const DamagedFile& file : damaged_files()) {
    SCOPED_TRACE(file.name);
    const auto input = in_memory(file.name, file.bytes);
    const Observed strict = observe(input, Tolerance::kStrict);
    const Observed usual = observe(input, Tolerance::kUsual);
    const Observed salvage = observe(input, Tolerance::kSalvage);
    EXPECT_EQ(strict.refused, usual.refused || !usual.problems.empty());
    if (!usual.refused) {
      EXPECT_FALSE(salvage.refused) << salvage.message;
    }
    if (!strict.refused) {
      EXPECT_EQ(strict.points, usual.points);
    }
    if (!usual.refused) {
      EXPECT_GE(salvage.points, usual.points);
    }
  }
}

TEST(DamagedFile, OnDisk_IsTreatedAsInMemory) {
  const TempFolder folder;
  for (const DamagedFile& file : damaged_files()) {
    SCOPED_TRACE(file.name);
    const Observed memory = observe(in_memory(file.name, file.bytes), Tolerance::kUsual);
    write_new(folder / file.name.c_str(), file.bytes);
    const Observed disk = observe_set(folder / file.name.c_str(), Tolerance::kUsual);
    std::filesystem::remove(folder / file.name.c_str());
    EXPECT_EQ(disk.refused, memory.refused) << disk.message << memory.message;
    if (memory.refused) {
      EXPECT_EQ(disk.message, folder.path().string() + "/" + memory.message);
    } else {
      EXPECT_EQ(disk.points, memory.points);
    }
  }
}

TEST(DamagedFile, Catalogue_HasNoDoublesAndCoversBothFormats) {
  std::set<std::string> names;
  std::map<std::string, int> stated;
  for (const DamagedFile& file : damaged_files()) {
    EXPECT_TRUE(names.insert(file.name).second) << file.name;
    if (file.usual.verdict != Verdict::kEither) ++stated[file.name.substr(0, 3)];
  }
  EXPECT_GE(stated["las"], 170);
  EXPECT_GE(stated["ply"], 110);
  std::cout << names.size() << " files; with a stated verdict " << stated["las"] << " LAS, " << stated["ply"]
            << " PLY\n";
}

}  // namespace
}  // namespace arris::test
