#pragma once
/// @file Malformed scans made in code, each with what a reader must do with it. Nothing here comes from the library
/// under test: layouts and verdicts follow the specifications.

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace arris::test {

enum class Verdict : std::uint8_t {
  kRefused,   ///< An InputError says why.
  kReported,  ///< Read, and a problem of the stated code is reported.
  kRead,      ///< Read, with nothing to report.
  kEither,    ///< Random damage: read or refused, nothing else.
};

struct Expectation {
  Verdict verdict = Verdict::kRefused;
  std::string code{};                     ///< Of the problem; only if reported.
  std::optional<std::uint64_t> points{};  ///< To be delivered, if stated.
};

struct DamagedFile {
  std::string name;  ///< Unique; also the name of the file on disk.
  std::string bytes;
  Expectation usual;
  Expectation salvage;
  std::optional<std::uint64_t> byte{};  ///< That the refusal must name, if stated.

  /// Under strict reading every problem refuses the file.
  Expectation strict() const { return usual.verdict == Verdict::kReported ? Expectation{} : usual; }
  DamagedFile at(std::uint64_t fault) && {
    byte = fault;
    return std::move(*this);
  }
  /// What salvaging makes of it: the points that are there, as many as stated.
  DamagedFile salvaged(std::optional<std::uint64_t> points, std::string code = "points-lost") && {
    salvage = {Verdict::kReported, std::move(code), points};
    return std::move(*this);
  }
};

inline DamagedFile refused(std::string name, std::string bytes) {
  return {std::move(name), std::move(bytes), {}, {}};
}
inline DamagedFile reported(std::string name, std::string bytes, std::string code,
                            std::optional<std::uint64_t> points = std::nullopt) {
  const Expectation expected{Verdict::kReported, std::move(code), points};
  return {std::move(name), std::move(bytes), expected, expected};
}
inline DamagedFile read_whole(std::string name, std::string bytes, std::optional<std::uint64_t> points = std::nullopt) {
  const Expectation expected{Verdict::kRead, {}, points};
  return {std::move(name), std::move(bytes), expected, expected};
}
inline DamagedFile read_or_refused(std::string name, std::string bytes) {
  const Expectation expected{Verdict::kEither, {}, std::nullopt};
  return {std::move(name), std::move(bytes), expected, expected};
}

using DamagedFiles = std::vector<DamagedFile>;

/// Families, one file each.
DamagedFiles las_count_cases();
DamagedFiles las_size_cases();
DamagedFiles las_offset_cases();
DamagedFiles las_record_cases();
DamagedFiles las_extra_bytes_cases();
DamagedFiles las_crs_cases();
DamagedFiles las_coordinate_cases();
DamagedFiles las_identity_cases();
DamagedFiles las_truncation_cases();
DamagedFiles ply_header_cases();
DamagedFiles ply_header_bomb_cases();
DamagedFiles ply_count_cases();
DamagedFiles ply_list_cases();
DamagedFiles ply_ascii_cases();
DamagedFiles ply_truncation_cases();
DamagedFiles mutated_cases();

/// All of them, in a fixed order. Their bytes are the same on every machine.
const DamagedFiles& damaged_files();

}  // namespace arris::test
