/// @file What a file says it is: magic, version, point format, compression.

#include "damaged_file.h"
#include "sound_las.h"

namespace arris::test {
namespace {

void add_magic(DamagedFiles& files) {
  const std::string sound = sound_las(2, 0);
  for (const std::string magic : {"LASf", "lasf", "FSAL", "LAS ", "\xffLAS"}) {
    std::string bytes = sound;
    bytes.replace(0, 4, magic);
    files.push_back(refused("las-magic-" + std::to_string(files.size()), bytes).at(0));
  }
  files.push_back(refused("las-magic-nul", with<std::uint32_t>(sound, 0, 0)).at(0));
  files.push_back(refused("las-one-byte-before", "\n" + sound).at(0));
  files.push_back(refused("las-one-byte-lost", sound.substr(1)).at(0));
  files.push_back(refused("las-empty-file", "").at(0));
  files.push_back(refused("las-all-zero", std::string(1000, '\0')).at(0));
}

void add_versions(DamagedFiles& files) {
  const std::string sound = sound_las(2, 0);
  for (const int major : {0, 2, 3, 128, 255}) {
    files.push_back(
        refused("las-version-" + std::to_string(major) + ".2", with(sound, las_at::kMajor, static_cast<char>(major)))
            .at(las_at::kMajor));
  }
  for (const int minor : {6, 7, 128, 255}) {
    files.push_back(
        refused("las-version-1." + std::to_string(minor), with(sound, las_at::kMinor, static_cast<char>(minor)))
            .at(las_at::kMajor));
  }
  // Counts and records of the newer version are not there for the older one.
  files.push_back(
      reported("las-1.4-called-1.2", with<char>(sound_las(4, 6), las_at::kMinor, 2), "point-format-version", 0)
          .salvaged(kSoundPoints, "count-zero"));
  files.push_back(reported("las-1.2-called-1.0", with<char>(sound_las(2, 3), las_at::kMinor, 0), "point-format-version",
                           kSoundPoints));
  files.push_back(refused("las-1.2-called-1.4", with<char>(sound, las_at::kMinor, 4)).at(las_at::kHeaderSize));
}

void add_point_formats(DamagedFiles& files) {
  const std::string sound = sound_las(4, 0);
  const auto with_format = [&](int format) { return with(sound, las_at::kPointFormat, static_cast<char>(format)); };
  for (const int format : {11, 12, 15, 16, 31, 32, 62, 63}) {
    files.push_back(
        refused("las-point-format-" + std::to_string(format), with_format(format)).at(las_at::kPointFormat));
  }
  for (const int format : {0x40, 0x43, 0x80, 0x83, 0x86, 0xC0, 0xFF}) {
    files.push_back(
        refused("las-compression-bits-" + std::to_string(format), with_format(format)).at(las_at::kPointFormat));
  }
  for (int format = 1; format <= 10; ++format) {
    files.push_back(refused("las-records-too-short-for-format-" + std::to_string(format), with_format(format))
                        .at(las_at::kRecordLength));
  }
}

/// Formats older than their version: read as the version that introduced them defines them.
void add_early_formats(DamagedFiles& files) {
  for (const auto& [minor, format] : {std::pair{0, 2}, {1, 3}, {2, 4}, {2, 5}, {0, 6}, {3, 6}, {3, 10}}) {
    files.push_back(reported("las-format-" + std::to_string(format) + "-in-1." + std::to_string(minor),
                             sound_las(minor, format), "point-format-version"));
  }
}

}  // namespace

DamagedFiles las_identity_cases() {
  DamagedFiles files;
  add_magic(files);
  add_versions(files);
  add_point_formats(files);
  add_early_formats(files);
  return files;
}

}  // namespace arris::test
