#include "liu_reference.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "core/columns.h"
#include "features/liu/entropy_scale.h"
#include "features/liu/fold_test.h"
#include "features/neighbourhood/azimuth_gap.h"
#include "features/neighbourhood/ball_moments.h"
#include "features/neighbourhood/local_spacing.h"
#include "features/numerics/exact_math.h"
#include "features/numerics/fixed_point.h"

namespace arris::test {
namespace {

__extension__ typedef unsigned __int128 Wide;

struct Member {
  std::size_t entry;
  Wide d2;
  double dx, dy, dz;
};

class Reference {
 public:
  Reference(const TilePoints& tile, const Lattice& lattice, const LiuParameters& p)
      : tile_(tile), p_(p), step_(lattice.step), max_reach_(p.max_radius / lattice.step) {}

  TileContours run() {
    for (std::size_t i = 0; i < tile_.positions.size(); ++i) query(i);
    TileContours contours;
    contours.isolated = isolated_.size();
    for (auto& [entry, record] : records_) {
      record.id = tile_.ids[entry];
      contours.records.push_back(record);
    }
    for (const auto& [id, entry] : tile_.duplicates) {
      contours.isolated += static_cast<std::uint64_t>(std::count(isolated_.begin(), isolated_.end(), entry));
      const auto found = records_.find(entry);
      if (found == records_.end()) continue;
      contours.records.push_back(found->second);
      contours.records.back().id = id;
    }
    std::sort(contours.records.begin(), contours.records.end(),
              [](const auto& a, const auto& b) { return a.id < b.id; });
    return contours;
  }

 private:
  /// All points within `radius` steps of point i, itself included, in canonical order.
  std::vector<Member> within(std::size_t i, double radius) const {
    const auto radius2 = static_cast<std::uint64_t>(radius * radius);
    std::vector<Member> members;
    for (std::size_t j = 0; j < tile_.positions.size(); ++j) {
      Wide d2 = 0;
      double d[3];
      for (int axis = 0; axis < 3; ++axis) {
        const std::int64_t difference = std::int64_t{tile_.positions[j][axis]} - tile_.positions[i][axis];
        const auto size = static_cast<Wide>(difference < 0 ? -difference : difference);
        d2 += size * size;
        d[axis] = static_cast<double>(difference);
      }
      if (d2 <= radius2) members.push_back({j, d2, d[0], d[1], d[2]});
    }
    std::sort(members.begin(), members.end(), [this](const Member& a, const Member& b) {
      return a.d2 != b.d2 ? a.d2 < b.d2 : tile_.ids[a.entry] < tile_.ids[b.entry];
    });
    return members;
  }

  void query(std::size_t i) {
    std::vector<Member> all = within(i, max_reach_);
    Neighbours neighbours;
    neighbours.reserve(static_cast<std::size_t>(p_.k_max));
    neighbours.count = std::min(all.size() - 1, static_cast<std::size_t>(p_.k_max));
    for (std::size_t j = 0; j < neighbours.count; ++j) {
      neighbours.dx[j] = all[j + 1].dx;
      neighbours.dy[j] = all[j + 1].dy;
      neighbours.dz[j] = all[j + 1].dz;
      neighbours.d2[j] = static_cast<double>(all[j + 1].d2);
    }
    if (neighbours.count < static_cast<std::size_t>(p_.k_min)) {
      isolated_.push_back(i);
      return;
    }
    LocalSpacing spacing = local_spacing(neighbours);
    if (p_.spacing > 0.0) spacing = {p_.spacing / step_, p_.spacing / step_};
    if (p_.boundary) boundary(i, neighbours, spacing);
    if (p_.fold) fold(i, spacing);
  }

  static BallMoments moments_of(const std::vector<Member>& members) {
    BallMoments m;  // Sums below 2^53 in all tests that reach this, so any order is exact.
    for (const Member& q : members) {
      m.n += 1;
      m.x += q.dx;
      m.y += q.dy;
      m.z += q.dz;
      m.xx += q.dx * q.dx;
      m.xy += q.dx * q.dy;
      m.xz += q.dx * q.dz;
      m.yy += q.dy * q.dy;
      m.yz += q.dy * q.dz;
      m.zz += q.dz * q.dz;
    }
    return m;
  }

  /// Eq. 1-6, one neighbourhood at a time.
  std::pair<int, PrincipalFrame> best_scale(const Neighbours& neighbours) const {
    int best_k = 0;
    PrincipalFrame best_frame{};
    for (const bool guarded : {true, false}) {
      double best = std::numeric_limits<double>::infinity();
      for (int k = p_.k_min; k <= std::min(p_.k_max, static_cast<int>(neighbours.count)); k += p_.k_step) {
        double n = p_.covariance_with_target ? k + 1 : k;
        double s[9] = {};
        for (int j = 0; j < k; ++j) {
          const double x = neighbours.dx[j];
          const double y = neighbours.dy[j];
          const double z = neighbours.dz[j];
          const double terms[9] = {x, y, z, x * x, x * y, x * z, y * y, y * z, z * z};
          for (int t = 0; t < 9; ++t) s[t] += terms[t];
        }
        const SymmetricMatrix<double> c{n * s[3] - s[0] * s[0], n * s[4] - s[0] * s[1], n * s[5] - s[0] * s[2],
                                        n * s[6] - s[1] * s[1], n * s[7] - s[1] * s[2], n * s[8] - s[2] * s[2]};
        const PrincipalFrame frame = principal_frame(c);
        if (guarded && frame.values.middle < p_.min_planarity * frame.values.largest) continue;
        const double entropy = entropy_of(frame.values);
        if (entropy < best - kEntropyTie) {
          best = entropy;
          best_k = k;
          best_frame = frame;
        }
      }
      if (best_k > 0) break;
    }
    return {best_k, best_frame};
  }

  /// Largest gap of sorted azimuths, going round; 0 for fewer than three.
  static double gap_of(std::vector<double> azimuths) {
    if (azimuths.size() < 3) return 0.0;
    std::sort(azimuths.begin(), azimuths.end());
    double gap = 360.0 - azimuths.back() + azimuths.front();
    for (std::size_t i = 1; i < azimuths.size(); ++i) gap = std::max(gap, azimuths[i] - azimuths[i - 1]);
    return gap;
  }

  void boundary(std::size_t i, const Neighbours& neighbours, const LocalSpacing& spacing) {
    const auto [k, frame] = best_scale(neighbours);
    const double far = p_.far_distance > 0.0 ? p_.far_distance / step_ : p_.far_factor * spacing.nearest;
    const double least = 1e-6 * spacing.nearest;
    std::vector<double> all;
    std::vector<double> near;
    for (int j = 0; j < k; ++j) {
      const Vector3 d{neighbours.dx[j], neighbours.dy[j], neighbours.dz[j]};
      const double a = dot(frame.e1, d);
      const double b = dot(frame.e2, d);
      if (a * a + b * b <= least * least) continue;
      const double azimuth = angle_of(b, a) * kDegreesPerRadian;
      all.push_back(azimuth);
      if (neighbours.d2[j] <= far * far) near.push_back(azimuth);
    }
    const double gap = gap_of(all);
    const double threshold = p_.gap_deg - kGapTie_deg;
    ContourRecord record;
    if (gap >= threshold) {
      record.classes = kBoundary;
      record.gap_deg = static_cast<float>(gap);
    } else if (gap_of(near) >= threshold) {
      record.classes = kWeakBoundary;
      record.gap_deg = static_cast<float>(gap_of(near));
    } else {
      return;
    }
    combine(records_[i], record);
  }

  void fold(std::size_t i, const LocalSpacing& spacing) {
    double r = p_.radius > 0.0 ? p_.radius / step_ : p_.radius_factor * spacing.density;
    r = std::min(r, max_reach_);
    const double threshold = p_.cf1 > 0.0 ? p_.cf1 / step_ : p_.cf1_factor * spacing.density;
    const std::vector<Member> members = within(i, r);
    const std::size_t n = members.size();
    if (n < kLeastBallPoints) return;
    const PrincipalFrame frame = principal_frame(moments_of(members).covariance());
    std::vector<std::array<double, 2>> flat;
    for (const Member& q : members) {
      flat.push_back({q.dx * frame.e2[0] + q.dy * frame.e2[1] + q.dz * frame.e2[2],
                      q.dx * frame.e3[0] + q.dy * frame.e3[1] + q.dz * frame.e3[2]});
    }
    // Members are in canonical order, so the first of equal pairs is the one to take.
    double longest2 = 0.0;
    std::size_t a = 0;
    std::size_t b = 0;
    for (std::size_t f = 0; f < n; ++f) {
      for (std::size_t g = f + 1; g < n; ++g) {
        const double du = flat[f][0] - flat[g][0];
        const double dv = flat[f][1] - flat[g][1];
        if (du * du + dv * dv > longest2) {
          longest2 = du * du + dv * dv;
          a = f;
          b = g;
        }
      }
    }
    if (!(longest2 > 0.0)) return;
    const double length = std::sqrt(longest2);
    const double su = (flat[b][0] - flat[a][0]) / length;
    const double sv = (flat[b][1] - flat[a][1]) / length;
    const FixedPoint to_line(2.0 * r, n, kDistanceBits);
    const FixedPoint to_square(4.0 * r * r, n, kSquareBits);
    std::vector<double> distance;
    double sum = 0.0;
    std::size_t left = 0;
    std::size_t right = 0;
    for (const auto& [u, v] : flat) {
      const double d = su * (v - flat[a][1]) - sv * (u - flat[a][0]);
      distance.push_back(to_line.rounded(std::fabs(d)));
      sum += distance.back();
      left += d > kOnLine * r;
      right += d < -kOnLine * r;
    }
    const double mean = sum / static_cast<double>(n);
    double squares = 0.0;
    for (const double d : distance) squares += to_square.rounded((d - mean) * (d - mean));
    const double cf1 = std::sqrt(squares / static_cast<double>(n - 1));
    if (cf1 < threshold) return;
    const std::size_t majority = std::max(left, right);
    const std::size_t minority = std::min(left, right);
    const double cf2 = minority > 0    ? static_cast<double>(majority) / static_cast<double>(minority)
                       : majority == 0 ? 1.0
                                       : std::numeric_limits<double>::infinity();
    if (cf2 < p_.cf2) return;
    std::vector<std::size_t> order(n);
    for (std::size_t j = 0; j < n; ++j) order[j] = j;
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t x, std::size_t y) { return distance[x] > distance[y]; });
    ContourRecord record;
    record.classes = kFold;
    record.votes = 1;
    record.fold_strength = static_cast<float>(cf1 / threshold);
    record.fold_angle_deg =
        static_cast<float>(2.0 * kDegreesPerRadian * arc_cosine(std::min(1.0, cf1 / (kFoldLaw * r))));
    for (std::size_t rank = 0; rank < std::min<std::size_t>(n, static_cast<std::size_t>(p_.top_m)); ++rank) {
      const std::size_t entry = members[order[rank]].entry;
      if (p_.emit == LiuParameters::Emit::kSelf && entry != i) continue;
      combine(records_[entry], record);
    }
  }

  const TilePoints& tile_;
  const LiuParameters& p_;
  double step_;
  double max_reach_;
  std::map<std::size_t, ContourRecord> records_;
  std::vector<std::size_t> isolated_;
};

}  // namespace

TileContours reference_liu(const TilePoints& tile, const Lattice& lattice, const LiuParameters& parameters) {
  return Reference(tile, lattice, parameters).run();
}

}  // namespace arris::test
