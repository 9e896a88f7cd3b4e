#pragma once
/// @file What is to be expected of malformed files on disk, one line each: name, verdict, code, and the same when
/// salvaging, with its points.

#include <istream>
#include <ostream>
#include <sstream>
#include <string>

#include "damaged_file.h"

namespace arris::test {

inline constexpr const char* kDamageIndex = "INDEX.txt";

inline void write_index_line(std::ostream& out, const DamagedFile& file) {
  const auto write = [&](const Expectation& expected) {
    out << ' ' << static_cast<int>(expected.verdict) << ' ' << (expected.code.empty() ? "-" : expected.code) << ' '
        << (expected.points ? std::to_string(*expected.points) : "-");
  };
  out << file.name;
  write(file.usual);
  write(file.salvage);
  out << '\n';
}

/// Bytes stay empty. False behind the last line.
inline bool read_index_line(std::istream& in, DamagedFile& file) {
  const auto read = [&](Expectation& expected) {
    int verdict = 0;
    std::string points;
    in >> verdict >> expected.code >> points;
    expected.verdict = static_cast<Verdict>(verdict);
    expected.points.reset();
    if (points != "-") expected.points = std::stoull(points);
  };
  if (!(in >> file.name)) return false;
  read(file.usual);
  read(file.salvage);
  return static_cast<bool>(in);
}

}  // namespace arris::test
