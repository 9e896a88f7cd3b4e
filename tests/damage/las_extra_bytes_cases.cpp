/// @file Descriptions of extra bytes: what they claim against what the records hold.

#include "damaged_file.h"
#include "sound_las.h"

namespace arris::test {
namespace {

/// A file whose records have `present` extra bytes and whose descriptions are the given payloads.
std::string described(std::size_t present, const std::vector<std::string>& payloads) {
  LasPlan plan = sound_plan(4, 6, kSoundPoints, present);
  for (const std::string& payload : payloads) plan.vlrs.push_back({"LASF_Spec", 4, payload, "Extra Bytes"});
  return sound_las(plan);
}

void add_claims(DamagedFiles& files) {
  files.push_back(read_whole("las-extra-sound", described(3, {extra_entry(1, "a") + extra_entry(3, "b")})));
  files.push_back(read_whole("las-extra-undescribed", described(200, {})));
  files.push_back(read_whole("las-extra-partly-described", described(9, {extra_entry(10, "time")})));
  const auto too_much = [&](const std::string& name, std::size_t present, const std::string& payload) {
    files.push_back(reported("las-extra-claims-" + name, described(present, {payload}), "extra-bytes-mismatch"));
  };
  too_much("one-byte-of-none", 0, extra_entry(1, "a"));
  too_much("one-byte-more", 7, extra_entry(10, "time"));
  too_much("255-undocumented", 254, extra_entry(0, "raw", 255));
  too_much("three-doubles", 23, extra_entry(30, "vector"));
  std::string all;
  for (int i = 0; i < 341; ++i) all += extra_entry(30, "v");  // The most that fit one record: 8184 bytes.
  too_much("341-vectors", 8183, all);
}

void add_types(DamagedFiles& files) {
  for (const int type : {31, 32, 63, 64, 127, 128, 200, 254, 255}) {
    files.push_back(reported("las-extra-type-" + std::to_string(type), described(8, {extra_entry(type, "odd")}),
                             "extra-bytes-type"));
    files.push_back(reported("las-extra-type-second-" + std::to_string(type),
                             described(8, {extra_entry(1, "a") + extra_entry(type, "odd")}), "extra-bytes-type"));
  }
  for (const int type : {11, 20, 21, 30})  // Tuples, deprecated but defined.
    files.push_back(read_whole("las-extra-type-" + std::to_string(type), described(24, {extra_entry(type, "v")})));
  files.push_back(read_whole("las-extra-undocumented-of-0", described(4, {extra_entry(0, "nothing", 0)})));
}

void add_lengths(DamagedFiles& files) {
  const std::string entry = extra_entry(1, "a");
  for (const std::size_t length : {1U, 4U, 191U, 193U, 383U}) {
    std::string payload = entry + entry;
    payload.resize(length);
    files.push_back(
        reported("las-extra-payload-" + std::to_string(length), described(4, {payload}), "extra-bytes-length"));
  }
  files.push_back(read_whole("las-extra-payload-0", described(4, {""})));
  files.push_back(reported("las-extra-payload-65535", described(4, {std::string(65535, '\0')}), "extra-bytes-length"));
  files.push_back(read_whole("las-extra-two-records", described(3, {entry, extra_entry(3, "b")})));
  files.push_back(reported("las-extra-two-records-first-odd", described(3, {entry + "?", extra_entry(3, "b")}),
                           "extra-bytes-length"));
}

void add_names(DamagedFiles& files) {
  std::string unended = extra_entry(1, std::string(32, 'n'));
  unended.replace(160, 32, std::string(32, 'd'));
  files.push_back(read_whole("las-extra-name-without-end", described(1, {unended})));
  files.push_back(read_whole("las-extra-name-empty", described(1, {extra_entry(1, "")})));
  files.push_back(read_whole("las-extra-name-control", described(1, {extra_entry(1, "\x1b[2J\n\r\x7f\xfe")})));
  files.push_back(read_whole("las-extra-name-ours", described(1, {extra_entry(1, "EdgeClass")})));
  files.push_back(read_whole("las-extra-name-twice", described(2, {extra_entry(1, "a") + extra_entry(1, "a")})));
  std::string noise = extra_entry(1, "a");
  for (std::size_t i = 36; i < 160; ++i) noise[i] = '\xff';  // No-data, least, largest, scale, offset.
  files.push_back(read_whole("las-extra-ranges-all-ones", described(1, {noise})));
}

/// Descriptions of nothing that take far more room than any record could need.
void add_bomb(DamagedFiles& files) {
  LasPlan plan = sound_plan(4, 6, kSoundPoints, 4);
  for (int i = 0; i < 400; ++i) plan.evlrs.push_back({"LASF_Spec", 4, std::string(341 * 192, '\0'), ""});
  files.push_back(reported("las-extra-bomb", sound_las(plan), "extra-bytes-many", kSoundPoints));
}

/// Thousands of attributes, all of one byte and one name, and as many with names of their own.
void add_many_attributes(DamagedFiles& files) {
  constexpr int kRecords = 20, kPerRecord = 341;
  LasPlan plan = sound_plan(4, 6, 1, kRecords * kPerRecord);
  for (const bool same : {true, false}) {
    plan.vlrs.clear();
    for (int r = 0; r < kRecords; ++r) {
      std::string payload;
      for (int i = 0; i < kPerRecord; ++i)
        payload += extra_entry(1, same ? "same" : std::to_string(r * kPerRecord + i));
      plan.vlrs.push_back({"LASF_Spec", 4, std::move(payload), ""});
    }
    files.push_back(read_whole(same ? "las-extra-6820-same-names" : "las-extra-6820-names", sound_las(plan), 1));
  }
}

void add_behind_points(DamagedFiles& files) {
  LasPlan plan = sound_plan(4, 6, kSoundPoints, 3);
  plan.vlrs = {{"LASF_Spec", 4, extra_entry(1, "a")}};
  plan.evlrs = {{"LASF_Spec", 4, extra_entry(3, "b")}};
  files.push_back(read_whole("las-extra-in-evlr", sound_las(plan)));
  plan.evlrs = {{"LASF_Spec", 4, extra_entry(5, "b")}};
  files.push_back(reported("las-extra-in-evlr-claims-more", sound_las(plan), "extra-bytes-mismatch"));
}

}  // namespace

DamagedFiles las_extra_bytes_cases() {
  DamagedFiles files;
  add_claims(files);
  add_types(files);
  add_lengths(files);
  add_names(files);
  add_bomb(files);
  add_many_attributes(files);
  add_behind_points(files);
  return files;
}

}  // namespace arris::test
