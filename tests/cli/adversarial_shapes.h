#pragma once
/// @file Clouds that no scanner delivers on purpose, of any size, written in constant memory.

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace arris::test {

/// A cloud of about `points` points written into a folder; returns its files.
using ShapeWriter =
    std::function<std::vector<std::filesystem::path>(const std::filesystem::path& folder, std::uint32_t points)>;

struct AdversarialShape {
  std::string name;
  ShapeWriter write;
};

/// Every shape below.
const std::vector<AdversarialShape>& adversarial_shapes();
/// Throws std::out_of_range if there is none.
const AdversarialShape& adversarial_shape(const std::string& name);

}  // namespace arris::test
