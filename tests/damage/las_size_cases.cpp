/// @file Sizes: of the header and of a point record, against what version and point format need.

#include "damaged_file.h"
#include "sound_las.h"

namespace arris::test {
namespace {

void add_record_lengths(DamagedFiles& files) {
  for (int format = 0; format <= 10; ++format) {
    const std::string sound = sound_las(5, format);
    const auto least = static_cast<std::uint16_t>(kFormatBytes[static_cast<std::size_t>(format)]);
    const auto named = [&](std::uint16_t length) {
      return "las-record-length-format-" + std::to_string(format) + "-" + std::to_string(length);
    };
    for (const std::uint16_t length :
         {std::uint16_t{0}, std::uint16_t{1}, std::uint16_t{12}, static_cast<std::uint16_t>(least - 1)}) {
      files.push_back(refused(named(length), with(sound, las_at::kRecordLength, length)).at(las_at::kRecordLength));
    }
    const std::uint64_t whole = kSoundPoints * least / (least + 1U);
    files.push_back(
        refused(named(least + 1), with<std::uint16_t>(sound, las_at::kRecordLength, least + 1)).salvaged(whole));
    files.push_back(refused(named(65535), with<std::uint16_t>(sound, las_at::kRecordLength, 65535)).salvaged(0));
  }
}

/// The longest records that the field can state, and a length that is short of what is there.
void add_long_records(DamagedFiles& files) {
  const std::string longest = sound_las(4, 6, 3, 65535 - 30);
  files.push_back(read_whole("las-longest-records", longest, 3));
  files.push_back(refused("las-longest-records-one-more", with<std::uint64_t>(longest, las_at::kPointCount, 4))
                      .at(las_at::kPointCount)
                      .salvaged(3));
  files.push_back(reported("las-records-shorter-than-stored",
                           with<std::uint16_t>(sound_las(2, 0, 10, 10), las_at::kRecordLength, 20), "trailing-bytes",
                           kSoundPoints));
}

void add_header_sizes(DamagedFiles& files) {
  for (int minor = 0; minor <= 5; ++minor) {
    const std::string sound = sound_las(minor, 0);
    const auto own = static_cast<std::uint16_t>(kHeaderBytes[static_cast<std::size_t>(minor)]);
    const auto named = [&](std::uint16_t size) {
      return "las-header-size-1." + std::to_string(minor) + "-" + std::to_string(size);
    };
    const auto least = static_cast<std::uint16_t>(minor >= 4 ? 375 : 227);
    for (const std::uint16_t size : {std::uint16_t{0}, std::uint16_t{1}, std::uint16_t{95}, std::uint16_t{96},
                                     static_cast<std::uint16_t>(least - 1)}) {
      files.push_back(refused(named(size), with(sound, las_at::kHeaderSize, size)).at(las_at::kHeaderSize));
    }
    // One byte more, and the points begin within the header.
    files.push_back(
        refused(named(own + 1), with<std::uint16_t>(sound, las_at::kHeaderSize, own + 1)).at(las_at::kOffsetToPoints));
    files.push_back(refused(named(65535), with<std::uint16_t>(sound, las_at::kHeaderSize, 65535)));
  }
  // Writers that kept the header of an older version.
  files.push_back(reported("las-header-of-1.2-in-1.3", with<char>(sound_las(2, 3), las_at::kMinor, 3), "header-size",
                           kSoundPoints));
  files.push_back(reported("las-header-of-1.4-in-1.5", with<char>(sound_las(4, 6), las_at::kMinor, 5), "header-size",
                           kSoundPoints));
  files.push_back(
      refused("las-header-of-1.3-in-1.4", with<char>(sound_las(3, 4), las_at::kMinor, 4)).at(las_at::kHeaderSize));
}

/// Longer headers are legal; what they hold behind the version's own fields is not ours to read.
void add_padded_headers(DamagedFiles& files) {
  for (const std::size_t padding : {std::size_t{1}, std::size_t{2}, std::size_t{200}, std::size_t{60000}}) {
    LasPlan plan = sound_plan(2, 3);
    plan.header_padding = padding;  // Filled with 0x5a, also where 1.4 has its counts.
    files.push_back(read_whole("las-header-padded-" + std::to_string(padding), sound_las(plan), kSoundPoints));
  }
}

}  // namespace

DamagedFiles las_size_cases() {
  DamagedFiles files;
  add_record_lengths(files);
  add_long_records(files);
  add_header_sizes(files);
  add_padded_headers(files);
  return files;
}

}  // namespace arris::test
