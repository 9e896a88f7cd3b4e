#pragma once
/// @file The law of exact tiling: the same bytes come out whatever the tiles, threads, budget and split of the inputs.

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace arris::test {

struct TilingCase {
  std::string tile_points;  ///< A number or "none".
  int threads;
  std::string memory;  ///< Empty: the default.
  bool split;          ///< Input as five files instead of one.
};

/// Every combination of caps {20 000, 100 000, 1 000 000, none}, threads {1, 2, 4}, budgets {256 MiB, 1 GiB, default},
/// splits.
std::vector<TilingCase> whole_matrix();
/// Each value of each dimension at least twice (under sanitizers: the least).
std::vector<TilingCase> small_matrix();
/// One run untiled, one with everything different, one between. Under AddressSanitizer: the first two; under
/// ThreadSanitizer: two of many tiles and threads.
std::vector<TilingCase> least_matrix();

/// What is run for every case.
struct TilingRun {
  std::string verb = "extract";
  std::vector<std::string> options{};
  /// Options that take a file to write, with the ending of its name: {"--table", ".csv"}. Their bytes count too.
  std::vector<std::pair<std::string, std::string>> more_outputs{};
  int caps_divisor = 1;  ///< Makes tiles smaller for small clouds.
};

/// Runs every case and expects one and the same output, with points in it, and several tiles in one case at least.
/// @param scan  a LAS file, a binary PLY file without lists, or a folder of scans (which is not split).
void expect_same_bytes(const std::filesystem::path& scan, const std::vector<TilingCase>& cases, const TilingRun& run);

/// The same for extract.
void expect_same_bytes(const std::filesystem::path& scan, const std::vector<TilingCase>& cases, int caps_divisor = 1,
                       const std::vector<std::string>& options = {});

/// `arris synth ARGUMENTS... -o PATH` with the truth thrown away.
void synth_scan(const std::filesystem::path& path, std::vector<std::string> arguments);

/// A dense plate beside thin spray: sparse queries need more than their tile's halo and are answered from the
/// neighbours' files.
void write_spray(const std::filesystem::path& path);

/// A noisy fold whose points come once, twice or three times, the copies far apart in the file.
void write_duplicates(const std::filesystem::path& path);

/// A closed surface of boxes whose faces, edges and corners lie on multiples of 64 lattice steps, where tiles are cut.
void write_points_on_tile_faces(const std::filesystem::path& path);

}  // namespace arris::test
