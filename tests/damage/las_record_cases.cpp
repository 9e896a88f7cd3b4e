/// @file Variable-length records: their number and lengths, against the room that there is.

#include <limits>

#include "damaged_file.h"
#include "sound_las.h"

namespace arris::test {
namespace {

constexpr std::uint64_t kMax64 = std::numeric_limits<std::uint64_t>::max();
constexpr std::uint32_t kMax32 = std::numeric_limits<std::uint32_t>::max();
constexpr std::size_t kVlrLength = 20, kVlrHeader = 54, kEvlrHeader = 60;

LasPlan two_of_each() {
  LasPlan plan = sound_plan(4, 6);
  plan.vlrs = {{"one", 1, "first payload"}, {"two", 2, "second payload"}};
  plan.evlrs = {{"far", 3, "payload"}, {"farther", 4, "payload"}};
  return plan;
}

void add_vlr_counts(DamagedFiles& files) {
  const std::string sound = sound_las(two_of_each());
  const auto named = [](std::uint32_t count) { return "las-vlr-count-" + std::to_string(count); };
  files.push_back(read_whole("las-two-records-of-each-kind", sound, kSoundPoints));
  for (const std::uint32_t count : {0U, 1U})  // The rest is a gap.
    files.push_back(read_whole(named(count), with(sound, las_at::kVlrCount, count), kSoundPoints));
  for (const std::uint32_t count : {3U, 65536U, 1U << 31, kMax32})
    files.push_back(reported(named(count), with(sound, las_at::kVlrCount, count), "vlr-overrun", kSoundPoints));
}

void add_vlr_lengths(DamagedFiles& files) {
  const std::string sound = sound_las(two_of_each());
  const std::size_t first = 375;
  const std::size_t second = first + kVlrHeader + 13;
  const auto add = [&](const std::string& name, std::size_t record, std::uint16_t length, bool overruns) {
    const std::string bytes = with(sound, record + kVlrLength, length);
    files.push_back(overruns ? reported("las-vlr-length-" + name, bytes, "vlr-overrun", kSoundPoints)
                             : read_whole("las-vlr-length-" + name, bytes, kSoundPoints));
  };
  add("first-max", first, 65535, true);
  add("second-max", second, 65535, true);
  add("second-into-points", second, 15, true);
  add("second-shorter", second, 13, false);
  // The chain goes out of step: what it takes for the second record's header is text.
  add("first-shorter", first, 12, true);
}

void add_evlr_counts_and_lengths(DamagedFiles& files) {
  const std::string sound = sound_las(two_of_each());
  const std::size_t first = get<std::uint64_t>(sound, las_at::kEvlrStart);
  for (const std::uint32_t count : {3U, 65537U, 1U << 31, kMax32}) {
    files.push_back(reported("las-evlr-count-" + std::to_string(count), with(sound, las_at::kEvlrCount, count),
                             "evlr-overrun", kSoundPoints));
  }
  // The last sums with the 60 bytes of the header, and with where the payload begins, to 0 and 1 modulo 2^64.
  for (const std::uint64_t length :
       {std::uint64_t{75}, std::uint64_t{sound.size()}, std::uint64_t{1} << 32, std::uint64_t{1} << 63, kMax64,
        kMax64 - 59, kMax64 - (first + kEvlrHeader) + 1, kMax64 - (first + kEvlrHeader) + 2}) {
    files.push_back(reported("las-evlr-length-" + std::to_string(length), with(sound, first + kVlrLength, length),
                             "evlr-overrun", kSoundPoints));
  }
  files.push_back(reported("las-evlrs-uncounted", with<std::uint32_t>(sound, las_at::kEvlrCount, 0), "trailing-bytes",
                           kSoundPoints));
}

/// More records than any scan has, all of them there.
void add_record_bombs(DamagedFiles& files) {
  LasPlan plan = sound_plan(4, 6);
  plan.vlrs.assign(65537, {"u", 1, "", ""});
  files.push_back(reported("las-vlr-bomb", sound_las(plan), "vlr-overrun", kSoundPoints));
  plan.evlrs = std::move(plan.vlrs);
  plan.vlrs.clear();
  files.push_back(reported("las-evlr-bomb", sound_las(plan), "evlr-overrun", kSoundPoints));
}

/// Texts are bytes: they need no end and may hold anything.
void add_record_texts(DamagedFiles& files) {
  LasPlan plan = sound_plan(2, 1);
  plan.vlrs = {{std::string(16, 'u'), 1, "payload", std::string(32, 'd')},
               {"\x1b[31mred\x07", 2, "", "line\nbreak\r\x7f\xff"},
               {"", 0, "", ""}};
  files.push_back(read_whole("las-vlr-texts", sound_las(plan), kSoundPoints));
}

/// A LASzip record in a file that does not say it is compressed: if the points fill their room it is a leftover.
void add_laszip_records(DamagedFiles& files) {
  LasPlan plan = sound_plan(2, 1, 100);
  plan.vlrs = {{"laszip encoded", 22204, std::string(40, 'z')}};
  const std::string whole = sound_las(plan);
  files.push_back(reported("las-laszip-record-left", whole, "stale-laszip-vlr", 100));
  files.push_back(refused("las-laszip-record-and-fewer-bytes", whole.substr(0, whole.size() - 1000)));
  files.push_back(refused("las-laszip-record-and-more-bytes", whole + std::string(28, 'z')));
}

}  // namespace

DamagedFiles las_record_cases() {
  DamagedFiles files;
  add_vlr_counts(files);
  add_vlr_lengths(files);
  add_evlr_counts_and_lengths(files);
  add_record_bombs(files);
  add_record_texts(files);
  add_laszip_records(files);
  return files;
}

}  // namespace arris::test
