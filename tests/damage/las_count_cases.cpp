/// @file Counts of points: of 32 and 64 bits and by return, and the room in the file as the third witness.

#include <array>
#include <limits>

#include "damaged_file.h"
#include "sound_las.h"

namespace arris::test {
namespace {

constexpr std::uint64_t kMax64 = std::numeric_limits<std::uint64_t>::max();
constexpr std::uint32_t kMax32 = std::numeric_limits<std::uint32_t>::max();

/// LAS 1.2 has only the 32-bit count.
void add_legacy_counts(DamagedFiles& files) {
  const std::string sound = sound_las(2, 0);
  const auto named = [](std::uint32_t count) { return "las-count-32bit-" + std::to_string(count); };
  files.push_back(read_whole("las-count-sound-1.2", sound, kSoundPoints));
  files.push_back(reported(named(0), with<std::uint32_t>(sound, las_at::kLegacyCount, 0), "count-zero", 0)
                      .salvaged(kSoundPoints, "count-zero"));
  for (const std::uint32_t count : {1U, 9U}) {
    files.push_back(reported(named(count), with(sound, las_at::kLegacyCount, count), "trailing-bytes", count));
  }
  // 2^32 / 20 rounded up: the product wraps to a few bytes in 32 bits.
  for (const std::uint32_t count : {11U, 214748365U, 1U << 31, kMax32}) {
    files.push_back(refused(named(count), with(sound, las_at::kLegacyCount, count))
                        .at(las_at::kLegacyCount)
                        .salvaged(kSoundPoints));
  }
}

/// Point formats from 6 on have only the 64-bit count.
void add_extended_counts(DamagedFiles& files) {
  const std::string sound = sound_las(4, 6);
  const auto named = [](std::uint64_t count) { return "las-count-64bit-" + std::to_string(count); };
  files.push_back(read_whole("las-count-sound-1.4", sound, kSoundPoints));
  files.push_back(reported(named(0), with<std::uint64_t>(sound, las_at::kPointCount, 0), "count-zero", 0)
                      .salvaged(kSoundPoints, "count-zero"));
  for (const std::uint64_t count : {1U, 9U}) {
    files.push_back(reported(named(count), with(sound, las_at::kPointCount, count), "trailing-bytes", count));
  }
  // 614891469123651721 and 2^63 wrap: times 30 bytes they are 14 and 0 modulo 2^64.
  for (const std::uint64_t count :
       {std::uint64_t{11}, std::uint64_t{1} << 31, std::uint64_t{1} << 32, std::uint64_t{1} << 60,
        std::uint64_t{614891469123651721}, std::uint64_t{1} << 63, kMax64 - 1, kMax64}) {
    files.push_back(
        refused(named(count), with(sound, las_at::kPointCount, count)).at(las_at::kPointCount).salvaged(kSoundPoints));
  }
  for (const std::uint32_t count : {1U, 9U, static_cast<std::uint32_t>(kSoundPoints), 11U, kMax32}) {
    const std::string bytes = with(sound, las_at::kLegacyCount, count);
    const bool agrees = count == kSoundPoints;
    files.push_back(reported("las-count-32bit-in-format-6-" + std::to_string(count), bytes,
                             agrees ? "legacy-count" : "count-mismatch", kSoundPoints));
  }
}

/// Formats below 6 in LAS 1.4 have both counts; the size of the file decides.
void add_disagreeing_counts(DamagedFiles& files) {
  struct Case {
    std::uint32_t legacy;
    std::uint64_t extended;
    std::uint64_t points;
  };
  const std::string sound = sound_las(4, 3);
  const auto bytes_of = [&](std::uint32_t legacy, std::uint64_t extended) {
    return with(with(sound, las_at::kLegacyCount, legacy), las_at::kPointCount, extended);
  };
  const auto named = [](std::uint32_t legacy, std::uint64_t extended) {
    return "las-counts-" + std::to_string(legacy) + "-" + std::to_string(extended);
  };
  files.push_back(read_whole(named(0, 10), bytes_of(0, 10), 10));
  for (const Case& c :
       {Case{10, 0, 10}, Case{10, 7, 10}, Case{7, 10, 10}, Case{4, 7, 4}, Case{99, 7, 7}, Case{10, 11, 10},
        Case{11, 10, 10}, Case{9, 99, 9}, Case{10, kMax64, 10}, Case{10, std::uint64_t{1} << 60, 10},
        Case{10, (std::uint64_t{1} << 32) + 10, 10}, Case{kMax32, 10, 10}, Case{1, 2, 1}}) {
    files.push_back(reported(named(c.legacy, c.extended), bytes_of(c.legacy, c.extended), "count-mismatch", c.points));
  }
  files.push_back(reported(named(0, 0), bytes_of(0, 0), "count-zero", 0).salvaged(10, "count-zero"));
  for (const Case& c : {Case{11, 11, 0}, Case{99, 98, 0}, Case{11, kMax64, 0}, Case{kMax32, kMax64, 0}, Case{0, 11, 0},
                        Case{0, kMax64, 0}, Case{11, 0, 0}}) {
    files.push_back(refused(named(c.legacy, c.extended), bytes_of(c.legacy, c.extended)).salvaged(10));
  }
}

/// Counts by return say nothing about how many points there are.
void add_counts_by_return(DamagedFiles& files) {
  const std::string old_file = sound_las(2, 0);
  for (const std::uint32_t count : {0U, 1U, kMax32}) {
    std::string bytes = old_file;
    for (std::size_t i = 0; i < 5; ++i) put(bytes, las_at::kLegacyByReturn + 4 * i, count);
    files.push_back(read_whole("las-by-return-32bit-" + std::to_string(count), bytes, kSoundPoints));
  }
  const std::string new_file = sound_las(4, 6);
  for (const std::uint64_t count :
       {std::uint64_t{0}, std::uint64_t{1}, std::uint64_t{1} << 32, std::uint64_t{1} << 60, kMax64}) {
    std::string bytes = new_file;
    for (std::size_t i = 0; i < 15; ++i) put(bytes, las_at::kByReturn + 8 * i, count);
    files.push_back(read_whole("las-by-return-64bit-" + std::to_string(count), bytes, kSoundPoints));
  }
}

/// No points at all is a sound scan, whatever the version.
void add_empty_files(DamagedFiles& files) {
  constexpr std::array<int, 6> kFormats{0, 1, 3, 4, 6, 10};
  for (int minor = 0; minor <= 5; ++minor) {
    const std::string sound = sound_las(minor, kFormats[static_cast<std::size_t>(minor)], 0);
    const std::string version = "1." + std::to_string(minor);
    files.push_back(read_whole("las-no-points-" + version, sound, 0));
    const std::string one = minor >= 4 ? with<std::uint64_t>(sound, las_at::kPointCount, 1)
                                       : with<std::uint32_t>(sound, las_at::kLegacyCount, 1);
    files.push_back(refused("las-no-points-but-one-" + version, one).salvaged(0));
  }
}

}  // namespace

DamagedFiles las_count_cases() {
  DamagedFiles files;
  add_legacy_counts(files);
  add_extended_counts(files);
  add_disagreeing_counts(files);
  add_counts_by_return(files);
  add_empty_files(files);
  return files;
}

}  // namespace arris::test
