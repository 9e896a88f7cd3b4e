/// @file Writes the malformed files to a folder, and an index of what is to be expected of each: for tests that must
/// not hold them in memory, for the fuzzers' seeds, and for people.
///
///   write_damaged_files FOLDER [MOST_BYTES_PER_FILE]

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "damage_index.h"
#include "damaged_file.h"

int main(int argc, char** argv) {
  using namespace arris::test;
  if (argc < 2) {
    std::fprintf(stderr, "write_damaged_files FOLDER [MOST_BYTES_PER_FILE]\n");
    return 2;
  }
  const std::filesystem::path folder = argv[1];
  const std::size_t most_bytes = argc > 2 ? std::strtoull(argv[2], nullptr, 10) : SIZE_MAX;
  std::filesystem::create_directories(folder);
  std::ofstream index(folder / kDamageIndex);
  for (const DamagedFile& file : damaged_files()) {
    if (file.bytes.size() > most_bytes) continue;
    std::ofstream out(folder / file.name, std::ios::binary);
    out.write(file.bytes.data(), static_cast<std::streamsize>(file.bytes.size()));
    out.close();
    write_index_line(index, file);
    if (!out || !index) {
      std::fprintf(stderr, "write_damaged_files: %s cannot be written\n", (folder / file.name).c_str());
      return 1;
    }
  }
  return 0;
}
