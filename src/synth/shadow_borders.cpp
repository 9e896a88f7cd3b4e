#include "synth/shadow_borders.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "core/parallel.h"
#include "synth/surface_frame.h"

namespace arris::synth {

namespace {

constexpr double kFinestPitch = 0.02, kCoarsestPitch = 0.1;  // Metres.
constexpr double kPitchShare = 0.01;                         // Of the root of the area.
constexpr double kMostNodes = 1.6e7;                         // Larger faces get a coarser raster.
constexpr double kPhase = 0.381966;  // Keeps nodes off the lines of symmetry on which edges of models often lie.
constexpr std::size_t kSub = 4;      // Fine cells per coarse cell and axis.
constexpr std::size_t kSide = kSub + 1;
constexpr double kPrecision = 1e-4;  // Metres, of crossings.
constexpr std::uint64_t kClippedEnd = std::uint64_t{1} << 63;
constexpr std::size_t kGrain = 64;

class BorderFinder {
 public:
  BorderFinder(const SceneModel& model, std::uint32_t face, const ScanVisibility& visibility)
      : face_(model.faces[face]), index_(face), visibility_(visibility) {
    round_ = face_.shape == Face::Shape::kCylinder;
    const double area = face_.size_u * face_.size_v;
    const double pitch =
        std::max(std::clamp(kPitchShare * std::sqrt(area), kFinestPitch, kCoarsestPitch), std::sqrt(area / kMostNodes));
    cells_u_ = static_cast<std::size_t>(std::ceil(face_.size_u / pitch)) + (round_ ? 0 : 1);
    cells_v_ = static_cast<std::size_t>(std::ceil(face_.size_v / pitch)) + 1;
    pitch_u_ = round_ ? face_.size_u / static_cast<double>(cells_u_) : pitch;
    pitch_v_ = pitch;
  }

  std::vector<std::vector<KeyedSegment>> run() {
    sample_nodes();
    refine();
    return trace();
  }

 private:
  struct FineCell {
    std::size_t cell = 0;
    StationMask stations = 0;  ///< For which `seen` holds.
    std::array<StationMask, kSide * kSide> seen{};
  };
  struct FoundSegment {
    std::uint32_t station = 0;
    KeyedSegment segment;
  };

  std::size_t cells() const { return cells_u_ * cells_v_; }
  std::size_t node(std::size_t i, std::size_t j) const { return j * (cells_u_ + 1) + i; }
  /// In steps of the fine raster.
  Point2 place(std::size_t i, std::size_t j) const {
    return {(static_cast<double>(i) / kSub - kPhase) * pitch_u_, (static_cast<double>(j) / kSub - kPhase) * pitch_v_};
  }
  StationMask seen_at(const Point2& p, StationMask asked, ScanVisibility::Scratch& scratch) const {
    return visibility_.seen_by(surface_at(face_, index_, p), asked, scratch);
  }

  /// A cell counts if a corner or its middle is on the face; its corners off the face lie on the surface extended.
  void sample_nodes() {
    const std::size_t nodes_u = cells_u_ + 1, nodes = nodes_u * (cells_v_ + 1);
    std::vector<char> owned(nodes), wanted(nodes, 0);
    for (std::size_t n = 0; n < nodes; ++n) {
      owned[n] = owns(face_, place(n % nodes_u * kSub, n / nodes_u * kSub)) ? 1 : 0;
    }
    counts_.assign(cells(), 0);
    for (std::size_t c = 0; c < cells(); ++c) {
      const std::size_t i = c % cells_u_, j = c / cells_u_;
      const std::array<std::size_t, 4> corners{node(i, j), node(i + 1, j), node(i, j + 1), node(i + 1, j + 1)};
      const bool any = std::any_of(corners.begin(), corners.end(), [&](std::size_t n) { return owned[n] != 0; });
      if (!any && !owns(face_, place(i * kSub + kSub / 2, j * kSub + kSub / 2))) continue;
      counts_[c] = 1;
      for (const std::size_t n : corners) wanted[n] = 1;
    }
    seen_.assign(nodes, 0);
    parallel_for_chunks(nodes, 1024, [&](std::size_t begin, std::size_t end) {
      ScanVisibility::Scratch scratch;
      for (std::size_t n = begin; n < end; ++n) {
        if (wanted[n] == 0) continue;
        seen_[n] = seen_at(place(n % nodes_u * kSub, n / nodes_u * kSub), visibility_.every_station(), scratch);
      }
    });
  }

  /// Samples the cells on borders finely, and on along every border that leads out of them.
  void refine() {
    std::vector<StationMask> wanted(cells(), 0), done(cells(), 0);
    std::vector<std::size_t> round;
    for (std::size_t c = 0; c < cells(); ++c) {
      if (counts_[c] == 0) continue;
      const std::size_t i = c % cells_u_, j = c / cells_u_;
      const StationMask a = seen_[node(i, j)];
      wanted[c] = (a ^ seen_[node(i + 1, j)]) | (a ^ seen_[node(i, j + 1)]) | (a ^ seen_[node(i + 1, j + 1)]);
      if (wanted[c] != 0) round.push_back(c);
    }
    while (!round.empty()) {
      const std::size_t first = fine_.size();
      for (const std::size_t c : round) {
        fine_.push_back({c, wanted[c] & ~done[c], {}});
        done[c] |= wanted[c];
      }
      parallel_for_chunks(fine_.size() - first, kGrain, [&](std::size_t begin, std::size_t end) {
        ScanVisibility::Scratch scratch;
        for (std::size_t k = begin; k < end; ++k) sample(fine_[first + k], scratch);
      });
      round.clear();
      for (std::size_t k = first; k < fine_.size(); ++k) spread(fine_[k], done, wanted, round);
    }
  }

  void sample(FineCell& fine, ScanVisibility::Scratch& scratch) const {
    const std::size_t i0 = fine.cell % cells_u_ * kSub, j0 = fine.cell / cells_u_ * kSub;
    for (std::size_t n = 0; n < kSide * kSide; ++n) {
      fine.seen[n] = seen_at(place(i0 + n % kSide, j0 + n / kSide), fine.stations, scratch);
    }
  }

  void spread(const FineCell& fine, const std::vector<StationMask>& done, std::vector<StationMask>& wanted,
              std::vector<std::size_t>& round) const {
    const std::size_t i = fine.cell % cells_u_, j = fine.cell / cells_u_;
    const auto crossing = [&](std::size_t start, std::size_t stride) {
      StationMask changed = 0;
      for (std::size_t k = 0; k < kSub; ++k) {
        changed |= fine.seen[start + k * stride] ^ fine.seen[start + (k + 1) * stride];
      }
      return changed;
    };
    const auto ask = [&](std::size_t cell, StationMask stations) {
      if (counts_[cell] == 0 || (stations & ~(done[cell] | wanted[cell])) == 0) return;
      if ((wanted[cell] & ~done[cell]) == 0) round.push_back(cell);
      wanted[cell] |= stations;
    };
    if (j > 0) ask(fine.cell - cells_u_, crossing(0, 1));
    if (j + 1 < cells_v_) ask(fine.cell + cells_u_, crossing(kSub * kSide, 1));
    if (i > 0 || round_) ask(fine.cell - i + (i + cells_u_ - 1) % cells_u_, crossing(0, kSide));
    if (i + 1 < cells_u_ || round_) ask(fine.cell - i + (i + 1) % cells_u_, crossing(kSub, kSide));
  }

  std::vector<std::vector<KeyedSegment>> trace() const {
    std::vector<std::vector<FoundSegment>> found((fine_.size() + kGrain - 1) / kGrain);
    parallel_for_chunks(fine_.size(), kGrain, [&](std::size_t begin, std::size_t end) {
      ScanVisibility::Scratch scratch;
      for (std::size_t k = begin; k < end; ++k) {
        for (StationMask rest = fine_[k].stations; rest != 0; rest &= rest - 1) {
          trace_cell(fine_[k], static_cast<std::uint32_t>(std::countr_zero(rest)), scratch, found[begin / kGrain]);
        }
      }
    });
    std::vector<std::vector<KeyedSegment>> result(visibility_.stations());
    std::uint64_t clipped = 0;
    for (const auto& chunk : found) {
      for (FoundSegment one : chunk) {
        if (one.segment.key_a == kClippedEnd) one.segment.key_a += clipped++;
        if (one.segment.key_b == kClippedEnd) one.segment.key_b += clipped++;
        result[one.station].push_back(one.segment);
      }
    }
    return result;
  }

  /// The crossing of the border with the fine raster's line from (i, j), along u or v. Same bits for both cells at it.
  struct Crossing {
    Point2 place;
    std::uint64_t key = 0;
  };
  Crossing crossing(std::size_t i, std::size_t j, bool along_v, std::uint32_t station, bool seen_first,
                    ScanVisibility::Scratch& scratch) const {
    Point2 low = place(i, j), high = along_v ? place(i, j + 1) : place(i + 1, j);
    while (std::max(high.u - low.u, high.v - low.v) > kPrecision) {
      const Point2 middle{0.5 * (low.u + high.u), 0.5 * (low.v + high.v)};
      const bool seen = visibility_.sees(station, surface_at(face_, index_, middle), scratch);
      (seen == seen_first ? low : high) = middle;
    }
    const std::size_t column = round_ ? i % (cells_u_ * kSub) : i;  // Crossings on the seam have one key.
    const std::uint64_t key = ((j * (cells_u_ * kSub + 1)) + column) * 2 + (along_v ? 1 : 0);
    return {{0.5 * (low.u + high.u), 0.5 * (low.v + high.v)}, key};
  }

  void trace_cell(const FineCell& fine, std::uint32_t station, ScanVisibility::Scratch& scratch,
                  std::vector<FoundSegment>& out) const {
    const std::size_t i0 = fine.cell % cells_u_ * kSub, j0 = fine.cell / cells_u_ * kSub;
    const auto seen = [&](std::size_t i, std::size_t j) { return (fine.seen[j * kSide + i] >> station & 1U) != 0; };
    std::array<std::array<Crossing, kSide * kSide>, 2> crossings;  // Along u, along v; by the node they start from.
    for (std::size_t n = 0; n < kSide * kSide; ++n) {
      const std::size_t i = n % kSide, j = n / kSide;
      for (const bool along_v : {false, true}) {
        if ((along_v ? j : i) == kSub) continue;
        const bool here = seen(i, j), there = along_v ? seen(i, j + 1) : seen(i + 1, j);
        if (here != there) crossings[along_v ? 1 : 0][n] = crossing(i0 + i, j0 + j, along_v, station, here, scratch);
      }
    }
    for (std::size_t n = 0; n < kSide * kSide; ++n) {
      const std::size_t i = n % kSide, j = n / kSide;
      if (i == kSub || j == kSub) continue;
      const bool a = seen(i, j), b = seen(i + 1, j), c = seen(i + 1, j + 1), d = seen(i, j + 1);
      std::array<Crossing, 4> at;
      std::size_t count = 0;
      // Round the cell, so that with four crossings the pairs (0, 1) and (2, 3) cut off two opposite corners.
      if (a != b) at[count++] = crossings[0][n];
      if (b != c) at[count++] = crossings[1][n + 1];
      if (c != d) at[count++] = crossings[0][n + kSide];
      if (d != a) at[count++] = crossings[1][n];
      for (std::size_t k = 0; k + 1 < count; k += 2) add(at[k], at[k + 1], station, out);
    }
  }

  /// Adds the part of a segment that is on the face.
  void add(Crossing a, Crossing b, std::uint32_t station, std::vector<FoundSegment>& out) const {
    const bool a_owned = owns(face_, a.place), b_owned = owns(face_, b.place);
    if (!a_owned && !b_owned) return;
    if (a_owned != b_owned) {
      Point2 inside = a_owned ? a.place : b.place, outside = a_owned ? b.place : a.place;
      for (int k = 0; k < 9; ++k) {  // From a few centimetres to about 0.1 mm.
        const Point2 middle{0.5 * (inside.u + outside.u), 0.5 * (inside.v + outside.v)};
        (owns(face_, middle) ? inside : outside) = middle;
      }
      (a_owned ? b : a) = {inside, kClippedEnd};
    }
    out.push_back(
        {station,
         {a.key, b.key, surface_at(face_, index_, a.place).position, surface_at(face_, index_, b.place).position}});
  }

  const Face& face_;
  std::uint32_t index_;
  const ScanVisibility& visibility_;
  bool round_ = false;  ///< Node columns 0 and cells_u_ are the same.
  double pitch_u_ = 0.0, pitch_v_ = 0.0;
  std::size_t cells_u_ = 0, cells_v_ = 0;
  std::vector<char> counts_;       ///< By cell.
  std::vector<StationMask> seen_;  ///< By node.
  std::vector<FineCell> fine_;
};

}  // namespace

std::vector<std::vector<KeyedSegment>> shadow_borders(const SceneModel& model, std::uint32_t face,
                                                      const ScanVisibility& visibility) {
  const Face::Shape shape = model.faces[face].shape;
  if (shape != Face::Shape::kPlane && shape != Face::Shape::kCylinder) {
    return std::vector<std::vector<KeyedSegment>>(visibility.stations());
  }
  return BorderFinder(model, face, visibility).run();
}

}  // namespace arris::synth
