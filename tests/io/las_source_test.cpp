#include <sys/stat.h>
#include <unistd.h>

#include <limits>

#include "io/las_file.h"
#include "io_helpers.h"
#include "las_builder.h"

namespace arris::test {
namespace {

void expect_points(const AllPoints& all, const LasPlan& plan) {
  ASSERT_EQ(all.stored.size(), plan.points.size());
  for (std::size_t i = 0; i < plan.points.size(); ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis)
      EXPECT_EQ(all.stored[i][axis], get<std::int32_t>(plan.points[i], 4 * axis));
    if (!all.records.empty()) {
      EXPECT_EQ(all.records[i], plan.points[i]);
    }
  }
}

class LasSource : public ::testing::Test {
 protected:
  std::filesystem::path write(const std::string& bytes) {
    write_new(folder_ / "a.las", bytes);
    return folder_ / "a.las";
  }
  std::string refusal(const std::string& bytes) {
    return message_of<InputError>([&] { io::open_point_source(write(bytes)); });
  }
  TempFolder folder_;
};

TEST_F(LasSource, EveryVersionAndFormat_ReadsTheSameRecords) {
  for (int minor = 0; minor <= 5; ++minor) {
    for (int format = 0; format <= 10; ++format) {
      for (const std::size_t extra : {std::size_t{0}, std::size_t{5}}) {
        LasPlan plan = plan_of(minor, format, 7, extra);
        plan.vlrs = {{"one", 1, "payload"}, {"two", 2, ""}};
        plan.gap = minor == 0 ? "\xdd\xcc" : "";
        if (minor >= 4) plan.evlrs = {{"far", 3, std::string(100, 'e')}};
        SCOPED_TRACE(::testing::Message() << "1." << minor << " format " << format << " extra " << extra);
        const auto source = io::open_point_source(write(build_las(plan)));
        EXPECT_EQ(source->info().points, 7U);
        EXPECT_EQ(source->info().record_bytes, plan.record_bytes);
        EXPECT_TRUE(source->info().scaled_integers);
        EXPECT_EQ(source->info().scale, plan.scale);
        EXPECT_EQ(source->info().offset, plan.offset);
        expect_points(read_all(*source), plan);
        source->rewind();
        expect_points(read_all(*source, false, 100), plan);
      }
    }
  }
}

TEST_F(LasSource, LongerHeaderAndGap_AreSkipped) {
  for (const std::size_t padding : {1, 2, 150, 1000}) {
    for (const std::size_t gap : {0, 1, 2, 100000}) {
      LasPlan plan = plan_of(2, 3, 4);
      plan.header_padding = padding;
      plan.vlrs = {{"one", 1, "payload"}};
      plan.gap = std::string(gap, 'g');
      expect_points(read_all(write(build_las(plan))), plan);
    }
  }
}

TEST_F(LasSource, FieldsOfLaterVersions_AreNotReadFromOlderFiles) {
  LasPlan plan = plan_of(2, 0, 4);
  plan.header_padding = 200;  // Garbage where 1.4 has its counts and extended records.
  const auto source = io::open_point_source(write(build_las(plan)));
  EXPECT_EQ(source->info().points, 4U);
  EXPECT_TRUE(source->info().problems.empty());
}

TEST_F(LasSource, FileShorterThanNewestHeader_IsReadIfItsVersionAllows) {
  EXPECT_EQ(io::open_point_source(write(build_las(plan_of(2, 0, 0))))->info().points, 0U);
  EXPECT_TRUE(read_all(folder_ / "a.las").stored.empty());
}

TEST_F(LasSource, LargestRecords_AreReadInBoundedBatches) {
  LasPlan plan = plan_of(4, 6, 70, 65535 - 30);
  const auto source = io::open_point_source(write(build_las(plan)));
  io::PointBatch batch;
  io::ReadOptions options;
  options.records = true;
  std::size_t points = 0;
  while (source->read(batch, options)) {
    EXPECT_LE(batch.records.size(), std::size_t{4} << 20);
    points += batch.count;
  }
  EXPECT_EQ(points, 70U);
}

TEST_F(LasSource, CutAnywhereInThePoints_IsRefusedWithNumbers) {
  const LasPlan plan = plan_of(4, 6, 5);
  const std::string whole = build_las(plan);
  for (std::size_t lost = 1; lost <= 61; ++lost) {
    const std::string text = refusal(whole.substr(0, whole.size() - lost));
    EXPECT_HAS(text, "counts 5 points of 30 bytes from byte 375 to 525");
    EXPECT_HAS(text, "ends at byte " + std::to_string(525 - lost));
    EXPECT_HAS(text, "holds " + std::to_string((150 - lost) / 30) + " whole points");
  }
}

TEST_F(LasSource, CutAnywhereInTheHeader_IsRefused) {
  const std::string whole = build_las(plan_of(4, 6, 5));
  for (std::size_t size = 0; size < 375; ++size) refusal(whole.substr(0, size));
}

TEST_F(LasSource, CountsThatOverflow_AreRefused) {
  for (const std::uint64_t count :
       {std::numeric_limits<std::uint64_t>::max(), std::uint64_t{1} << 60, std::uint64_t{1} << 32}) {
    std::string bytes = build_las(plan_of(4, 6, 2, 65535 - 30));
    put<std::uint64_t>(bytes, 247, count);
    EXPECT_HAS(refusal(bytes), "holds 2 whole points");
  }
}

TEST_F(LasSource, MoreThan32BitsOfPoints_AreReachedAtBothEnds) {
  constexpr std::uint64_t kPoints = (std::uint64_t{1} << 32) + 5;
  LasPlan plan = plan_of(4, 6, 1);
  std::string bytes = build_las(plan);
  put<std::uint64_t>(bytes, 247, kPoints);
  const auto path = write(bytes);
  if (::truncate(path.c_str(), static_cast<off_t>(375 + kPoints * 30)) != 0)
    GTEST_SKIP() << "no sparse file of 129 GB here";
  const auto source = io::open_point_source(path);
  EXPECT_EQ(source->info().points, kPoints);
  io::PointBatch batch;
  ASSERT_TRUE(source->read(batch, {}));
  EXPECT_EQ(batch.ix[0], get<std::int32_t>(plan.points[0], 0));
}

TEST_F(LasSource, DisagreeingCounts_AreSettledByTheSizeOfTheFile) {
  struct Case {
    std::uint32_t legacy;
    std::uint64_t extended;
    std::uint64_t expected;
    bool problem;
  };
  for (const Case& c : {Case{10, 10, 10, false}, Case{0, 10, 10, false}, Case{10, 0, 10, true}, Case{10, 7, 10, true},
                        Case{7, 10, 10, true}, Case{4, 7, 4, true}, Case{99, 7, 7, true}, Case{0, 0, 0, true}}) {
    LasPlan plan = plan_of(4, 3, 10);
    std::string bytes = build_las(plan);
    put<std::uint32_t>(bytes, 107, c.legacy);
    put<std::uint64_t>(bytes, 247, c.extended);
    const auto source = io::open_point_source(write(bytes));
    EXPECT_EQ(source->info().points, c.expected) << c.legacy << " " << c.extended;
    const bool problem = !source->info().problems.empty() && source->info().problems[0].code.starts_with("count");
    EXPECT_EQ(problem, c.problem) << c.legacy << " " << c.extended;
  }
}

TEST_F(LasSource, CompressedPoints_AreRecognised) {
  for (const int bit : {0x80, 0x40, 0xC0}) {
    std::string bytes = build_las(plan_of(2, 1, 3));
    bytes[104] = static_cast<char>(1 | bit);
    EXPECT_HAS(refusal(bytes), "LAZ");
  }
  LasPlan plan = plan_of(2, 1, 100);
  plan.vlrs = {{"laszip encoded", 22204, std::string(40, 'z')}};
  const std::string whole = build_las(plan);
  EXPECT_HAS(refusal(whole.substr(0, whole.size() - 1000)), "LAZ");
  // A decompressed file whose writer left the record behind.
  const auto source = io::open_point_source(write(whole));
  ASSERT_EQ(source->info().problems.size(), 1U);
  EXPECT_EQ(source->info().problems[0].code, "stale-laszip-vlr");
}

TEST_F(LasSource, UnusableScaleOrOffset_IsRefused) {
  const double inf = std::numeric_limits<double>::infinity();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double scale : {0.0, -0.0, nan, inf, -inf, 1e305}) {
    std::string bytes = build_las(plan_of(2, 0, 1));
    put<double>(bytes, 131 + 8, scale);
    EXPECT_HAS(refusal(bytes), "y scale");
  }
  for (const double offset : {nan, inf, -inf}) {
    std::string bytes = build_las(plan_of(2, 0, 1));
    put<double>(bytes, 155 + 16, offset);
    EXPECT_HAS(refusal(bytes), "z scale");
  }
  std::string negative = build_las(plan_of(2, 0, 1));
  put<double>(negative, 131, -0.01);
  EXPECT_EQ(io::open_point_source(write(negative))->info().scale[0], -0.01);
}

TEST_F(LasSource, DamagedHeaderFields_AreNamed) {
  const std::string good = build_las(plan_of(2, 3, 3));
  const auto with = [&](auto value, std::size_t at) {
    std::string bytes = good;
    put(bytes, at, value);
    return refusal(bytes);
  };
  EXPECT_HAS(with(std::uint8_t{2}, 24), "LAS 2.2");
  EXPECT_HAS(with(std::uint8_t{6}, 25), "LAS 1.6");
  EXPECT_HAS(with(std::uint16_t{226}, 94), "header size 226");
  EXPECT_HAS(with(std::uint16_t{60000}, 94), "cut short");
  EXPECT_HAS(with(std::uint32_t{226}, 96), "offset to points 226");
  EXPECT_HAS(with(std::uint32_t{100000}, 96), "cut short");
  EXPECT_HAS(with(std::uint8_t{11}, 104), "point format 11");
  for (std::uint16_t length = 0; length < 34; ++length) EXPECT_HAS(with(length, 105), "record length");
  std::string short_header = build_las(plan_of(4, 6, 3));
  put<std::uint16_t>(short_header, 94, 374);
  EXPECT_HAS(refusal(short_header), "header size 374");
}

TEST_F(LasSource, BadRecordChains_AreProblemsNotFailures) {
  LasPlan plan = plan_of(4, 6, 6);
  plan.vlrs = {{"one", 1, "payload"}, {"two", 2, "payload"}};
  plan.evlrs = {{"far", 3, "payload"}};
  const std::string good = build_las(plan);
  const auto codes = [&](std::size_t at, auto value) {
    std::string bytes = good;
    put(bytes, at, value);
    const auto source = io::open_point_source(write(bytes));
    expect_points(read_all(*source), plan);
    std::string all;
    for (const io::Problem& problem : source->info().problems) all += problem.code + ";";
    return all;
  };
  EXPECT_EQ(codes(4, std::uint16_t{5}), "");
  EXPECT_EQ(codes(100, std::numeric_limits<std::uint32_t>::max()), "vlr-overrun;");
  EXPECT_EQ(codes(100, std::uint32_t{3}), "vlr-overrun;");
  EXPECT_EQ(codes(375 + 20, std::uint16_t{65535}), "vlr-overrun;");
  EXPECT_HAS(codes(243, std::numeric_limits<std::uint32_t>::max()), "evlr-overrun");
  const std::size_t evlr = get<std::uint64_t>(good, 235);
  EXPECT_HAS(codes(evlr + 20, std::numeric_limits<std::uint64_t>::max()), "evlr-overrun");
  EXPECT_HAS(codes(235, std::uint64_t{0}), "evlr-overlap");
  EXPECT_HAS(codes(235, std::numeric_limits<std::uint64_t>::max()), "evlr-overrun");
  EXPECT_HAS(codes(235, std::uint64_t{good.size() - 80}), "evlr-overlap");
}

TEST_F(LasSource, FileCutShortWhileRead_IsAnInputError) {
  const auto path = write(build_las(plan_of(2, 0, 1000)));
  const auto source = io::open_point_source(path);
  io::PointBatch batch;
  io::ReadOptions options;
  options.batch_points = 100;
  ASSERT_TRUE(source->read(batch, options));
  ASSERT_EQ(::truncate(path.c_str(), 5000), 0);
  const std::string text = message_of<InputError>([&] {
    while (source->read(batch, options)) {
    }
  });
  EXPECT_HAS(text, "byte 5000: the file ends here");
}

TEST(OpenPointSource, WhatIsNoScan_IsRefusedWithAHint) {
  const TempFolder folder;
  const auto refusal = [&](const std::string& bytes) {
    write_new(folder / "x.las", bytes);
    return message_of<InputError>([&] { io::open_point_source(folder / "x.las"); });
  };
  EXPECT_HAS(refusal(""), "is empty");
  EXPECT_HAS(refusal("ASTM-E57......"), "E57");
  EXPECT_HAS(refusal("hello"), "neither LAS");
  EXPECT_HAS(refusal("plywood\n"), "neither LAS");
  EXPECT_HAS(message_of<InputError>([&] { io::open_point_source(folder.path()); }), "not a regular file");
  EXPECT_HAS(message_of<IoError>([&] { io::open_point_source(folder / "absent"); }), "No such file");
  ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
  EXPECT_HAS(message_of<InputError>([&] { io::open_point_source(folder / "pipe"); }), "not a regular file");
}

}  // namespace
}  // namespace arris::test
