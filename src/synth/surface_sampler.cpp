#include "synth/surface_sampler.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include "core/error.h"
#include "synth/scene_measure.h"

namespace arris::synth {

namespace {

constexpr double kJitter = 0.3;  // In cells, to either side.
constexpr double kScanLineFactor =
    2.0;  // Distance of scan lines in spacings; along a line points are 1/2 spacing apart.
// With 6 candidates per cell of one spacing squared, discs of this radius leave one point per cell (measured).
constexpr int kDiscCandidates = 6;
constexpr double kDiscDistance = 0.724;  // In spacings.
constexpr double kOutlierMargin = 0.1;   // Of the longest side of the scene.
constexpr double kMostPoints = 1e15;

std::uint64_t cells(double length, double pitch) {
  const double count = std::floor(length / pitch + 0.5);
  if (!(count < kMostPoints))
    throw ConfigError("the spacing is too small for this scene; give a larger one or fewer points");
  return count >= 1.0 ? static_cast<std::uint64_t>(count) : 1;
}

/// Number of points in a cell of a Poisson process with mean 1, from a uniform number.
int poisson_1(double uniform) {
  double term = 0.36787944117144233, sum = term;  // exp(-1)
  int k = 0;
  while (uniform >= sum && k < 16) {
    ++k;
    term /= k;
    sum += term;
  }
  return k;
}

}  // namespace

double SurfaceSampler::spacing_for(const SceneModel& model, Sampling sampling, std::uint64_t points) {
  const double per_point = weighted_measure(model, sampling) / static_cast<double>(points);
  return is_volume(model) ? cube_root(per_point) : std::sqrt(per_point);
}

SurfaceSampler::SurfaceSampler(const SceneModel& model, const SurfaceSampling& sampling)
    : model_(model), sampling_(sampling), bounds_(model.bounds()) {
  const Vec3 size = bounds_.max - bounds_.min;
  finish_ = {sampling.noise, std::max(sampling.outliers, model.spray_share),
             bounds_.expanded(model.spray_reach > 0.0 ? model.spray_reach
                                                      : kOutlierMargin * std::max({size.x, size.y, size.z})),
             model.intensity_noise};
  const double s = sampling.spacing;
  const double weighted = weighted_measure(model, sampling.sampling);
  expected_points_ = is_volume(model) ? weighted / (s * s * s) : weighted / (s * s);
  if (!(expected_points_ <= kMostPoints)) {
    throw ConfigError("the spacing is too small for this scene; give a larger one or fewer points");
  }
  const bool scan = sampling.sampling == Sampling::kScan;
  for (std::size_t i = 0; i < model.faces.size(); ++i) {
    const Face& face = model.faces[i];
    const bool volume = face.shape == Face::Shape::kVolume;
    const bool sphere = face.shape == Face::Shape::kSphere;
    const double size_u = sphere ? 2.0 * std::numbers::pi * face.radius : face.size_u;
    const double size_v = sphere ? std::numbers::pi * face.radius : face.size_v;
    Raster raster;
    raster.face = i;
    raster.first_row = rows_;
    raster.rows = cells(size_v, scan && !volume ? s * kScanLineFactor : s);
    const bool filled = volume && face.returns == 0.0;
    raster.layers = filled ? cells(face.size_w, s) : volume ? cells(face.returns, 1.0) : 1;
    // Columns make up for the rounding of rows, so that narrow faces have the promised density too.
    const double row_height = size_v / static_cast<double>(raster.rows);
    const double layer_height = filled ? face.size_w / static_cast<double>(raster.layers) : s;
    raster.columns = cells(size_u * (row_height / s) * (layer_height / s), s);
    if (sampling.sampling == Sampling::kPoisson && !volume && !sphere) {
      raster.rows = cells(std::ceil(size_v / s), 1.0) + 2;
      raster.columns = face.shape == Face::Shape::kPlane ? cells(std::ceil(size_u / s), 1.0) + 2 : cells(size_u, s);
    }
    rows_ += raster.rows * raster.layers;
    unit_points_ = std::max(unit_points_, static_cast<std::size_t>(raster.columns));
    rasters_.push_back(raster);
  }
}

void SurfaceSampler::make(std::uint64_t begin, std::uint64_t end, std::vector<io::FreshPoint>& out) const {
  auto raster = std::upper_bound(rasters_.begin(), rasters_.end(), begin,
                                 [](std::uint64_t row, const Raster& r) { return row < r.first_row; });
  --raster;
  std::optional<PoissonDiscRows> discs;
  for (std::uint64_t row = begin; row < end; ++row) {
    while (row >= raster->first_row + raster->rows * raster->layers) {
      ++raster;
      discs.reset();
    }
    if (sampling_.sampling == Sampling::kPoisson && model_.faces[raster->face].shape != Face::Shape::kVolume) {
      if (!discs) discs.emplace(discs_of(*raster));
      make_disc_row(*raster, row - raster->first_row, *discs, out);
    } else {
      make_row(*raster, row - raster->first_row, out);
    }
  }
}

CellRow SurfaceSampler::row_of(const Raster& raster, std::uint64_t index) const {
  const Face& face = model_.faces[raster.face];
  const double v_index = static_cast<double>(index % raster.rows);
  const double layer = static_cast<double>(index / raster.rows);
  const double rows = static_cast<double>(raster.rows), layers = static_cast<double>(raster.layers);
  CellRow row;
  row.key = derive_key(derive_key(sampling_.seed, raster.face), index);
  row.columns = raster.columns;
  row.face_number = static_cast<std::uint16_t>(raster.face + 1);
  row.v_low = face.size_v * (v_index / rows);
  row.v_high = face.size_v * ((v_index + 1.0) / rows);
  row.w_low = face.size_w * (layer / layers);
  row.w_high = face.size_w * ((layer + 1.0) / layers);
  if (face.shape == Face::Shape::kSphere) {
    row.v_low = -face.radius * sin_cos_turns(0.5 * v_index / rows).cos;
    row.v_high = -face.radius * sin_cos_turns(0.5 * (v_index + 1.0) / rows).cos;
    const double share = sin_cos_turns(0.5 * (v_index + 0.5) / rows).sin;
    row.columns =
        std::max<std::uint64_t>(1, static_cast<std::uint64_t>(share * static_cast<double>(raster.columns) + 0.5));
  } else if (sampling_.sampling == Sampling::kPoisson && face.shape != Face::Shape::kVolume) {
    row.v_low = (v_index - 1.0) * sampling_.spacing;
    row.v_high = v_index * sampling_.spacing;
    if (face.shape == Face::Shape::kPlane) row.u_pitch = sampling_.spacing;
  }
  return row;
}

PoissonDiscRows SurfaceSampler::discs_of(const Raster& raster) const {
  const Face& face = model_.faces[raster.face];
  PoissonDiscRows::Lattice lattice;
  lattice.rows = raster.rows;
  lattice.per_cell = kDiscCandidates;
  lattice.distance = kDiscDistance * sampling_.spacing;
  lattice.round = face.shape != Face::Shape::kPlane && face.sweep_turns >= 1.0;
  lattice.columns = [this, raster](std::uint64_t row) { return row_of(raster, row).columns; };
  lattice.candidate = [this, &face, raster, row = CellRow{}, at = ~std::uint64_t{0}](
                          std::uint64_t index, std::uint64_t column, int number) mutable {
    if (index != at) {
      row = row_of(raster, index);
      at = index;
    }
    const std::uint64_t key = derive_key(cell_key(row.key, column), static_cast<std::uint64_t>(number));
    PointRandom random(key);
    const double a = random.uniform(), b = random.uniform();
    return PoissonDiscRows::Candidate{position_of(face, row, column, a, b).first, mix64(~key)};
  };
  return PoissonDiscRows(std::move(lattice));
}

void SurfaceSampler::make_disc_row(const Raster& raster, std::uint64_t index, PoissonDiscRows& discs,
                                   std::vector<io::FreshPoint>& out) const {
  const CellRow row = row_of(raster, index);
  discs.forget_below(index > kDiscCandidates ? index - kDiscCandidates : 0);
  for (std::uint64_t column = 0; column < row.columns; ++column) {
    for (int k = 0; k < kDiscCandidates; ++k) {
      if (!discs.stays(index, column, k)) continue;
      const std::uint64_t key = derive_key(cell_key(row.key, column), static_cast<std::uint64_t>(k));
      place(model_.faces[raster.face], row, column, PointRandom(key), out);
    }
  }
}

void SurfaceSampler::make_row(const Raster& raster, std::uint64_t index, std::vector<io::FreshPoint>& out) const {
  const Face& face = model_.faces[raster.face];
  const CellRow row = row_of(raster, index);
  const bool process = sampling_.sampling == Sampling::kRandom || sampling_.sampling == Sampling::kGradient ||
                       face.shape == Face::Shape::kVolume;
  for (std::uint64_t column = 0; column < row.columns; ++column) {
    const std::uint64_t key = cell_key(row.key, column);
    if (!process) {
      place(face, row, column, PointRandom(mix64(key)), out);
      continue;
    }
    const int points = poisson_1(PointRandom(mix64(key)).uniform());
    for (int k = 1; k <= points; ++k)
      place(face, row, column, PointRandom(derive_key(key, static_cast<std::uint64_t>(k))), out);
  }
}

void SurfaceSampler::place(const Face& face, const CellRow& row, std::uint64_t column, PointRandom random,
                           std::vector<io::FreshPoint>& out) const {
  double a = 0.5, b = 0.5;  // Place within the cell, [0, 1].
  const bool volume = face.shape == Face::Shape::kVolume;
  if (volume) {
    a = random.uniform();
    b = random.uniform();
  } else {
    switch (sampling_.sampling) {
      case Sampling::kGrid:
        break;
      case Sampling::kJittered:
        a += kJitter * (2.0 * random.uniform() - 1.0);
        b += kJitter * (2.0 * random.uniform() - 1.0);
        break;
      case Sampling::kRandom:
      case Sampling::kGradient:
      case Sampling::kPoisson:
        a = random.uniform();
        b = random.uniform();
        break;
      case Sampling::kScan:
        a = PointRandom(row.key).uniform();
        break;  // One phase per line.
    }
  }
  auto [position, owned] = position_of(face, row, column, a, b);
  if (!owned) return;
  if (volume) {
    const double w = row.w_low + random.uniform() * (row.w_high - row.w_low);
    const Vec3 from_origin = position - face.origin;
    if (!face.fills(dot(from_origin, face.eu), dot(from_origin, face.ev), w)) return;
    position = position + w * face.ew;
  }
  if (sampling_.sampling == Sampling::kGradient && random.uniform() >= gradient_share_at(bounds_, position)) return;
  out.push_back(finished_point(finish_, face, row.face_number, position, random));
}

}  // namespace arris::synth
