/// @file Offsets of points, extended records and waveforms: within the header, within other data, behind the end,
/// and so large that sums wrap.

#include <limits>

#include "damaged_file.h"
#include "sound_las.h"

namespace arris::test {
namespace {

constexpr std::uint64_t kMax64 = std::numeric_limits<std::uint64_t>::max();

LasPlan plan_with_records() {
  LasPlan plan = sound_plan(4, 6);
  plan.vlrs = {{"one", 1, "first payload"}, {"two", 2, "second payload"}};
  plan.gap = std::string(64, 'g');
  plan.evlrs = {{"far", 3, "payload behind the points"}};
  return plan;
}

void add_point_offsets(DamagedFiles& files) {
  const std::string sound = sound_las(plan_with_records());
  const auto size = static_cast<std::uint32_t>(sound.size());
  const auto named = [](std::uint32_t offset) { return "las-points-at-" + std::to_string(offset); };
  const auto moved = [&](std::uint32_t offset) { return with(sound, las_at::kOffsetToPoints, offset); };
  files.push_back(read_whole("las-records-and-gap-sound", sound, kSoundPoints));
  for (const std::uint32_t offset : {0U, 1U, 96U, 374U})
    files.push_back(refused(named(offset), moved(offset)).at(las_at::kOffsetToPoints));
  // Points that begin within the variable-length records.
  for (const std::uint32_t offset : {375U, 375U + 53U, 375U + 54U + 12U, 375U + 67U + 1U})
    files.push_back(reported(named(offset), moved(offset), "vlr-overrun", kSoundPoints));
  for (const std::uint32_t offset : {size + 1U, 1U << 31, std::numeric_limits<std::uint32_t>::max()})
    files.push_back(refused(named(offset), moved(offset)).at(las_at::kOffsetToPoints));
  files.push_back(refused("las-points-at-file-end", moved(size)).salvaged(0));
  files.push_back(refused("las-points-at-last-byte", moved(size - 1)).salvaged(0));
  files.push_back(refused("las-points-at-last-record", moved(size - 30)).salvaged(1));
}

void add_evlr_offsets(DamagedFiles& files) {
  const std::string sound = sound_las(plan_with_records());
  const std::uint64_t points_begin = get<std::uint32_t>(sound, las_at::kOffsetToPoints);
  const std::uint64_t size = sound.size();
  const auto add = [&](const std::string& where, std::uint64_t offset, const char* code) {
    files.push_back(reported("las-evlrs-at-" + where, with(sound, las_at::kEvlrStart, offset), code, kSoundPoints));
  };
  add("0", 0, "evlr-overlap");
  add("1", 1, "evlr-overlap");
  add("header-last-byte", 374, "evlr-overlap");
  add("points-begin", points_begin, "evlr-overlap");
  add("second-point", points_begin + 30, "evlr-overlap");
  add("last-point-byte", points_begin + 30 * kSoundPoints - 1, "evlr-overlap");
  add("last-byte", size - 1, "evlr-overrun");
  add("file-end", size, "evlr-overrun");
  add("behind-file-end", size + 1, "evlr-overrun");
  add("2^32", std::uint64_t{1} << 32, "evlr-overrun");
  add("2^63", std::uint64_t{1} << 63, "evlr-overrun");
  // Plus the 60 bytes of a record's header these are 2^64, 0, 59.
  add("2^64-61", kMax64 - 60, "evlr-overrun");
  add("2^64-60", kMax64 - 59, "evlr-overrun");
  add("2^64-1", kMax64, "evlr-overrun");
}

/// Waveform data need not be there: descriptors may point to another file.
void add_waveform_offsets(DamagedFiles& files) {
  const std::string sound = sound_las(3, 4);
  for (const std::uint64_t offset :
       {std::uint64_t{1}, std::uint64_t{234}, std::uint64_t{235}, std::uint64_t{300}, std::uint64_t{sound.size()},
        std::uint64_t{sound.size() + 1}, std::uint64_t{1} << 63, kMax64}) {
    files.push_back(read_whole("las-waveforms-at-" + std::to_string(offset),
                               with(sound, las_at::kWaveformStart, offset), kSoundPoints));
  }
}

void add_gaps(DamagedFiles& files) {
  for (const std::size_t gap : {1U, 2U, 53U, 1U << 20}) {
    LasPlan plan = sound_plan(1, 1);
    plan.gap = std::string(gap, '\xdd');
    files.push_back(read_whole("las-gap-" + std::to_string(gap), sound_las(plan), kSoundPoints));
  }
  LasPlan oldest = sound_plan(0, 0);
  oldest.gap = "\xdd\xcc";  // The mark that LAS 1.0 puts before its points.
  files.push_back(read_whole("las-1.0-start-mark", sound_las(oldest), kSoundPoints));
}

}  // namespace

DamagedFiles las_offset_cases() {
  DamagedFiles files;
  add_point_offsets(files);
  add_evlr_offsets(files);
  add_waveform_offsets(files);
  add_gaps(files);
  return files;
}

}  // namespace arris::test
