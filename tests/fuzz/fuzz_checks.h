#pragma once
/// @file What must hold whatever the bytes are.

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "fuzz_entries.h"
#include "io/input_file.h"
#include "io/point_source.h"

namespace arris::test {

/// Throws std::logic_error.
void require(bool holds, const char* what);

std::shared_ptr<const io::InputFile> file_of(FuzzBytes bytes);

/// Printable, of one line, in the shape of refusals.
void require_refusal(std::string_view message);
void require_problems(const std::vector<io::Problem>& problems);

/// One reading of all points, and what it must have in common with other readings.
struct Reading {
  bool opened = false;
  bool refused = false;
  std::string message{};  ///< Of the refusal.
  std::uint64_t points = 0;
  std::uint64_t hash = 0;  ///< Of all coordinates, bit by bit, in order.
};

/// Reads all points, `batch_points` at a time, and requires batches and records to be as described.
Reading read_points(const std::shared_ptr<const io::InputFile>& file, io::Tolerance tolerance,
                    const io::ReadOptions& options);

/// Reads the file in several ways that must agree: batches large and small, with records and without, as numbers, and
/// under every tolerance, of which the laxer may not read less. What salvaging promises when it opens a file it must
/// deliver, unless the vertices turn out to be out of step with the header.
void require_consistent_readings(FuzzBytes bytes);

}  // namespace arris::test
