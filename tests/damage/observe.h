#pragma once
/// @file Everything that a reader does with one file, as a value.

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "io/input_file.h"
#include "io/point_source.h"

namespace arris::test {

struct Observed {
  bool refused = false;
  std::string message{};  ///< Of the refusal.
  std::uint64_t points = 0;
  std::vector<io::Problem> problems{};        ///< Found at opening.
  std::vector<io::Problem> point_problems{};  ///< What the points show to be wrong.
  /// Contradictions in what was delivered, one line each; must be empty, refused or not.
  std::vector<std::string> contradictions{};
};

/// Opens, summarizes, reads all points with records and without, and as numbers. Errors other than InputError pass
/// through.
Observed observe(const std::shared_ptr<const io::InputFile>& file, io::Tolerance tolerance);
/// As the program does: a set of one file.
Observed observe_set(const std::filesystem::path& path, io::Tolerance tolerance);

std::shared_ptr<const io::InputFile> in_memory(const std::string& name, const std::string& bytes);

}  // namespace arris::test
