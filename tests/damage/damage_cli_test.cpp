/// @file The program on every malformed file: one line and exit code 1, or a report; in little memory, nothing left
/// behind. The files are written by another program: a parent's memory counts as that of its children.

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <regex>
#include <string>

#include "damage_index.h"
#include "support/arris_process.h"
#include "support/temp_folder.h"

namespace arris::test {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kMemoryMargin = std::uint64_t{64} << 20;
#ifdef ARRIS_SANITIZED
constexpr bool kMeasuresMemory = false;  // The sanitizer's own would be counted.
#else
constexpr bool kMeasuresMemory = true;
#endif

/// Starting a program takes longer than reading its file: the quick suite takes one file in so many. (damage_tests
/// reads all of them.)
std::size_t files_per_run() {
  const char* text = std::getenv("ARRIS_DAMAGED_FILES_PER_RUN");
  return text == nullptr ? 1 : std::stoul(text);
}

void expect_one_line(const std::string& err) {
  EXPECT_EQ(std::count(err.begin(), err.end(), '\n'), 1) << err;
  static const std::regex kShape("arris: [^:]+: byte [0-9]+: .+; .+\n");
  EXPECT_TRUE(std::regex_match(err, kShape)) << err;
}

void expect_code(const ProcessResult& result, const std::string& code) {
  EXPECT_NE(result.out.find("[" + code), std::string::npos) << "no " << code << " in " << result.out;
}

class DamagedFileOnTheCommandLine : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new TempFolder;
    const char* writer = std::getenv("ARRIS_WRITE_DAMAGED_FILES");
    ASSERT_NE(writer, nullptr) << "run through ctest";
    const std::string command = "'" + std::string(writer) + "' '" + folder_->path().string() + "'";
    ASSERT_EQ(std::system(command.c_str()), 0) << command;
    std::ifstream index(*folder_ / kDamageIndex);
    DamagedFile file;
    while (read_index_line(index, file)) files_.push_back(file);
    ASSERT_GT(files_.size(), 280U);
  }
  static void TearDownTestSuite() {
    delete folder_;
    files_.clear();
  }

  /// `arris VERB OPTIONS FILE`
  ProcessResult run(std::vector<std::string> arguments, const DamagedFile& file) {
    arguments.push_back((*folder_ / file.name.c_str()).string());
    const auto start = std::chrono::steady_clock::now();
    ProcessResult result = run_arris(arguments);
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    if (seconds > slowest_s_) slowest_ = file.name;
    slowest_s_ = std::max(slowest_s_, seconds);
    if (result.peak_resident_bytes > most_bytes_) hungriest_ = file.name;
    most_bytes_ = std::max(most_bytes_, result.peak_resident_bytes);
    return result;
  }

  /// For people; no test depends on time.
  void TearDown() override {
    std::cout << "slowest run " << slowest_s_ << " s (" << slowest_ << "), most memory " << (most_bytes_ >> 20)
              << " MiB (" << hungriest_ << ")\n";
  }

  static inline TempFolder* folder_ = nullptr;
  static inline DamagedFiles files_;
  double slowest_s_ = 0.0;
  std::string slowest_;
  std::uint64_t most_bytes_ = 0;
  std::string hungriest_;
};

TEST_F(DamagedFileOnTheCommandLine, Info_RefusesInOneLineOrReports) {
  const std::uint64_t idle_bytes = run_arris({"--version"}).peak_resident_bytes;
  std::cout << "idle " << (idle_bytes >> 20) << " MiB\n";
  for (std::size_t i = 0; i < files_.size(); i += files_per_run()) {
    const DamagedFile& file = files_[i];
    SCOPED_TRACE(file.name);
    const ProcessResult result = run({"info"}, file);
    if (file.usual.verdict == Verdict::kEither) {
      EXPECT_TRUE(result.exit_code == 0 || result.exit_code == 1) << result.exit_code << " " << result.err;
    } else {
      EXPECT_EQ(result.exit_code, file.usual.verdict == Verdict::kRefused ? 1 : 0) << result.err;
    }
    if (result.exit_code == 0) {
      EXPECT_EQ(result.err, "");
    } else {
      expect_one_line(result.err);
    }
    if (file.usual.verdict == Verdict::kReported) expect_code(result, file.usual.code);
    if (kMeasuresMemory) {
      EXPECT_LT(result.peak_resident_bytes, idle_bytes + kMemoryMargin);
    }
  }
}

/// One in eight of the files of a kind; every family is longer than that.
constexpr std::size_t kSample = 8;

TEST_F(DamagedFileOnTheCommandLine, Extract_LeavesNothingBehind) {
  const TempFolder outputs;
  std::size_t refused = 0;
  for (const DamagedFile& file : files_) {
    if (file.usual.verdict != Verdict::kRefused || refused++ % kSample != 0) continue;
    SCOPED_TRACE(file.name);
    const std::string output = outputs / (file.name.starts_with("las") ? "out.las" : "out.ply");
    const ProcessResult result = run({"extract", "-q", "-o", output}, file);
    EXPECT_EQ(result.exit_code, 1) << result.err;
    expect_one_line(result.err);
    EXPECT_TRUE(fs::is_empty(outputs.path())) << *fs::directory_iterator(outputs.path());
  }
  EXPECT_GE(refused, 200U);
}

TEST_F(DamagedFileOnTheCommandLine, Strict_RefusesWhatIsReported) {
  std::size_t reported = 0;
  for (const DamagedFile& file : files_) {
    if (file.usual.verdict != Verdict::kReported || reported++ % kSample != 0) continue;
    SCOPED_TRACE(file.name);
    const ProcessResult result = run({"info", "--strict"}, file);
    EXPECT_EQ(result.exit_code, 1);
    expect_one_line(result.err);
    EXPECT_NE(result.err.find("--strict"), std::string::npos) << result.err;
  }
  EXPECT_GE(reported, 100U);
}

TEST_F(DamagedFileOnTheCommandLine, Salvage_ReadsWhatIsThere) {
  std::size_t salvaged = 0;
  for (const DamagedFile& file : files_) {
    const bool gains = file.usual.verdict == Verdict::kRefused && file.salvage.verdict == Verdict::kReported;
    if (!gains || salvaged++ % kSample != 0) continue;
    SCOPED_TRACE(file.name);
    const ProcessResult result = run({"info", "--salvage"}, file);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    expect_code(result, file.salvage.code);
    if (!file.salvage.points) continue;
    const std::string points = "points   " + std::to_string(*file.salvage.points) + "\n";
    EXPECT_NE(result.out.find(points), std::string::npos) << result.out;
  }
  EXPECT_GE(salvaged, 100U);
}

}  // namespace
}  // namespace arris::test
