/// What real LAS files get wrong or carry that readers lose; tests/README.md has the table.
#include <chrono>

#include "io/file_summary.h"
#include "io/point_statistics.h"
#include "io_helpers.h"
#include "las_builder.h"

namespace arris::test {
namespace {

class LasTraps : public ::testing::Test {
 protected:
  std::filesystem::path write(const std::string& bytes, const char* name = "a.las") {
    write_new(folder_ / name, bytes);
    return folder_ / name;
  }
  std::string codes(const std::string& bytes, io::Tolerance tolerance = io::Tolerance::kUsual) {
    std::string all;
    const auto source = io::open_point_source(write(bytes), tolerance);
    for (const io::Problem& problem : source->info().problems) all += problem.code + " ";
    return all;
  }
  /// Keeps every point, with no column of ours, and reads the output with the second reader.
  LasParts kept(const std::string& bytes) {
    write(bytes, "in.las");
    std::filesystem::remove(folder_ / "out.las");
    write_kept(
        folder_ / "out.las", {folder_ / "in.las"}, {}, [](std::uint64_t) { return true; },
        [](std::uint64_t) { return std::string(); });
    return read_parts(file_bytes(folder_ / "out.las"));
  }
  io::PointStatistics statistics(const std::string& bytes) {
    const auto path = write(bytes);
    const io::InputFile file(path);
    const auto source = io::open_point_source(path);
    const auto reader = io::make_record_reader(file, source->info());
    io::PointStatistics found = io::collect_statistics(*source, *reader, [](std::uint64_t) {});
    problems_.clear();
    for (const io::Problem& problem : io::find_point_problems(file, source->info(), found))
      problems_ += problem.code + " ";
    return found;
  }
  TempFolder folder_;
  std::string problems_;
};

TEST_F(LasTraps, L05_CutFile_IsSalvagedToItsWholePoints) {
  for (const int format : {0, 6}) {
    const LasPlan plan = plan_of(4, format, 5);
    const std::string whole = build_las(plan);
    const std::size_t size = plan.record_bytes;
    for (std::size_t lost = 1; lost <= 2 * size + 1; ++lost) {
      const auto path = write(whole.substr(0, whole.size() - lost));
      message_of<InputError>([&] { io::open_point_source(path); });
      const auto source = io::open_point_source(path, io::Tolerance::kSalvage);
      const AllPoints all = read_all(*source);
      ASSERT_EQ(all.records.size(), (5 * size - lost) / size);
      for (std::size_t i = 0; i < all.records.size(); ++i) EXPECT_EQ(all.records[i], plan.points[i]);
      ASSERT_EQ(source->info().problems.front().code, "points-lost");
    }
  }
}

TEST_F(LasTraps, L05_InterruptedWriter_IsSalvagedFromACountOfZero) {
  for (const int minor : {2, 4}) {
    const LasPlan plan = plan_of(minor, 1, 7);
    std::string bytes = build_las(plan);
    put<std::uint32_t>(bytes, 107, 0);
    if (minor == 4) put<std::uint64_t>(bytes, 247, 0);
    EXPECT_EQ(io::open_point_source(write(bytes))->info().points, 0U);
    EXPECT_HAS(codes(bytes), "count-zero");
    const auto source = io::open_point_source(write(bytes), io::Tolerance::kSalvage);
    EXPECT_EQ(read_all(*source).records, plan.points);
  }
}

TEST_F(LasTraps, L03_AnyProblem_IsRefusedUnderStrict) {
  LasPlan plan = plan_of(4, 6, 3);
  const auto sound = write(build_las(plan));
  EXPECT_EQ(read_all(*io::open_point_source(sound, io::Tolerance::kStrict)).records, plan.points);
  std::string bytes = build_las(plan);
  put<std::uint32_t>(bytes, 107, 3);
  EXPECT_EQ(codes(bytes), "legacy-count ");
  const std::string text = message_of<InputError>([&] { io::open_point_source(write(bytes), io::Tolerance::kStrict); });
  EXPECT_HAS(text, "byte 107: ");
  EXPECT_HAS(text, "[legacy-count]");
  EXPECT_HAS(text, "--strict");
}

TEST_F(LasTraps, L09_TheContentDecides_NotTheName) {
  const LasPlan plan = plan_of(2, 0, 3);
  EXPECT_EQ(read_all(write(build_las(plan), "points.laz")).records, plan.points);
  std::string compressed = build_las(plan);
  compressed[104] = static_cast<char>(0x80 | 3);
  EXPECT_HAS(message_of<InputError>([&] { io::open_point_source(write(compressed, "points.las")); }), "LAZ");
}

TEST_F(LasTraps, L10_CrsOfEveryKind_IsAcceptedAndCarried) {
  struct Case {
    std::string codes;
    std::vector<TestVlr> vlrs;
    std::vector<TestVlr> evlrs;
    std::string name;
  };
  const std::string keys("\1\0\1\0\0\0\1\0\0\x0c\0\0\1\0\xe8\x64", 16);  // Projected system 25832.
  const std::string wkt = "COMPD_CS[\"both\",PROJCS[\"plane\",GEOGCS[\"g\",UNIT[\"degree\",0.01]],UNIT[\"metre\",1]]]";
  const std::vector<Case> cases{
      {"", {{"LASF_Projection", 2112, wkt}}, {}, "both"},
      {"", {}, {{"LASF_Projection", 2112, wkt + std::string(1, '\0')}}, "both"},
      {"crs-empty ", {{"LASF_Projection", 2112, ""}, {"LASF_Projection", 2112, wkt}}, {}, "both"},
      {"crs-empty ", {{"LASF_Projection", 2112, std::string(5, '\0')}}, {}, ""},
      {"crs-both ", {{"LASF_Projection", 2112, wkt}, {"LASF_Projection", 34735, keys}}, {}, "both"},
      {"", {{"LASF_Projection", 34735, keys}}, {}, "EPSG:25832"},
      {"", {{"LASF_Projection", 2112, "PROJCS[\"M\xc3\xbcnchen\"]"}}, {}, "M??nchen"},
      {"crs-keys ", {{"LASF_Projection", 34735, keys.substr(0, 15)}}, {}, ""},
  };
  for (const Case& c : cases) {
    LasPlan plan = plan_of(4, 6, 2);
    plan.vlrs = c.vlrs;
    plan.evlrs = c.evlrs;
    const std::string bytes = build_las(plan);
    EXPECT_EQ(codes(bytes), c.codes);
    const io::FileSummary summary = io::summarize_file(write(bytes));
    EXPECT_EQ(summary.crs.name, c.name);
    EXPECT_EQ(summary.crs.unit, c.name == "both" ? "metre" : "");
    EXPECT_EQ(file_bytes(folder_ / "a.las"), bytes);
    const LasParts parts = kept(bytes);
    ASSERT_EQ(parts.vlrs.size(), c.vlrs.size());
    for (std::size_t i = 0; i < c.vlrs.size(); ++i) EXPECT_EQ(parts.vlrs[i].payload, c.vlrs[i].payload);
    for (std::size_t i = 0; i < c.evlrs.size(); ++i) EXPECT_EQ(parts.evlrs[i].payload, c.evlrs[i].payload);
  }
}

TEST_F(LasTraps, L10_MissingWktBit_IsReported) {
  std::string bytes = build_las(plan_of(4, 6, 1));
  put<std::uint16_t>(bytes, 6, 0);
  EXPECT_EQ(codes(bytes), "wkt-bit ");
}

TEST_F(LasTraps, L19_EveryFlagByte_IsKeptAndExcludedAsTheSpecificationSays) {
  for (const int format : {0, 6}) {
    LasPlan plan = plan_of(4, format, 256);
    for (std::size_t i = 0; i < 256; ++i) plan.points[i][14] = plan.points[i][15] = static_cast<char>(i);
    const std::string bytes = build_las(plan);
    EXPECT_EQ(kept(bytes).records, plan.points);
    for (unsigned flags = 0; flags < 16; ++flags) {
      io::PointBatch batch;
      io::ReadOptions options;
      options.exclusion.flags = static_cast<std::uint8_t>(flags);
      for (const bool records : {false, true}) {
        options.records = records;
        const auto source = io::open_point_source(write(bytes));
        ASSERT_TRUE(source->read(batch, options));
        ASSERT_EQ(batch.excluded.size(), flags == 0 ? 0U : 256U);
        for (unsigned i = 0; i < batch.excluded.size(); ++i) {
          const unsigned own = format == 6 ? i & 15U : (i >> 5) | ((i & 31U) == 12 ? 8U : 0U);
          EXPECT_EQ(batch.excluded[i] != 0, (own & flags) != 0) << i;
        }
      }
    }
  }
}

TEST_F(LasTraps, L20_OddReturnNumbers_AreKeptAndCounted) {
  LasPlan plan = plan_of(2, 0, 64);
  for (std::size_t i = 0; i < 64; ++i) plan.points[i][14] = static_cast<char>(i);
  EXPECT_EQ(kept(build_las(plan)).records, plan.points);
  const io::PointStatistics found = statistics(build_las(plan));
  std::uint64_t odd = 0;
  for (unsigned i = 0; i < 64; ++i) odd += (i & 7U) == 0 || (i & 7U) > (i >> 3);
  EXPECT_EQ(found.odd_returns, odd);
  EXPECT_HAS(problems_, "returns ");
  EXPECT_HAS(problems_, "by-return-mismatch ");
  for (std::size_t i = 0; i < 8; ++i) EXPECT_EQ(found.by_return[i], 8U);
}

TEST_F(LasTraps, L21_ColourDepth_IsDecidedPerFile) {
  for (const int most : {0, 1, 255, 256, 65535}) {
    LasPlan plan = plan_of(2, 2, 10);
    for (std::string& point : plan.points) point.replace(20, 6, std::string(6, '\0'));
    put<std::uint16_t>(plan.points[7], 22, static_cast<std::uint16_t>(most));
    EXPECT_EQ(kept(build_las(plan)).records, plan.points) << "values are never altered";
    EXPECT_EQ(statistics(build_las(plan)).has_8_bit_colours(), most == 1 || most == 255);
    EXPECT_EQ(problems_.find("colour-8-bit") != std::string::npos, most == 1 || most == 255);
  }
}

TEST_F(LasTraps, L22_RangesAndClasses_AreThoseOfThePoints) {
  LasPlan plan = plan_of(4, 6, 3, 4);
  plan.vlrs = {{"LASF_Spec", 4, extra_entry(9, "Quality")}};
  for (std::size_t i = 0; i < 3; ++i) {
    put<std::uint16_t>(plan.points[i], 12, static_cast<std::uint16_t>(100 * i + 5));
    plan.points[i][16] = static_cast<char>(i == 0 ? 200 : 6);
    put<std::int16_t>(plan.points[i], 18, static_cast<std::int16_t>(1000 * i));
    put<float>(plan.points[i], 30, i == 1 ? std::numeric_limits<float>::quiet_NaN() : static_cast<float>(i));
  }
  const io::PointStatistics found = statistics(build_las(plan));
  EXPECT_EQ(found.points, 3U);
  EXPECT_EQ(found.find("intensity")->min, 5.0);
  EXPECT_EQ(found.find("intensity")->max, 205.0);
  EXPECT_DOUBLE_EQ(found.find("scan_angle")->max, 12.0);
  EXPECT_EQ(found.find("Quality")->max, 2.0);
  EXPECT_EQ(found.find("Quality")->not_finite, 1U);
  EXPECT_EQ(found.classes[200], 1U);
  EXPECT_EQ(found.classes[6], 2U);
  EXPECT_HAS(problems_, "bbox-mismatch ");
}

TEST_F(LasTraps, L23_L30_NansAndNegativeZeros_KeepTheirBits) {
  LasPlan plan = plan_of(4, 6, 4, 8);
  plan.vlrs = {{"LASF_Spec", 4, extra_entry(10, "d")}};
  const std::array<std::uint64_t, 4> bits{0x7FF0000000000001U, 0xFFF8DEADBEEF0001U, 0x8000000000000000U, 1U};
  for (std::size_t i = 0; i < 4; ++i) {
    put<std::uint64_t>(plan.points[i], 22, bits[i]);
    put<std::uint64_t>(plan.points[i], 30, bits[3 - i]);
  }
  EXPECT_EQ(kept(build_las(plan)).records, plan.points);
}

TEST_F(LasTraps, L25_OurDescriptions_StateTheirRanges) {
  for (const bool theirs : {false, true}) {
    LasPlan plan = plan_of(2, 0, 5, 2);
    if (theirs) plan.vlrs = {{"LASF_Spec", 4, extra_entry(3, "theirs")}};
    const auto in = write(build_las(plan));
    std::filesystem::remove(folder_ / "out.las");
    const auto row = [](std::uint64_t id) {
      std::string bytes(5, '\0');
      bytes[0] = static_cast<char>(id == 4 ? 200 : id + 3);
      put<float>(bytes, 1, id == 2 ? std::numeric_limits<float>::quiet_NaN() : static_cast<float>(id) - 0.5F);
      return bytes;
    };
    write_kept(
        folder_ / "out.las", {in}, {{"Class", ColumnType::kUint8, ""}, {"Score", ColumnType::kFloat32, ""}},
        [](std::uint64_t id) { return id != 0; }, row);
    const std::string payload = read_parts(file_bytes(folder_ / "out.las")).vlrs.at(0).payload;
    const std::string ours = payload.substr(payload.size() - 384);
    EXPECT_EQ(ours[3], 6) << "least and greatest value are there";
    EXPECT_EQ(get<std::uint64_t>(ours, 64), 4U);
    EXPECT_EQ(get<std::uint64_t>(ours, 88), 200U);
    EXPECT_EQ(get<double>(ours, 192 + 64), 0.5);
    EXPECT_EQ(get<double>(ours, 192 + 88), 3.5);
    EXPECT_EQ(payload.substr(0, payload.size() - 384), theirs ? plan.vlrs[0].payload : payload.substr(0, 192));
  }
}

TEST_F(LasTraps, L26_HeaderTexts_AreRawBytes) {
  std::string bytes = build_las(plan_of(2, 0, 2));
  bytes.replace(26, 64, std::string(64, '\xff'));
  kept(bytes);
  EXPECT_EQ(file_bytes(folder_ / "out.las").substr(26, 64), std::string(64, '\xff'));
  const io::FileSummary summary = io::summarize_file(write(bytes));
  for (const auto& [name, value] : summary.header) EXPECT_EQ(value.find('\xff'), std::string::npos) << name;
}

TEST_F(LasTraps, L27_NoPoints_AreValidInAndOut) {
  for (int minor = 0; minor <= 5; ++minor) {
    const std::string bytes = build_las(plan_of(minor, 0, 0));
    EXPECT_EQ(codes(bytes), "");
    const LasParts parts = kept(bytes);
    EXPECT_EQ(parts.points, 0U);
    EXPECT_EQ(file_bytes(folder_ / "out.las"), bytes);
  }
}

TEST_F(LasTraps, L31_InputTouchedWhileInUse_IsNoticed) {
  const std::string bytes = build_las(plan_of(2, 0, 5));
  const auto path = write(bytes);
  io::InputSet set({path});
  set.check_unchanged();
  const auto later = std::filesystem::last_write_time(path) + std::chrono::seconds(2);
  std::filesystem::last_write_time(path, later);
  EXPECT_HAS(message_of<InputError>([&] { set.check_unchanged(); }), "changed while it was in use");
  io::PointBatch batch;
  EXPECT_HAS(message_of<InputError>([&] { set.read(batch, {}); }), "changed while it was in use");
}

}  // namespace
}  // namespace arris::test
