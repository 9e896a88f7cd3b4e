#pragma once
/// @file What the fuzzers do with the bytes of one file. Each entry reads or refuses it; anything else, also what was
/// read being not what the bytes hold, is thrown as std::logic_error.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace arris::test {

using FuzzBytes = std::span<const std::uint8_t>;

/// Header, variable-length records, extra bytes and coordinate reference system of LAS, through the file's summary.
void fuzz_las_structure(FuzzBytes bytes);
/// Points of LAS under every tolerance, with records and as numbers.
void fuzz_las_points(FuzzBytes bytes);
/// Headers of PLY; written out again they must say the same.
void fuzz_ply_header(FuzzBytes bytes);
/// Vertices of PLY under every tolerance, with records and as numbers.
void fuzz_ply_body(FuzzBytes bytes);

struct FuzzTarget {
  const char* name;
  void (*entry)(FuzzBytes);
};
inline constexpr std::array<FuzzTarget, 4> kFuzzTargets{{{"fuzz_las_structure", fuzz_las_structure},
                                                         {"fuzz_las_points", fuzz_las_points},
                                                         {"fuzz_ply_header", fuzz_ply_header},
                                                         {"fuzz_ply_body", fuzz_ply_body}}};

}  // namespace arris::test
