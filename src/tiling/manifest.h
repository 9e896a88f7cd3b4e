#pragma once
/// @file The list of finished tiles of a store: one line of JSON per tile, each with its own checksum.

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "core/lattice.h"
#include "tiling/tile_plan.h"

namespace arris::tiling {

/// What the manifest knows of one tile file.
struct ManifestEntry {
  std::size_t tile = 0;
  std::uint64_t points = 0;      ///< Stored points, core and halo.
  std::uint64_t size_bytes = 0;  ///< Of the file.
  std::uint64_t xxh3 = 0;        ///< XXH3-64 of the file.

  friend bool operator==(const ManifestEntry&, const ManifestEntry&) = default;
};

/// "manifest.jsonl": a first line for the whole store (version, lattice, parameters' hash, number of tiles), then a
/// line per built tile. Lines are appended with one write each and synced; a line whose checksum does not fit (torn by
/// a crash) ends the list. Not thread-safe.
class Manifest {
 public:
  /// Starts a new manifest, replacing an old one. Throws IoError.
  Manifest(const std::filesystem::path& folder, const Lattice& lattice, std::size_t tiles,
           const std::string& parameters_hash);
  ~Manifest();
  Manifest(const Manifest&) = delete;
  Manifest& operator=(const Manifest&) = delete;

  void append(const ManifestEntry& entry, const PlannedTile& tile);

 private:
  void append_line(std::string line);

  std::filesystem::path path_;
  int descriptor_ = -1;
};

/// The intact entries of a folder's manifest by tile, if its first line is that of the same lattice, parameters and
/// number of tiles; nothing otherwise.
std::optional<std::map<std::size_t, ManifestEntry>> read_manifest(const std::filesystem::path& folder,
                                                                  const Lattice& lattice, std::size_t tiles,
                                                                  const std::string& parameters_hash);

}  // namespace arris::tiling
