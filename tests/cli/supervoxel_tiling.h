#pragma once
/// @file What the law of exact tiling is held up with for supervoxels and for the method zheng.

#include <string>
#include <vector>

#include "tiling_matrix.h"

namespace arris::test {

/// Labels, table and adjacency.
inline TilingRun supervoxel_run(const std::vector<std::string>& options, int caps_divisor) {
  return {"supervoxel", options, {{"--table", ".csv"}, {"--adjacency", ".csv"}}, caps_divisor};
}

/// @param options  beside the method.
inline TilingRun zheng_run(std::vector<std::string> options, int caps_divisor) {
  options.insert(options.begin(), {"--method", "zheng"});
  return {"extract", options, {}, caps_divisor};
}

}  // namespace arris::test
