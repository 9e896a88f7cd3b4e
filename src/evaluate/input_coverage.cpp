#include <cmath>
#include <limits>

#include "evaluate/contour_evaluation.h"
#include "evaluate/evaluation_setup.h"
#include "evaluate/truth_samples.h"

namespace arris::evaluate {

struct InputCoverage::Impl {
  Impl(const EvaluationSetup& setup)
      : samples(setup.counted, sample_step(setup), setup.units),
        limit(setup.tolerances.back() * (1.0 + kToleranceSlack)),
        squared(samples.samples().size(), std::numeric_limits<double>::infinity()) {}

  TruthSamples samples;
  double limit;  ///< In units of the samples.
  std::vector<double> squared;
};

InputCoverage::InputCoverage(const Truth& truth, const EvaluationOptions& options)
    : impl_(std::make_unique<Impl>(prepare(truth, options))) {}
InputCoverage::~InputCoverage() = default;
InputCoverage::InputCoverage(InputCoverage&&) noexcept = default;

void InputCoverage::add(std::span<const Vec3> points) {
  const auto& samples = impl_->samples.samples();
  for (const Vec3& p : points) {
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) continue;
    impl_->samples.search(p, impl_->limit, [&](std::uint32_t i) {
      const double reach = impl_->limit * impl_->samples.unit_of(samples[i]);
      const Vec3 difference = samples[i].position - p;
      const double squared = dot(difference, difference);
      if (squared <= reach * reach && squared < impl_->squared[i]) impl_->squared[i] = squared;
    });
  }
}

std::vector<double> InputCoverage::distances() const {
  std::vector<double> result(impl_->squared.size());
  for (std::size_t i = 0; i < result.size(); ++i) {
    result[i] = std::sqrt(impl_->squared[i]) / impl_->samples.unit_of(impl_->samples.samples()[i]);
  }
  return result;
}

}  // namespace arris::evaluate
