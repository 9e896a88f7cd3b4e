#include "features/edge_score.h"

#include <algorithm>

namespace arris {

bool is_fold_candidate(const FoldEvidence& f) {
  return f.angle_deg <= 160.0 && f.rms <= 0.85 * f.all_rms &&
         std::min(f.count_a, f.count_b) >= f.all_count / 12.0 && f.distance <= 1.4 * f.line_spacing &&
         f.support_a + f.support_b >= 1.0 && f.rms <= 1.02 * f.curved_rms;
}

bool is_rim_candidate(const RimEvidence& r) {
  return r.count >= 6.0 && r.inner_share >= 0.6 && r.offset <= r.gate && r.width >= 0.5 &&
         r.gap_deg >= kLeastRimGap_deg;
}

double fold_score(const FoldEvidence&) {
  return 1.0;
}
double rim_score(const RimEvidence&) {
  return 1.0;
}

}  // namespace arris
