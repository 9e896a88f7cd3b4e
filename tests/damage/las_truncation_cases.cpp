/// @file LAS files cut at every border of their fields.

#include <vector>

#include "damaged_file.h"
#include "sound_las.h"

namespace arris::test {
namespace {

/// Where fields of the header begin; behind 227 those of 1.3, behind 235 those of 1.4.
constexpr std::size_t kHeaderBorders[] = {0,   4,   6,   8,   12,  14,  16,  24,  25,  26,  58,  90,  92,  94,
                                          96,  100, 104, 105, 107, 111, 115, 119, 123, 127, 131, 139, 147, 155,
                                          163, 171, 179, 187, 195, 203, 211, 219, 227, 235, 243, 247, 255};

/// Where fields of a record of point format 6 begin.
constexpr std::size_t kPointBorders[] = {0, 4, 8, 12, 14, 15, 16, 17, 18, 20, 22, 30, 31};

constexpr std::size_t kVlrBorders[] = {0, 2, 18, 20, 22, 54};
constexpr std::size_t kEvlrBorders[] = {0, 2, 18, 20, 28, 60};

std::string cut_name(const std::string& what, std::size_t size) {
  return "las-cut-" + what + "-at-" + std::to_string(size);
}

void add_header_cuts(DamagedFiles& files) {
  for (const auto& [minor, format] : {std::pair{2, 3}, {4, 6}}) {
    const std::string sound = sound_las(minor, format);
    const std::string what = "header-1." + std::to_string(minor);
    const std::size_t whole = kHeaderBytes[static_cast<std::size_t>(minor)];
    for (const std::size_t border : kHeaderBorders) {
      if (border < whole) files.push_back(refused(cut_name(what, border), sound.substr(0, border)));
    }
    files.push_back(refused(cut_name(what, whole - 1), sound.substr(0, whole - 1)));
  }
}

void add_record_cuts(DamagedFiles& files) {
  LasPlan plan = sound_plan(4, 6);
  plan.vlrs = {{"one", 1, "first payload"}, {"two", 2, "second payload"}};
  const std::string sound = sound_las(plan);
  const std::size_t second = 375 + 54 + 13;
  for (const std::size_t begin : {std::size_t{375}, second}) {
    for (const std::size_t border : kVlrBorders)
      files.push_back(refused(cut_name("vlr", begin + border), sound.substr(0, begin + border)));
  }
}

/// Whole points before the cut can be salvaged; those of the last two records are one and two fewer than counted.
void add_point_cuts(DamagedFiles& files) {
  const std::string sound = sound_las(4, 6, kSoundPoints, 1);
  const std::size_t record = 31;
  for (std::size_t lost = 2; lost >= 1; --lost) {
    for (const std::size_t border : kPointBorders) {
      const std::size_t size = sound.size() - lost * record + border;
      const bool whole = border == record;
      if (whole && lost == 2) continue;  // The same as the next record's first border.
      if (whole) {
        files.push_back(read_whole(cut_name("points", size), sound.substr(0, size), kSoundPoints));
      } else {
        files.push_back(refused(cut_name("points", size), sound.substr(0, size)).salvaged(kSoundPoints - lost));
      }
    }
  }
  files.push_back(refused("las-cut-before-points", sound.substr(0, 375)).salvaged(0));
}

/// Points before the cut are whole: extended records are lost, not points.
void add_evlr_cuts(DamagedFiles& files) {
  LasPlan plan = sound_plan(4, 6);
  plan.evlrs = {{"one", 1, "first payload"}, {"two", 2, "second payload"}};
  const std::string sound = sound_las(plan);
  const std::size_t first = 375 + 30 * kSoundPoints;
  const std::size_t second = first + 60 + 13;
  for (const std::size_t begin : {first, second}) {
    for (const std::size_t border : kEvlrBorders) {
      files.push_back(
          reported(cut_name("evlr", begin + border), sound.substr(0, begin + border), "evlr-overrun", kSoundPoints));
    }
  }
  files.push_back(reported("las-cut-evlr-last-byte", sound.substr(0, sound.size() - 1), "evlr-overrun", kSoundPoints));
}

}  // namespace

DamagedFiles las_truncation_cases() {
  DamagedFiles files;
  add_header_cuts(files);
  add_record_cuts(files);
  add_point_cuts(files);
  add_evlr_cuts(files);
  return files;
}

}  // namespace arris::test
