#include "tiling/manifest.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string_view>

#include "tiling/checked_file.h"

namespace arris::tiling {
namespace {

using nlohmann::json;

constexpr int kVersion = 1;
constexpr std::size_t kCheckChars = 17;  // 16 hexadecimal digits and a blank.

std::filesystem::path manifest_path(const std::filesystem::path& folder) {
  return folder / "manifest.jsonl";
}

std::string check_of(std::string_view text) {
  Hasher hasher;
  hasher.update(text.data(), text.size());
  return fmt::format("{:016x} ", hasher.digest());
}

json header(const Lattice& lattice, std::size_t tiles, const std::string& parameters_hash) {
  // Hexadecimal floats: equal text means equal bits.
  const auto exact = [](double value) { return fmt::format("{:a}", value); };
  return {{"arris_tiles", kVersion},
          {"step", exact(lattice.step)},
          {"origin", {exact(lattice.origin[0]), exact(lattice.origin[1]), exact(lattice.origin[2])}},
          {"tiles", tiles},
          {"parameters", parameters_hash}};
}

json as_json(const LatticeBox& box) {
  return {box.min[0], box.min[1], box.min[2], box.max[0], box.max[1], box.max[2]};
}

/// The JSON of a line whose checksum fits.
std::optional<json> parse_line(const std::string& line) {
  if (line.size() < kCheckChars) return std::nullopt;
  const std::string_view text = std::string_view(line).substr(kCheckChars);
  if (line.compare(0, kCheckChars, check_of(text)) != 0) return std::nullopt;
  json value = json::parse(text, nullptr, /*allow_exceptions=*/false);
  if (!value.is_object()) return std::nullopt;
  return value;
}

}  // namespace

Manifest::Manifest(const std::filesystem::path& folder, const Lattice& lattice, std::size_t tiles,
                   const std::string& parameters_hash)
    : path_(manifest_path(folder)) {
  descriptor_ = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_APPEND | O_CLOEXEC | O_NOFOLLOW, 0600);
  if (descriptor_ < 0) throw_io_error(path_, "open", errno);
  try {
    append_line(header(lattice, tiles, parameters_hash).dump(-1, ' ', true, json::error_handler_t::replace));
  } catch (...) {
    ::close(descriptor_);
    throw;
  }
}

Manifest::~Manifest() {
  ::close(descriptor_);
}

void Manifest::append(const ManifestEntry& entry, const PlannedTile& tile) {
  const json line = {{"tile", entry.tile},         {"points", entry.points},
                     {"bytes", entry.size_bytes},  {"xxh3", fmt::format("{:016x}", entry.xxh3)},
                     {"core", as_json(tile.core)}, {"covered", as_json(tile.covered)}};
  append_line(line.dump());
}

void Manifest::append_line(std::string line) {
  line = check_of(line) + line + "\n";
  std::string_view rest = line;
  while (!rest.empty()) {
    const ssize_t wrote = ::write(descriptor_, rest.data(), rest.size());
    if (wrote < 0 && errno == EINTR) continue;
    if (wrote <= 0) throw_io_error(path_, "write", wrote == 0 ? ENOSPC : errno, rest.size());
    rest.remove_prefix(static_cast<std::size_t>(wrote));
  }
  if (::fdatasync(descriptor_) != 0) throw_io_error(path_, "fdatasync", errno);
}

std::optional<std::map<std::size_t, ManifestEntry>> read_manifest(const std::filesystem::path& folder,
                                                                  const Lattice& lattice, std::size_t tiles,
                                                                  const std::string& parameters_hash) {
  std::ifstream file(manifest_path(folder));
  std::string line;
  if (!std::getline(file, line)) return std::nullopt;
  const std::optional<json> first = parse_line(line);
  if (!first || *first != header(lattice, tiles, parameters_hash)) return std::nullopt;
  std::map<std::size_t, ManifestEntry> entries;
  while (std::getline(file, line)) {
    const std::optional<json> value = parse_line(line);
    if (!value) break;
    try {
      ManifestEntry entry;
      entry.tile = value->at("tile").get<std::size_t>();
      entry.points = value->at("points").get<std::uint64_t>();
      entry.size_bytes = value->at("bytes").get<std::uint64_t>();
      entry.xxh3 = std::stoull(value->at("xxh3").get<std::string>(), nullptr, 16);
      if (entry.tile < tiles) entries[entry.tile] = entry;
    } catch (const std::exception&) {
      break;
    }
  }
  return entries;
}

}  // namespace arris::tiling
