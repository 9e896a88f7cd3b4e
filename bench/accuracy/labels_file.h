#pragma once
/// @file The cloud in and the labels out.

#include <filesystem>

#include "baseline.h"

namespace arris::bench {

/// All points of a LAS or PLY file. Throws the readers' errors, and InputError for a point that is not finite: the
/// peers do not define what they do with it.
Cloud read_cloud(const std::filesystem::path& path);

/// Writes every point in order as binary PLY with EdgeClass (1: edge, 0: not) and EdgeScore if there are scores, as
/// `arris extract --keep-all` does, so that `arris evaluate` judges all detectors alike. Replaces an existing file;
/// throws IoError.
void write_labels(const std::filesystem::path& path, const Cloud& cloud, const Labels& labels);

}  // namespace arris::bench
