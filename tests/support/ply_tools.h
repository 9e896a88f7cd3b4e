#pragma once
/// @file A minimal handling of binary PLY files, independent of the library under test.

#include <filesystem>
#include <vector>

namespace arris::test {

/// Cuts a PLY file of vertices of one size, and nothing else, into `parts` files of consecutive vertices with the same
/// header; returns their paths.
std::vector<std::filesystem::path> split_ply_file(const std::filesystem::path& path, int parts,
                                                  const std::filesystem::path& folder);

}  // namespace arris::test
