#include "evaluate/label_comparison.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <tuple>

#include "core/parallel.h"
#include "evaluate/edge_index.h"
#include "evaluate/evaluation_setup.h"

namespace arris::evaluate {

namespace {

constexpr std::size_t kGrain = 4096;
constexpr double kWithoutNoise = 0.5, kWithNoise = 1.0;  // In spacings.

bool before(const Vec3& a, const Vec3& b) {
  return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
}

}  // namespace

struct LabelComparison::Impl {
  Impl(const EvaluationSetup& given, const EvaluationOptions& options)
      : setup(given),
        factor(setup.noise > 0.0 ? kWithNoise : kWithoutNoise),
        limit((setup.local ? factor : factor * setup.spacing) * (1.0 + kToleranceSlack)),
        counted(setup.counted, setup.units),
        others(options.forgive_other_kinds ? setup.others : std::vector<TruthEdge>{},
               options.forgive_other_kinds ? setup.other_units : std::vector<double>{}) {}

  EvaluationSetup setup;
  double factor;
  double limit;  ///< In units of the edges.
  EdgeIndex counted, others;
  std::vector<Vec3> detections;  ///< Sorted.
  std::atomic<std::uint64_t> true_positives{0}, false_positives{0}, false_negatives{0}, true_negatives{0};
};

LabelComparison::LabelComparison(std::span<const PredictedPoint> predictions, const Truth& truth,
                                 const EvaluationOptions& options)
    : impl_(std::make_unique<Impl>(prepare(truth, options), options)) {
  for (const PredictedPoint& p : predictions) {
    if (judge(p, options) == Judgement::kCounts) impl_->detections.push_back({p.x, p.y, p.z});
  }
  std::sort(impl_->detections.begin(), impl_->detections.end(), before);
}
LabelComparison::~LabelComparison() = default;
LabelComparison::LabelComparison(LabelComparison&&) noexcept = default;

void LabelComparison::add(std::span<const Vec3> points) {
  parallel_for_chunks(points.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    std::array<std::array<std::uint64_t, 2>, 2> counts{};  // By truth and label.
    for (const Vec3& p : points.subspan(begin, end - begin)) {
      if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) continue;
      const bool contour = impl_->counted.nearest(p, impl_->limit).distance <= impl_->limit;
      if (!contour && impl_->others.nearest(p, impl_->limit).distance <= impl_->limit) continue;
      const bool called = std::binary_search(impl_->detections.begin(), impl_->detections.end(), p, before);
      ++counts[contour ? 1 : 0][called ? 1 : 0];
    }
    impl_->true_positives += counts[1][1];
    impl_->false_positives += counts[0][1];
    impl_->false_negatives += counts[1][0];
    impl_->true_negatives += counts[0][0];
  });
}

LabelAgreement LabelComparison::result() const {
  LabelAgreement result;
  result.tolerance_spacings = impl_->factor;
  result.true_positives = impl_->true_positives;
  result.false_positives = impl_->false_positives;
  result.false_negatives = impl_->false_negatives;
  result.true_negatives = impl_->true_negatives;
  const double tp = static_cast<double>(result.true_positives), fp = static_cast<double>(result.false_positives);
  const double fn = static_cast<double>(result.false_negatives), tn = static_cast<double>(result.true_negatives);
  if (tp + fp + fn > 0.0) result.iou = tp / (tp + fp + fn);
  const double product = std::sqrt(tp + fp) * std::sqrt(tp + fn) * std::sqrt(tn + fp) * std::sqrt(tn + fn);
  if (product > 0.0) result.mcc = (tp * tn - fp * fn) / product;
  return result;
}

}  // namespace arris::evaluate
