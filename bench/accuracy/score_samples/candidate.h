#pragma once
/// @file What arris's own method knows of a point that may be on a contour: one sample for the fit of EdgeScore.

#include <vector>

#include "features/arris/edge_score.h"

namespace arris::bench {

/// At least one of both has evidence.
struct Candidate {
  bool has_fold = false, has_rim = false;
  FoldEvidence fold;
  RimEvidence rim;
};

/// Candidates in the order in which analyse_point() (candidate_analysis.cpp) met them. Not thread-safe: the extraction
/// has to run on one thread.
std::vector<Candidate>& met_candidates();

}  // namespace arris::bench
