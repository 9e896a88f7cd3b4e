#pragma once
/// @file Runs of `arris supervoxel` and a naive reading of what they wrote.

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "support/arris_process.h"
#include "support/las_tools.h"

namespace arris::test {

/// `arris supervoxel INPUT -o OUTPUT OPTIONS... --overwrite -q`; expects success and silence.
void label(const std::filesystem::path& input, const std::filesystem::path& output,
           const std::vector<std::string>& options = {});

/// SupervoxelId of every record: the last four bytes.
std::vector<std::uint32_t> labels_of(const LasView& view);

/// Expects the ids 1 .. n and nothing else but `zeros` times 0; returns n.
std::uint32_t expect_dense(const std::vector<std::uint32_t>& labels, std::size_t zeros = 0);

/// Lines of a CSV file, split at commas; the header first.
std::vector<std::vector<std::string>> csv_of(const std::filesystem::path& path);

/// A square of n x n points, `spacing` steps apart, with a little noise upwards.
std::vector<std::array<std::int32_t, 3>> noisy_plate(int n, std::int32_t spacing);

}  // namespace arris::test
