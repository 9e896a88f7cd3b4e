/// @file Every saved file of the fuzzers through the entry that it was saved for, in the ordinary builds.

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <vector>

#include "fuzz_entries.h"

namespace arris::test {
namespace {

class FuzzCorpus : public ::testing::TestWithParam<FuzzTarget> {};

TEST_P(FuzzCorpus, EverySavedFile_IsReadOrRefused) {
  const std::filesystem::path folder = std::filesystem::path(ARRIS_FUZZ_CORPUS) / GetParam().name;
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    SCOPED_TRACE(entry.path().filename());
    std::ifstream in(entry.path(), std::ios::binary);
    const std::vector<char> bytes{std::istreambuf_iterator<char>(in), {}};
    EXPECT_NO_THROW(GetParam().entry({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()}));
    EXPECT_LE(bytes.size(), 4096U);
    ++files;
  }
  EXPECT_GE(files, 30U);
}

INSTANTIATE_TEST_SUITE_P(All, FuzzCorpus, ::testing::ValuesIn(kFuzzTargets),
                         [](const auto& target) { return std::string(target.param.name); });

}  // namespace
}  // namespace arris::test
