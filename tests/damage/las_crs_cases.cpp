/// @file Records of the coordinate reference system. Nothing in them may keep points from being read.

#include "damaged_file.h"
#include "sound_las.h"

namespace arris::test {
namespace {

constexpr std::uint16_t kWkt = 2112, kKeys = 34735, kDoubles = 34736, kTexts = 34737;

struct GeoKey {
  std::uint16_t key, location, count, value;
};

/// A GeoTIFF directory that claims `claimed` keys, whatever it holds.
std::string directory(std::uint16_t claimed, const std::vector<GeoKey>& keys) {
  std::string bytes(8 + 8 * keys.size(), '\0');
  put<std::uint16_t>(bytes, 0, 1);
  put<std::uint16_t>(bytes, 2, 1);
  put<std::uint16_t>(bytes, 6, claimed);
  for (std::size_t i = 0; i < keys.size(); ++i) {
    put(bytes, 8 + 8 * i, keys[i].key);
    put(bytes, 10 + 8 * i, keys[i].location);
    put(bytes, 12 + 8 * i, keys[i].count);
    put(bytes, 14 + 8 * i, keys[i].value);
  }
  return bytes;
}

TestVlr projection(std::uint16_t id, std::string payload) {
  return {"LASF_Projection", id, std::move(payload), ""};
}

std::string located(std::vector<TestVlr> vlrs) {
  LasPlan plan = sound_plan(2, 1);
  plan.vlrs = std::move(vlrs);
  return sound_las(plan);
}

void add_key_directories(DamagedFiles& files) {
  const std::vector<GeoKey> one{{3072, 0, 1, 32632}};
  const auto add = [&](const std::string& name, std::vector<TestVlr> vlrs, const char* code = nullptr) {
    const std::string bytes = located(std::move(vlrs));
    files.push_back(code ? reported("las-crs-keys-" + name, bytes, code, kSoundPoints)
                         : read_whole("las-crs-keys-" + name, bytes, kSoundPoints));
  };
  add("sound", {projection(kKeys, directory(1, one))});
  add("of-0-bytes", {projection(kKeys, "")});
  for (const std::size_t size : {1U, 2U, 6U, 7U, 15U})
    add("of-" + std::to_string(size) + "-bytes", {projection(kKeys, directory(1, one).substr(0, size))}, "crs-keys");
  add("of-17-bytes", {projection(kKeys, directory(1, one) + "?")});
  add("count-2", {projection(kKeys, directory(2, one))}, "crs-keys");
  add("count-65535", {projection(kKeys, directory(65535, one))}, "crs-keys");
  add("count-0", {projection(kKeys, directory(0, one))});
  add("text-behind-end", {projection(kKeys, directory(1, {{1026, kTexts, 4, 100}})), projection(kTexts, "name|")});
  add("text-beyond-end", {projection(kKeys, directory(1, {{1026, kTexts, 65535, 2}})), projection(kTexts, "name|")});
  add("text-of-absent-record", {projection(kKeys, directory(1, {{1026, kTexts, 4, 0}}))});
  add("text-empty", {projection(kKeys, directory(1, {{1026, kTexts, 0, 0}})), projection(kTexts, "")});
  add("text-control",
      {projection(kKeys, directory(1, {{1026, kTexts, 9, 0}})), projection(kTexts, "\x1b[2J\nab\xff|")});
  add("doubles-behind-end",
      {projection(kKeys, directory(1, {{2057, kDoubles, 1, 65535}})), projection(kDoubles, "1234567")});
  add("location-unknown", {projection(kKeys, directory(2, {{1024, 1, 1, 1}, {3072, 65535, 65535, 65535}}))});
  add("code-0-and-user-defined", {projection(kKeys, directory(2, {{2048, 0, 1, 0}, {3072, 0, 1, 32767}}))});
}

/// As many keys as one record holds.
constexpr std::uint16_t kCitations = 8190;

/// A directory of citations, each a longer piece of the same text.
void add_citation_bomb(DamagedFiles& files) {
  std::string text(65535, ' ');
  std::uint32_t state = 1;
  for (char& c : text) {
    state = state * 1664525U + 1013904223U;
    c = static_cast<char>('a' + (state >> 24) % 26);
  }
  std::vector<GeoKey> keys;
  for (std::uint16_t i = 0; i < kCitations; ++i)
    keys.push_back({1026, kTexts, 65535, static_cast<std::uint16_t>(kCitations - i)});
  files.push_back(read_whole("las-crs-citation-bomb",
                             located({projection(kKeys, directory(kCitations, keys)), projection(kTexts, text)}),
                             kSoundPoints));
}

void add_wkt(DamagedFiles& files) {
  LasPlan plan = sound_plan(4, 6);
  const std::string wkt = "PROJCS[\"place\",GEOGCS[\"g\",UNIT[\"degree\",0.0174]],UNIT[\"metre\",1]]";
  const auto add = [&](const std::string& name, const std::string& text, const char* code = nullptr) {
    plan.vlrs = {projection(kWkt, text)};
    const std::string bytes = sound_las(plan);
    files.push_back(code ? reported("las-crs-wkt-" + name, bytes, code, kSoundPoints)
                         : read_whole("las-crs-wkt-" + name, bytes, kSoundPoints));
  };
  add("sound", wkt + '\0');
  add("without-end", wkt);
  add("empty", "", "crs-empty");
  add("only-nul", std::string(7, '\0'), "crs-empty");
  add("cut", wkt.substr(0, 20));
  add("noise", "\xff\xfe\x1b[31m\x01\n\"[[[,,]]\"");
  add("only-opening", std::string(65000, '['));
  add("only-quotes", std::string(65001, '"'));
  std::string deep;
  for (int i = 0; i < 8000; ++i) deep += "UNIT[\"u\",";
  add("deep", deep.substr(0, 65000));
}

void add_several(DamagedFiles& files) {
  LasPlan plan = sound_plan(4, 6);
  const TestVlr keys = projection(kKeys, directory(1, {{3072, 0, 1, 32632}}));
  plan.vlrs = {keys, projection(kWkt, "LOCAL_CS[\"a\"]")};
  files.push_back(reported("las-crs-both", sound_las(plan), "crs-both", kSoundPoints));
  plan.vlrs = {projection(kWkt, ""), projection(kWkt, "LOCAL_CS[\"a\"]")};
  files.push_back(reported("las-crs-first-empty", sound_las(plan), "crs-empty", kSoundPoints));
  plan.vlrs = {};
  plan.evlrs = {projection(kWkt, "LOCAL_CS[\"a\"]")};
  files.push_back(read_whole("las-crs-in-evlr", sound_las(plan), kSoundPoints));
  plan.evlrs = {projection(kWkt, std::string(200000, 'w'))};
  files.push_back(read_whole("las-crs-in-evlr-of-200-kB", sound_las(plan), kSoundPoints));
  files.push_back(reported("las-crs-wkt-bit-missing", with<std::uint16_t>(sound_las(4, 6), las_at::kGlobalEncoding, 0),
                           "wkt-bit", kSoundPoints));
}

}  // namespace

DamagedFiles las_crs_cases() {
  DamagedFiles files;
  add_key_directories(files);
  add_citation_bomb(files);
  add_wkt(files);
  add_several(files);
  return files;
}

}  // namespace arris::test
