#pragma once
/// @file Supervoxels and their neighbours as CSV or JSON files.

#include <cstdint>
#include <filesystem>
#include <span>
#include <utility>

#include "core/lattice.h"
#include "features/supervoxel/supervoxel_table.h"
#include "merge/supervoxel_moments.h"
#include "pipeline/text_rows.h"

namespace arris::pipeline {

/// id, points, centroid x y z, normal nx ny nz (0 0 0: none; the sign has no meaning), area and thickness (RMS distance
/// from the plane) in data units. CSV with a header line, or a JSON array of objects.
void write_supervoxel_table(const std::filesystem::path& path, const SupervoxelTable& table,
                            const merge::SupervoxelMoments& moments, const Lattice& lattice, bool overwrite);

/// Pairs a, b with a < b, ascending. CSV with a header line, or a JSON array of pairs.
void write_adjacency(const std::filesystem::path& path, std::span<const std::pair<std::uint32_t, std::uint32_t>> pairs,
                     bool overwrite);

}  // namespace arris::pipeline
