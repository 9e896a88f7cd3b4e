#include "features/planar/alpha_edges.h"

#include <algorithm>
#include <boost/multiprecision/cpp_int.hpp>
#include <tuple>

namespace arris {
namespace {

using Wide = __int128;

/// By this share sides must differ for their order to be sure in double: each is a product of five numbers that are
/// rounded once each.
constexpr double kSure = 1e-14;

/// Sign of C² E - A² D, where the four are below 2^95: products have up to 378 bits.
int exact_sign(Wide a, Wide c, Wide d, Wide e) {
  const double left = static_cast<double>(c) * static_cast<double>(c) * static_cast<double>(e);
  const double right = static_cast<double>(a) * static_cast<double>(a) * static_cast<double>(d);
  if (left - right > kSure * (left + right)) return 1;
  if (right - left > kSure * (left + right)) return -1;
  using boost::multiprecision::int512_t;
  const int512_t difference = int512_t(c) * int512_t(c) * int512_t(e) - int512_t(a) * int512_t(a) * int512_t(d);
  return difference.sign();
}

Wide squared(const PlanarNeighbour& q) {
  return static_cast<Wide>(q.x) * q.x + static_cast<Wide>(q.y) * q.y;
}

/// The circles through p = (0, 0) and q.
struct Chord {
  PlanarNeighbour q;
  Wide d, e;  ///< |q|² and (2 alpha)² - |q|², >= 0.

  /// r is inside of the circle whose centre is to the right of p -> q if a + sqrt(e / d) c < 0, and on it if that is 0;
  /// for the other circle: a - sqrt(e / d) c.
  bool blocked_right(const PlanarNeighbour& r) const { return blocked(along(r), across(r)); }
  bool blocked_left(const PlanarNeighbour& r) const { return blocked(along(r), -across(r)); }

 private:
  Wide along(const PlanarNeighbour& r) const {
    return static_cast<Wide>(r.x) * (r.x - q.x) + static_cast<Wide>(r.y) * (r.y - q.y);
  }
  Wide across(const PlanarNeighbour& r) const { return static_cast<Wide>(q.x) * r.y - static_cast<Wide>(q.y) * r.x; }
  /// On the circle, points on the side of the centre block and points across the chord do not.
  bool blocked(Wide a, Wide c) const {
    if (c == 0) return a < 0;  // On the chord itself.
    if (c > 0) return a < 0 && exact_sign(a, c, d, e) < 0;
    return a <= 0 || exact_sign(a, c, d, e) >= 0;
  }
};

}  // namespace

const std::vector<PlanarNeighbour>& AlphaEdges::leaving(std::vector<PlanarNeighbour>& neighbours,
                                                        std::int64_t two_alpha) {
  found_.clear();
  const Wide limit = static_cast<Wide>(two_alpha) * two_alpha;
  std::erase_if(neighbours, [&](const PlanarNeighbour& q) { return squared(q) > limit; });
  // Near points block most: they are tried first.
  std::sort(neighbours.begin(), neighbours.end(), [](const PlanarNeighbour& a, const PlanarNeighbour& b) {
    const Wide a2 = squared(a), b2 = squared(b);
    return a2 != b2 ? a2 < b2 : std::tie(a.x, a.y) < std::tie(b.x, b.y);
  });
  for (const PlanarNeighbour& q : neighbours) {
    const Chord chord{q, squared(q), limit - squared(q)};
    const auto other = [&](const PlanarNeighbour& r) { return r.x != q.x || r.y != q.y; };
    const auto right = [&](const PlanarNeighbour& r) { return other(r) && chord.blocked_right(r); };
    const auto left = [&](const PlanarNeighbour& r) { return other(r) && chord.blocked_left(r); };
    if (std::any_of(neighbours.begin(), neighbours.end(), right)) continue;
    if (std::any_of(neighbours.begin(), neighbours.end(), left)) found_.push_back(q);
  }
  return found_;
}

}  // namespace arris
