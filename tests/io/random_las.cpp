#include "random_las.h"

#include <rapidcheck.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace arris::test {
namespace {

std::string random_bytes(std::size_t size) {
  return *rc::gen::container<std::string>(size, rc::gen::arbitrary<char>());
}

struct Totals {
  std::array<std::uint64_t, 16> by_return{};
  std::array<double, 3> min{};
  std::array<double, 3> max{};
};

Totals totals_of(const LasPlan& plan) {
  Totals totals;
  for (std::size_t i = 0; i < plan.points.size(); ++i) {
    ++totals.by_return[static_cast<unsigned>(plan.points[i][14]) & (plan.format >= 6 ? 15U : 7U)];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double world = get<std::int32_t>(plan.points[i], 4 * axis) * plan.scale[axis] + plan.offset[axis];
      totals.min[axis] = i == 0 ? world : std::min(totals.min[axis], world);
      totals.max[axis] = i == 0 ? world : std::max(totals.max[axis], world);
    }
  }
  return totals;
}

/// 64-bit counts, and 32-bit ones where the version and the point format allow or need them.
void store_counts(const LasPlan& plan, const Totals& totals, std::string& las) {
  const bool wide = plan.minor >= 4;
  const bool legacy = !wide || (plan.format < 6 && *rc::gen::arbitrary<bool>());
  put<std::uint32_t>(las, 107, legacy ? static_cast<std::uint32_t>(plan.points.size()) : 0);
  for (std::size_t i = 0; i < 5; ++i)
    put<std::uint32_t>(las, 111 + 4 * i, legacy ? static_cast<std::uint32_t>(totals.by_return[i + 1]) : 0);
  for (std::size_t i = 0; i < 15 && wide; ++i) put<std::uint64_t>(las, 255 + 8 * i, totals.by_return[i + 1]);
}

/// Exact, or rounded away by less than a step as writers do.
void store_bounds(const LasPlan& plan, const Totals& totals, std::string& las) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto rounding = [&] {
      return plan.points.empty() ? 0.0 : *rc::gen::inRange(-4, 5) * 0.2 * std::abs(plan.scale[axis]);
    };
    put<double>(las, 179 + 16 * axis, totals.max[axis] + rounding());
    put<double>(las, 187 + 16 * axis, totals.min[axis] + rounding());
  }
}

/// What no reader needs: project id, system, software, date, the reserved bytes of the records.
void store_identity(const LasPlan& plan, std::string& las) {
  las.replace(4, 2, random_bytes(2));
  las.replace(8, 16, random_bytes(16));
  las.replace(26, 68, random_bytes(68));
  std::size_t at = get<std::uint16_t>(las, 94);
  for (const TestVlr& vlr : plan.vlrs) {
    las.replace(at, 2, random_bytes(2));
    at += 54 + vlr.payload.size();
  }
}

/// A waveform record or other bytes at the end, which the header may point at.
void add_tail(const LasPlan& plan, std::string& las) {
  const std::size_t end = las.size();
  las += random_bytes(*rc::gen::element<std::size_t>(0, 0, 1, 100));
  if (plan.minor >= 3 && *rc::gen::inRange(0, 3) == 0) put<std::uint64_t>(las, 227, end);
  if (plan.minor >= 4 && plan.evlrs.empty() && *rc::gen::inRange(0, 3) == 0) put<std::uint64_t>(las, 235, end);
}

}  // namespace

LasPlan random_plan() {
  LasPlan plan;
  plan.minor = *rc::gen::inRange(0, 6);
  plan.format = *rc::gen::inRange(0, 11);
  const std::size_t extra = *rc::gen::weightedOneOf<std::size_t>({{3, rc::gen::just<std::size_t>(0)},
                                                                  {3, rc::gen::inRange<std::size_t>(0, 40)},
                                                                  {1, rc::gen::inRange<std::size_t>(250, 3000)}});
  plan.record_bytes = kFormatBytes[static_cast<std::size_t>(plan.format)] + extra;
  plan.header_padding = *rc::gen::element<std::size_t>(0, 0, 1, 60);
  plan.points = make_records(*rc::gen::inRange<std::size_t>(0, 30), plan.record_bytes, *rc::gen::inRange(1U, 1000U));
  const int vlrs = *rc::gen::inRange(0, 4);
  for (int i = 0; i < vlrs; ++i) {
    plan.vlrs.push_back(
        {"user", static_cast<std::uint16_t>(i), std::string(*rc::gen::inRange<std::size_t>(0, 300), 'v')});
  }
  if (*rc::gen::arbitrary<bool>()) {  // Descriptions of some, all, or more bytes than there are.
    std::string payload;
    const int count = *rc::gen::inRange(0, 5);
    for (int i = 0; i < count; ++i)
      payload += extra_entry(*rc::gen::inRange(0, 32), "theirs" + std::to_string(i), *rc::gen::inRange(0, 20));
    payload += std::string(*rc::gen::element<std::size_t>(0, 0, 0, 7), 'j');
    plan.vlrs.push_back({"LASF_Spec", 4, payload});
  }
  plan.gap = std::string(*rc::gen::element<std::size_t>(0, 0, 2, 500), 'g');
  if (plan.minor >= 4) {
    const int evlrs = *rc::gen::inRange(0, 3);
    for (int i = 0; i < evlrs; ++i) plan.evlrs.push_back({"far", static_cast<std::uint16_t>(i), std::string(70, 'e')});
    if (*rc::gen::inRange(0, 6) == 0) plan.evlrs.push_back({"LASF_Spec", 4, extra_entry(1, "far")});
  }
  return plan;
}

std::string random_true_las(const LasPlan& plan) {
  std::string las = build_las(plan);
  const Totals totals = totals_of(plan);
  store_counts(plan, totals, las);
  store_bounds(plan, totals, las);
  store_identity(plan, las);
  add_tail(plan, las);
  return las;
}

}  // namespace arris::test
