/// @file Every third point of every real scan through the writer: the records are those of the input, our value behind.

#include <gtest/gtest.h>

#include "../io/io_helpers.h"
#include "../io/las_builder.h"
#include "support/shared_data.h"
#include "verdict_table.h"

namespace arris::test {
namespace {

constexpr std::size_t kBatchPoints = 50000;

class KeptSubset : public ::testing::TestWithParam<Verdict> {
 protected:
  void SetUp() override {
    const auto path = shared_data(GetParam().path.c_str());
    if (!path) GTEST_SKIP() << "shared data is not here: " << GetParam().path;
    input_ = *path;
    output_ = folder_ / (GetParam().is_las() ? "out.las" : "out.ply");
    write_kept(
        output_, {input_}, {{"Ours", ColumnType::kUint8, ""}}, [](std::uint64_t id) { return id % 3 == 0; },
        [](std::uint64_t id) { return std::string(1, value_of(id)); }, kBatchPoints);
  }

  static char value_of(std::uint64_t id) { return static_cast<char>('!' + id % 90); }
  /// A record with our value, as the format of the file writes it.
  std::string with_value(const std::string& record, std::uint64_t id) const {
    if (GetParam().format != "PLY ascii") return record + value_of(id);
    return record + " " + std::to_string(static_cast<int>(value_of(id)));
  }

  TempFolder folder_;
  std::filesystem::path input_;
  std::filesystem::path output_;
};

TEST_P(KeptSubset, Records_EqualTheInputs) {
  const AllPoints in = read_all(input_, true, kBatchPoints);
  const AllPoints kept = read_all(output_, true, kBatchPoints);
  ASSERT_EQ(kept.records.size(), (in.records.size() + 2) / 3);
  for (std::size_t i = 0; i < kept.records.size(); ++i) {
    ASSERT_EQ(kept.records[i], with_value(in.records[3 * i], 3 * i)) << 3 * i;
  }
  if (!GetParam().is_las() || !GetParam().problems.empty()) return;
  const LasParts before = read_parts(file_bytes(input_));
  const LasParts after = read_parts(file_bytes(output_));
  EXPECT_EQ(before.gap, after.gap);
  ASSERT_EQ(before.evlrs.size(), after.evlrs.size());
  for (std::size_t i = 0; i < before.evlrs.size(); ++i) EXPECT_EQ(before.evlrs[i].payload, after.evlrs[i].payload);
}

std::vector<Verdict> readable() {
  std::vector<Verdict> readable;
  for (const Verdict& verdict : load_verdicts()) {
    if (verdict.read) readable.push_back(verdict);
  }
  return readable;
}

INSTANTIATE_TEST_SUITE_P(Corpus, KeptSubset, ::testing::ValuesIn(readable()),
                         [](const auto& file) { return test_name(file.param, file.index); });

}  // namespace
}  // namespace arris::test
