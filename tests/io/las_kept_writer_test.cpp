#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <limits>
#include <numeric>

#include "../corpus/strip.h"
#include "io/las_sharing.h"
#include "io_helpers.h"
#include "las_builder.h"
#include "random_las.h"

namespace arris::test {
namespace {

const std::vector<ColumnSpec> kColumns{{"EdgeClass", ColumnType::kUint8, "kinds of contour"},
                                       {"EdgeScore", ColumnType::kFloat32, "0 to 1"},
                                       {"SegmentId", ColumnType::kUint32, ""},
                                       {"Votes", ColumnType::kUint16, ""}};
constexpr std::size_t kRowBytes = 11;

std::string row_of(std::uint64_t id) {
  std::string row(kRowBytes, '\0');
  for (std::size_t i = 0; i < kRowBytes; ++i) row[i] = static_cast<char>(id * 31 + i);
  return row;
}

/// Extra-bytes entries of all records in their order: (type, options, name) and offset behind the point format.
struct Entry {
  int type;
  std::string name;
  std::size_t offset;
  std::size_t size;
};
std::vector<Entry> entries_of(const LasParts& parts) {
  constexpr std::array<std::size_t, 11> kSizes{0, 1, 1, 2, 2, 4, 4, 8, 8, 4, 8};
  std::vector<Entry> entries;
  std::size_t offset = kFormatBytes[static_cast<std::size_t>(parts.format)];
  for (const auto* records : {&parts.vlrs, &parts.evlrs}) {
    for (const TestVlr& vlr : *records) {
      if (vlr.user != "LASF_Spec" || vlr.id != 4) continue;
      for (std::size_t at = 0; at + 192 <= vlr.payload.size(); at += 192) {
        const int type = static_cast<unsigned char>(vlr.payload[at + 2]);
        const std::size_t size = type == 0   ? static_cast<unsigned char>(vlr.payload[at + 3])
                                 : type > 10 ? kSizes[static_cast<std::size_t>(type - 1) % 10 + 1] *
                                                   static_cast<std::size_t>((type - 1) / 10 + 1)
                                             : kSizes[static_cast<std::size_t>(type)];
        entries.push_back(
            {type, std::string(vlr.payload.c_str() + at + 4, strnlen(vlr.payload.c_str() + at + 4, 32)), offset, size});
        offset += size;
      }
    }
  }
  return entries;
}

/// Our columns must be described right where their bytes are.
void expect_columns_described(const LasParts& parts, std::size_t original_bytes,
                              const std::vector<std::string>& names) {
  const std::vector<Entry> entries = entries_of(parts);
  ASSERT_GE(entries.size(), names.size());
  std::size_t offset = original_bytes;
  const std::vector<int> types{1, 9, 5, 3};
  for (std::size_t i = 0; i < names.size(); ++i) {
    const Entry& entry = entries[entries.size() - names.size() + i];
    EXPECT_EQ(entry.name, names[i]);
    EXPECT_EQ(entry.type, types[i]);
    EXPECT_EQ(entry.offset, offset);
    offset += entry.size;
  }
  EXPECT_EQ(offset, parts.record_bytes);
}
void expect_columns_described(const LasParts& parts, std::size_t original_bytes) {
  expect_columns_described(parts, original_bytes, {"EdgeClass", "EdgeScore", "SegmentId", "Votes"});
}

class LasKept : public ::testing::Test {
 protected:
  /// Writes the kept points of one file and reads the output with the second reader.
  LasParts keep(
      const std::string& bytes,
      const std::function<bool(std::uint64_t)>& kept = [](std::uint64_t id) { return id % 3 != 1; }) {
    write_new(folder_ / "in.las", bytes);
    std::filesystem::remove(folder_ / "out.las");
    warnings_ = write_kept(folder_ / "out.las", {folder_ / "in.las"}, kColumns, kept, row_of);
    return read_parts(file_bytes(folder_ / "out.las"));
  }
  TempFolder folder_;
  std::vector<std::string> warnings_;
};

void expect_same_vlr(const TestVlr& a, const TestVlr& b) {
  EXPECT_EQ(a.user, b.user);
  EXPECT_EQ(a.id, b.id);
  EXPECT_EQ(a.payload, b.payload);
  EXPECT_EQ(a.description, b.description);
}

RC_GTEST_FIXTURE_PROP(LasKept, StrippedOfOurColumns_RecordsEqualTheInputs, ()) {
  const LasPlan plan = random_plan();
  const auto mask = *rc::gen::container<std::vector<bool>>(plan.points.size(), rc::gen::arbitrary<bool>());
  const LasParts parts = keep(build_las(plan), [&](std::uint64_t id) { return mask[id]; });
  std::size_t next = 0;
  for (std::size_t i = 0; i < plan.points.size(); ++i) {
    if (!mask[i]) continue;
    RC_ASSERT(next < parts.records.size());
    RC_ASSERT(parts.records[next].substr(0, plan.record_bytes) == plan.points[i]);
    RC_ASSERT(parts.records[next].substr(plan.record_bytes) == row_of(i));
    ++next;
  }
  RC_ASSERT(next == parts.records.size());
  RC_ASSERT(parts.minor == plan.minor && parts.format == plan.format);
  RC_ASSERT(parts.gap == plan.gap);
  RC_ASSERT(parts.header_bytes == kHeaderBytes[static_cast<std::size_t>(plan.minor)] + plan.header_padding);
  // Every other record is still there, in order.
  std::size_t at = 0;
  for (const TestVlr& vlr : plan.vlrs) {
    RC_ASSERT(at < parts.vlrs.size());
    if (vlr.user != "LASF_Spec") expect_same_vlr(vlr, parts.vlrs[at]);
    if (vlr.user == "LASF_Spec") RC_ASSERT(parts.vlrs[at].payload.starts_with(vlr.payload));
    ++at;
  }
  RC_ASSERT(parts.evlrs.size() == plan.evlrs.size());
  for (std::size_t i = 0; i < plan.evlrs.size(); ++i) RC_ASSERT(parts.evlrs[i].payload == plan.evlrs[i].payload);
  expect_columns_described(parts, plan.record_bytes);
  // The library reads its own output, without complaint about extra bytes.
  const auto source = io::open_point_source(folder_ / "out.las");
  RC_ASSERT(source->info().points == next);
}

RC_GTEST_FIXTURE_PROP(LasKept, EveryPointKeptOfATrueFile_StrippedEqualsTheInput, ()) {
  LasPlan plan = random_plan();
  if (*rc::gen::arbitrary<bool>()) plan.scale = {-0.5, 1e-7, 1.0};
  const std::string in = random_true_las(plan);
  keep(in, [](std::uint64_t) { return true; });
  const std::string out = file_bytes(folder_ / "out.las");
  const std::string stripped = strip_las(out, {{"EdgeClass", 1}, {"EdgeScore", 4}, {"SegmentId", 4}, {"Votes", 2}});
  RC_ASSERT(differing_fields(in, stripped) == std::set<std::string>{});
}

TEST_F(LasKept, WrongHeaderFields_AreCorrectedAlone) {
  for (const int minor : {1, 2, 3, 4, 5}) {
    for (int format = 0; format <= 10; ++format) {
      LasPlan plan;
      plan.minor = minor;
      plan.format = format;
      plan.record_bytes = kFormatBytes[static_cast<std::size_t>(format)];
      plan.points = make_records(20, plan.record_bytes, static_cast<unsigned>(format + 1));
      // Its header counts no returns and has no bounds.
      const std::string in = build_las(plan);
      keep(in, [](std::uint64_t) { return true; });
      const std::string stripped = strip_las(file_bytes(folder_ / "out.las"),
                                             {{"EdgeClass", 1}, {"EdgeScore", 4}, {"SegmentId", 4}, {"Votes", 2}});
      std::set<std::string> expected{"min-x", "max-x", "min-y", "max-y", "min-z", "max-z"};
      if (minor >= 4) expected.insert("by-return");
      if (minor < 4 || format < 6) expected.insert("legacy-by-return");
      EXPECT_EQ(differing_fields(in, stripped), expected) << minor << " " << format;
    }
  }
}

TEST_F(LasKept, HeaderFields_AreKeptExceptCountsAndBounds) {
  LasPlan plan;
  plan.minor = 4;
  plan.format = 7;
  plan.record_bytes = 36;
  plan.header_padding = 3;
  plan.points = make_records(20, 36);
  const std::string in = build_las(plan);
  keep(in);
  const std::string out = file_bytes(folder_ / "out.las");
  for (std::size_t at = 0; at < 378; ++at) {
    const bool changes =
        (at >= 96 && at < 104) || (at >= 105 && at < 131) || (at >= 179 && at < 227) || (at >= 235 && at < 375);
    if (!changes) {
      EXPECT_EQ(in[at], out[at]) << at;
    }
  }
}

TEST_F(LasKept, CountsByReturnAndBounds_AreThoseOfTheKeptPoints) {
  for (const int minor : {0, 2, 3, 4, 5}) {
    for (int format = 0; format <= 10; ++format) {
      LasPlan plan;
      plan.minor = minor;
      plan.format = format;
      plan.record_bytes = kFormatBytes[static_cast<std::size_t>(format)];
      plan.scale = {0.01, -0.5, 1e-7};
      plan.points = make_records(40, plan.record_bytes, 5);
      const LasParts parts = keep(build_las(plan), [](std::uint64_t id) { return id % 2 == 0; });
      std::vector<std::uint64_t> by_return(minor >= 4 ? 15 : 5);
      std::array<double, 3> min{}, max{};
      for (std::size_t i = 0; i < 40; i += 2) {
        const auto number = static_cast<std::size_t>(plan.points[i][14] & (format >= 6 ? 15 : 7));
        if (number >= 1 && number <= by_return.size()) ++by_return[number - 1];
        for (std::size_t axis = 0; axis < 3; ++axis) {
          const double world = get<std::int32_t>(plan.points[i], 4 * axis) * plan.scale[axis] + plan.offset[axis];
          min[axis] = i == 0 ? world : std::min(min[axis], world);
          max[axis] = i == 0 ? world : std::max(max[axis], world);
        }
      }
      EXPECT_EQ(parts.points, 20U);
      EXPECT_EQ(parts.legacy_points, minor >= 4 && format >= 6 ? 0U : 20U);
      EXPECT_EQ(parts.by_return, by_return);
      EXPECT_EQ(parts.min, min);
      EXPECT_EQ(parts.max, max);
    }
  }
}

TEST_F(LasKept, NothingKept_GivesAValidEmptyFile) {
  LasPlan plan;
  plan.points = make_records(5, 20);
  const LasParts parts = keep(build_las(plan), [](std::uint64_t) { return false; });
  EXPECT_EQ(parts.points, 0U);
  EXPECT_EQ(parts.min, (std::array<double, 3>{0, 0, 0}));
  EXPECT_EQ(parts.max, (std::array<double, 3>{0, 0, 0}));
  EXPECT_TRUE(read_all(folder_ / "out.las").stored.empty());
}

TEST_F(LasKept, OurDescriptions_AreAppendedToTheirs) {
  LasPlan plan;
  plan.record_bytes = 20 + 2 + 12 + 300;  // uint16, float[3], 300 undocumented bytes.
  plan.points = make_records(3, plan.record_bytes);
  plan.vlrs = {
      {"first", 1, "x"}, {"LASF_Spec", 4, extra_entry(3, "Amplitude") + extra_entry(29, "Normal")}, {"last", 2, "y"}};
  const LasParts parts = keep(build_las(plan));
  ASSERT_EQ(parts.vlrs.size(), 3U);
  const std::vector<Entry> entries = entries_of(parts);
  ASSERT_EQ(entries.size(), 8U);
  EXPECT_EQ(entries[0].name, "Amplitude");
  EXPECT_EQ(entries[1].name, "Normal");
  EXPECT_EQ(entries[2].type, 0);
  EXPECT_EQ(entries[2].size + entries[3].size, 300U);
  expect_columns_described(parts, plan.record_bytes);
  EXPECT_TRUE(warnings_.empty());
}

TEST_F(LasKept, WrongDescriptions_AreSupersededWithAWarning) {
  LasPlan plan;
  plan.record_bytes = 22;
  plan.points = make_records(3, 22);
  plan.vlrs = {{"LASF_Spec", 4, extra_entry(10, "TooLong")}};
  const LasParts parts = keep(build_las(plan));
  ASSERT_EQ(parts.vlrs.size(), 2U);
  EXPECT_EQ(parts.vlrs[0].id, 7);
  EXPECT_EQ(parts.vlrs[0].payload, plan.vlrs[0].payload);
  expect_columns_described(parts, 22);
  ASSERT_EQ(warnings_.size(), 1U);
  EXPECT_HAS(warnings_[0], "superseded");
}

TEST_F(LasKept, FullDescriptionRecord_GetsASecondOne) {
  std::string payload;
  for (int i = 0; i < 340; ++i) payload += extra_entry(1, std::to_string(i));
  LasPlan plan;
  plan.record_bytes = 20 + 340;
  plan.points = make_records(3, plan.record_bytes);
  plan.vlrs = {{"LASF_Spec", 4, payload}};
  const LasParts parts = keep(build_las(plan));
  ASSERT_EQ(parts.vlrs.size(), 2U);
  expect_same_vlr(parts.vlrs[0], plan.vlrs[0]);
  expect_columns_described(parts, plan.record_bytes);
}

TEST_F(LasKept, TakenNames_AreNumbered) {
  LasPlan plan;
  plan.points = make_records(3, 20);
  keep(build_las(plan));
  std::filesystem::rename(folder_ / "out.las", folder_ / "again.las");
  warnings_ = write_kept(
      folder_ / "out.las", {folder_ / "again.las"}, kColumns, [](std::uint64_t) { return true; }, row_of);
  const LasParts parts = read_parts(file_bytes(folder_ / "out.las"));
  expect_columns_described(parts, 20 + kRowBytes, {"EdgeClass_2", "EdgeScore_2", "SegmentId_2", "Votes_2"});
  EXPECT_EQ(warnings_.size(), 4U);
}

TEST_F(LasKept, WaveformRecord_MovesWithItsStart) {
  for (const int minor : {3, 4}) {
    LasPlan plan;
    plan.minor = minor;
    plan.format = 4;
    plan.record_bytes = 57;
    plan.points = make_records(9, 57);
    std::string bytes = build_las(plan);
    const std::string waves = std::string(60, '\0') + "wave data of the points";
    put<std::uint64_t>(bytes, 227, bytes.size());
    put<std::uint16_t>(bytes, 6, 2);
    bytes += waves;
    const LasParts parts = keep(bytes);
    EXPECT_EQ(file_bytes(folder_ / "out.las").substr(parts.waveform_start), waves);
    EXPECT_EQ(parts.records.size(), 6U);
  }
}

TEST_F(LasKept, ExternalWaveforms_AreMentioned) {
  LasPlan plan;
  plan.minor = 3;
  plan.format = 4;
  plan.record_bytes = 57;
  plan.points = make_records(2, 57);
  std::string bytes = build_las(plan);
  put<std::uint16_t>(bytes, 6, 4);
  keep(bytes);
  ASSERT_EQ(warnings_.size(), 1U);
  EXPECT_HAS(warnings_[0], "out.wdp");
}

TEST_F(LasKept, UncountableVlr_StaysAsGap) {
  LasPlan plan;
  plan.points = make_records(4, 20);
  plan.vlrs = {{"one", 1, "payload"}};
  plan.gap = "0123456789";
  std::string bytes = build_las(plan);
  put<std::uint32_t>(bytes, 100, 2);
  const LasParts parts = keep(bytes);
  ASSERT_EQ(parts.vlrs.size(), 2U);
  EXPECT_EQ(parts.vlrs[1].user, "LASF_Spec");
  EXPECT_EQ(parts.gap, plan.gap);
}

TEST_F(LasKept, SeveralInputs_ShareOneOutput) {
  LasPlan plan;
  plan.minor = 4;
  plan.format = 6;
  plan.record_bytes = 30;
  plan.points = make_records(5, 30, 1);
  plan.vlrs = {{"LASF_Projection", 2112, "CRS one"}};
  write_new(folder_ / "a.las", build_las(plan));
  std::vector<std::string> expected = plan.points;
  plan.points = make_records(6, 30, 2);
  expected.insert(expected.end(), plan.points.begin(), plan.points.end());
  write_new(folder_ / "b.las", build_las(plan));
  const auto warnings = write_kept(
      folder_ / "out.las", {folder_ / "a.las", folder_ / "b.las"}, kColumns, [](std::uint64_t) { return true; },
      row_of);
  const LasParts parts = read_parts(file_bytes(folder_ / "out.las"));
  ASSERT_EQ(parts.records.size(), 11U);
  for (std::size_t i = 0; i < 11; ++i) EXPECT_EQ(parts.records[i], expected[i] + row_of(i));
  EXPECT_EQ(parts.vlrs[0].payload, "CRS one");
  EXPECT_TRUE(warnings.empty());
}

TEST_F(LasKept, InputsOfOneLayout_AreToldFromOthersByTheDifference) {
  LasPlan first;
  first.record_bytes = 24;
  first.points = make_records(2, 24);
  write_new(folder_ / "a.las", build_las(first));
  const auto difference = [&](const std::function<void(LasPlan&)>& change) {
    LasPlan plan = first;
    change(plan);
    write_new(folder_ / "b.las", build_las(plan));
    return io::las_difference(io::InputSet({folder_ / "a.las", folder_ / "b.las"}).sources());
  };
  EXPECT_EQ(difference([](LasPlan&) {}), "");
  EXPECT_HAS(difference([](LasPlan& p) { p.scale[1] = 0.02; }), "scales (0.01, 0.01, 0.001) and (0.01, 0.02, 0.001)");
  EXPECT_HAS(difference([](LasPlan& p) { p.offset[0] = 0; }), "offsets");
  EXPECT_HAS(difference([](LasPlan& p) { p.record_bytes = 25, p.points.clear(); }), "record lengths 24 and 25");
  EXPECT_HAS(difference([](LasPlan& p) { p.format = 1, p.record_bytes = 28, p.points.clear(); }),
             "point formats 0 and 1");
  EXPECT_HAS(difference([](LasPlan& p) { p.vlrs = {{"LASF_Spec", 4, extra_entry(5, "four")}}; }), "extra bytes");
}

TEST_F(LasKept, RecordsThatWouldBeTooLong_AreRefused) {
  LasPlan plan;
  plan.record_bytes = 65530;
  plan.points = make_records(1, plan.record_bytes);
  write_new(folder_ / "a.las", build_las(plan));
  const io::InputSet inputs({folder_ / "a.las"});
  EXPECT_HAS(message_of<ConfigError>([&] { io::create_kept_point_writer(folder_ / "out.las", inputs, kColumns, {}); }),
             "65535");
}

TEST_F(LasKept, UnusableOutputNames_AreRefused) {
  LasPlan plan;
  write_new(folder_ / "a.las", build_las(plan));
  const io::InputSet inputs({folder_ / "a.las"});
  const auto refusal = [&](const char* name, bool overwrite = false) {
    return message_of<ConfigError>(
        [&] { io::create_kept_point_writer(folder_ / name, inputs, kColumns, {overwrite}); });
  };
  EXPECT_HAS(refusal("out.laz"), ".las or .ply");
  EXPECT_HAS(refusal("out"), ".las or .ply");
  EXPECT_HAS(refusal("a.las", true), "is an input as well");
  write_new(folder_ / "b.las", "old");
  EXPECT_HAS(refusal("b.las"), "--overwrite");
}

}  // namespace
}  // namespace arris::test
