/// @file Sound files with a few random changes. Any may turn out readable; none may do anything but be read or refused.

#include <random>

#include "damaged_file.h"
#include "sound_las.h"
#include "sound_ply.h"

namespace arris::test {
namespace {

/// One to four changes: bytes replaced, removed, repeated; in half of them near the front, where the structure is.
std::string mutated(std::string bytes, std::mt19937& random) {
  const unsigned changes = 1 + random() % 4;
  for (unsigned i = 0; i < changes && !bytes.empty(); ++i) {
    const std::size_t reach = random() % 2 == 0 ? std::min<std::size_t>(bytes.size(), 400) : bytes.size();
    const std::size_t at = random() % reach;
    switch (random() % 6) {
      case 0:
        bytes[at] = static_cast<char>(random());
        break;
      case 1:
        bytes[at] = '\xff';
        break;
      case 2:
        bytes[at] = '\0';
        break;
      case 3:
        bytes[at] = static_cast<char>(bytes[at] ^ (1 << random() % 8));
        break;
      case 4:
        bytes.erase(at, 1 + random() % 8);
        break;
      default:
        bytes.insert(at, bytes.substr(random() % bytes.size(), 1 + random() % 16));
        break;
    }
  }
  if (random() % 8 == 0) bytes.resize(random() % (bytes.size() + 1));
  return bytes;
}

std::vector<std::string> las_seeds() {
  LasPlan records = sound_plan(4, 7, kSoundPoints, 3);
  records.vlrs = {{"LASF_Projection", 34735, std::string(24, '\1')},
                  {"LASF_Spec", 4, extra_entry(1, "a") + extra_entry(3, "b")}};
  records.evlrs = {{"LASF_Projection", 2112, "LOCAL_CS[\"a\"]"}};
  LasPlan waveforms = sound_plan(3, 4);
  waveforms.vlrs = {{"LASF_Spec", 100, std::string(26, '\2')}};
  return {sound_las(2, 3), sound_las(records), sound_las(waveforms)};
}

std::vector<std::string> ply_seeds() {
  const PlyTable faces{"face", {{"vertex_indices", "int", "uchar"}}, {{{0, 1, 2}}, {{3, 4}}}};
  std::vector<std::string> seeds;
  for (const std::string& format : kPlyFormats) {
    seeds.push_back(build_ply({format, "\n", {"comment c"}, {make_vertices({{"x"}, {"y", "double"}, {"z"}}, 10)}}));
    seeds.push_back(
        build_ply({format,
                   "\r\n",
                   {},
                   {faces, make_vertices({{"x"}, {"l", "short", "int"}, {"y"}, {"z"}, {"r", "uchar"}}, 10)}}));
  }
  return seeds;
}

void add_mutations(DamagedFiles& files, const std::string& kind, const std::vector<std::string>& seeds, int rounds) {
  for (std::size_t i = 0; i < seeds.size(); ++i) {
    std::mt19937 random(static_cast<unsigned>(1 + i));
    for (int round = 0; round < rounds; ++round) {
      files.push_back(read_or_refused(kind + "-mutated-" + std::to_string(i) + "-" + std::to_string(round),
                                      mutated(seeds[i], random)));
    }
  }
}

}  // namespace

DamagedFiles mutated_cases() {
  DamagedFiles files;
  add_mutations(files, "las", las_seeds(), 40);
  add_mutations(files, "ply", ply_seeds(), 20);
  return files;
}

}  // namespace arris::test
