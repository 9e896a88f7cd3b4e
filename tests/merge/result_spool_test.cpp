#include "merge/result_spool.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>

#include "core/columns.h"
#include "core/error.h"

namespace arris::merge {
namespace {

class TempFolder {
 public:
  TempFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "arris-merge-XXXXXX").string();
    path_ = mkdtemp(name.data());
  }
  ~TempFolder() { std::filesystem::remove_all(path_); }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

ContourRecord record(std::uint64_t id, std::uint8_t classes, std::uint32_t votes, float strength, float angle) {
  return {id, classes, votes, strength * 10.0F, strength, strength > 0.0F ? angle : 0.0F};
}

// The law: whatever the split into appends and their order, a bucket holds the combination of all records of each id.
RC_GTEST_PROP(ResultSpool, AnySplitAndOrder_GivesTheSameCombination, ()) {
  const std::uint64_t points = 2 * ResultSpool::kBucketPoints + 100;
  ContourRecords records;
  const int count = *rc::gen::inRange(0, 60);
  for (int i = 0; i < count; ++i) {
    const auto bucket = *rc::gen::inRange<std::uint64_t>(0, 3);
    records.push_back(record(bucket * ResultSpool::kBucketPoints + *rc::gen::inRange<std::uint64_t>(0, 10),
                             *rc::gen::element<std::uint8_t>(kBoundary, kWeakBoundary, kFold),
                             *rc::gen::inRange<std::uint32_t>(0, 4), static_cast<float>(*rc::gen::inRange(0, 3)),
                             static_cast<float>(*rc::gen::inRange(60, 63))));
  }
  std::map<std::uint64_t, ContourRecord> expected;
  for (const ContourRecord& r : records) {
    const auto [at, fresh] = expected.emplace(r.id, r);
    if (!fresh) combine(at->second, r);
  }
  const TempFolder folder;
  ResultSpool spool(folder.path(), points);
  ContourRecords run;
  for (const ContourRecord& r : *rc::gen::just(records)) {
    run.insert(*rc::gen::arbitrary<bool>() ? run.begin() : run.end(), r);
    if (*rc::gen::inRange(0, 5) == 0) spool.append(std::exchange(run, {}));
  }
  spool.append(run);
  PageVector<PointResult> results;
  std::size_t seen = 0;
  for (std::size_t bucket = 0; bucket < spool.buckets(); ++bucket) {
    spool.load(bucket, results);
    for (std::size_t i = 0; i < results.size(); ++i) {
      const PointResult& r = results[i];
      if (r.classes == 0) continue;
      const auto found = expected.find(bucket * ResultSpool::kBucketPoints + i);
      RC_ASSERT(found != expected.end());
      ++seen;
      RC_ASSERT(r.classes == found->second.classes);
      RC_ASSERT(r.votes == found->second.votes);
      RC_ASSERT(r.fold_strength == found->second.fold_strength);
      RC_ASSERT(r.fold_angle_deg == found->second.fold_angle_deg);
      RC_ASSERT(r.gap_deg == found->second.gap_deg);
    }
  }
  RC_ASSERT(seen == expected.size());
  RC_ASSERT(std::filesystem::is_empty(folder.path()));
}

TEST(ResultSpool, FlippedBitOnDisk_IsFoundWhenRead) {
  const TempFolder folder;
  ResultSpool spool(folder.path(), 100);
  spool.append({record(3, kFold, 2, 1.5F, 90.0F), record(4, kBoundary, 0, 0.0F, 0.0F)});
  std::fstream file(folder.path() / "0.results", std::ios::in | std::ios::out | std::ios::binary);
  file.seekp(12);
  file.put('\x55');
  file.close();
  PageVector<PointResult> results;
  EXPECT_THROW(spool.load(0, results), IoError);
}

TEST(ResultSpool, NoRecords_EveryPointIsUnlabelled) {
  const TempFolder folder;
  ResultSpool spool(folder.path(), 5);
  PageVector<PointResult> results;
  ASSERT_EQ(spool.buckets(), 1U);
  spool.load(0, results);
  EXPECT_EQ(results.size(), 5U);
  EXPECT_TRUE(std::all_of(results.begin(), results.end(), [](const PointResult& r) { return r.classes == 0; }));
  EXPECT_EQ(ResultSpool(folder.path(), 0).buckets(), 0U);
}

}  // namespace
}  // namespace arris::merge
