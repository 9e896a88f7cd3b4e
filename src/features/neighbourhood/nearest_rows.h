#pragma once
/// @file Nearest neighbours among few candidates: each is put to its place in one piece.

#include "features/neighbourhood/nearest_select.h"

namespace arris {

/// Of the n <= kMostRanked candidates that were collected in the scratch: the query's position, then min(k, n - 1)
/// neighbours as select_nearest() orders them, then anything. Returns their number.
/// @param rows  room for kMostRanked.
std::size_t rank_rows(const PointTree& tree, const CandidateSet<float>& candidates, const NearestQuery<float>& query,
                      std::size_t n, NearestScratch<float>& scratch, PackedCandidate* rows);

/// Columns of found.count rows. @param rows  the query and they; what pads a vector is written behind them.
void part_rows(PackedCandidate* rows, Neighbours& found);

}  // namespace arris
