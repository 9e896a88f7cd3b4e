#include "synth/scan_simulator.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.h"
#include "synth/counter_random.h"

namespace arris::synth {

namespace {

constexpr double kReferenceRange = 10.0;  // Where the spacing is stated.
constexpr double kMaxRange = 120.0;
constexpr double kLowestTurns = -60.0 / 360.0;
constexpr double kHighestTurns = 75.0 / 360.0;
constexpr double kElevationTurns = kHighestTurns - kLowestTurns;
constexpr double kDepthEdge = 0.1;            // Metres between the ranges of the two halves of a beam that mix.
constexpr double kBeamWidth = 0.5;            // In angular steps.
constexpr double kHalfIntensityRange = 30.0;  // Where range alone halves the intensity.
constexpr std::uint64_t kProbeColumns = 960, kProbeRows = 360;
constexpr double kMostRows = 1e7;

std::uint16_t intensity(const RayHit& hit, double reflectance) {
  const double relative = hit.range / kHalfIntensityRange;
  return static_cast<std::uint16_t>(65535.0 * reflectance * hit.cosine / (1.0 + relative * relative));
}

}  // namespace

ScanSimulator::ScanSimulator(const SceneModel& model, const ScanSettings& settings)
    : model_(model), settings_(settings) {
  for (std::size_t i = 0; i < model.stations.size(); ++i) {
    const Vec3 position = model.stations[i].position;
    PointRandom random(derive_key(derive_key(settings.seed, 1), i));
    const Vec3 error = settings.registration * Vec3{random.normal(), random.normal(), random.normal()};
    stations_.push_back({RayCaster(model, position, kMaxRange), position, position + error});
    hit_share_sum_ += hit_share(stations_.back());
  }
  // Rows x columns per station = (elevation span / step) x (1 turn / step).
  double step_turns = settings.spacing / kReferenceRange / (2.0 * std::numbers::pi);
  if (settings.spacing == 0.0) {
    step_turns = std::sqrt(kElevationTurns * hit_share_sum_ / static_cast<double>(settings.points));
  }
  spacing_ = step_turns * 2.0 * std::numbers::pi * kReferenceRange;
  const double rows = std::floor(kElevationTurns / step_turns + 0.5);
  if (!(rows >= 1.0 && rows <= kMostRows)) {
    throw ConfigError(
        "the spacing asks for no or too many rays per column; ask for a spacing from 0.0001 to 1 at 10 m");
  }
  columns_ =
      static_cast<std::uint64_t>(std::max(1.0, std::floor(kElevationTurns / (rows * step_turns * step_turns) + 0.5)));
  elevations_.resize(static_cast<std::size_t>(rows));
  for (std::size_t i = 0; i < elevations_.size(); ++i) {
    const SinCos angle = sin_cos_turns(kLowestTurns + kElevationTurns * (static_cast<double>(i) + 0.5) / rows);
    elevations_[i] = {angle.sin, angle.cos};
  }
}

double ScanSimulator::expected_points() const {
  return hit_share_sum_ * static_cast<double>(columns_) * static_cast<double>(elevations_.size());
}

ScanGrid ScanSimulator::grid() const {
  constexpr double kTurn = 2.0 * std::numbers::pi;
  return {kTurn / static_cast<double>(columns_), kTurn * kElevationTurns / static_cast<double>(elevations_.size()),
          sin_cos_turns(kLowestTurns).sin, sin_cos_turns(kHighestTurns).sin, kMaxRange};
}

double ScanSimulator::hit_share(const Station& station) const {
  RayCaster::Column column;
  std::uint64_t hits = 0;
  for (std::uint64_t i = 0; i < kProbeColumns; ++i) {
    const SinCos azimuth = sin_cos_turns((static_cast<double>(i) + 0.5) / kProbeColumns);
    station.caster.start_column(column, azimuth.sin, azimuth.cos);
    for (std::uint64_t j = 0; j < kProbeRows; ++j) {
      const SinCos elevation =
          sin_cos_turns(kLowestTurns + kElevationTurns * (static_cast<double>(j) + 0.5) / kProbeRows);
      if (station.caster.cast(column, elevation.sin, elevation.cos).range > 0.0) ++hits;
    }
  }
  return static_cast<double>(hits) / (kProbeColumns * kProbeRows);
}

double ScanSimulator::range_across_edge(const Station& station, const RayCaster::Column& column, std::size_t row,
                                        const RayHit& hit) const {
  const double place = (static_cast<double>(row) + 0.5 - kBeamWidth) / static_cast<double>(elevations_.size());
  const SinCos elevation = sin_cos_turns(kLowestTurns + kElevationTurns * place);
  const RayHit other = station.caster.cast(column, elevation.sin, elevation.cos);
  const bool edge = other.range > 0.0 && other.face != hit.face && std::abs(other.range - hit.range) > kDepthEdge;
  return edge ? other.range : 0.0;
}

void ScanSimulator::make(std::uint64_t begin, std::uint64_t end, std::vector<io::FreshPoint>& out) const {
  RayCaster::Column scratch;
  for (std::uint64_t unit = begin; unit < end; ++unit) {
    make_column(static_cast<std::size_t>(unit / columns_), unit % columns_, scratch, out);
  }
}

void ScanSimulator::make_column(std::size_t station_index, std::uint64_t column, RayCaster::Column& scratch,
                                std::vector<io::FreshPoint>& out) const {
  const Station& station = stations_[station_index];
  const SinCos azimuth = sin_cos_turns((static_cast<double>(column) + 0.5) / static_cast<double>(columns_));
  station.caster.start_column(scratch, azimuth.sin, azimuth.cos);
  const std::uint64_t key = derive_key(derive_key(derive_key(settings_.seed, 0), station_index), column);
  for (std::size_t row = 0; row < elevations_.size(); ++row) {
    const Direction& elevation = elevations_[row];
    const RayHit hit = station.caster.cast(scratch, elevation.sin, elevation.cos);
    if (hit.range == 0.0) continue;
    PointRandom random(mix64(key + row * 0xd1342543de82ef95ULL));
    const Face& face = model_.faces[hit.face];
    double range = hit.range;
    bool real = true;
    const double other = settings_.mixed_pixels > 0.0 ? range_across_edge(station, scratch, row, hit) : 0.0;
    if (other > 0.0 && random.uniform() < settings_.mixed_pixels) {
      range += random.uniform() * (other - range);
      real = false;
    } else if (settings_.outliers > 0.0 && random.uniform() < settings_.outliers) {
      range *= random.uniform();
      real = false;
    }
    if (settings_.noise > 0.0) range += settings_.noise * random.normal();
    io::FreshPoint point;
    point.x = station.registered.x + range * elevation.cos * azimuth.cos;
    point.y = station.registered.y + range * elevation.cos * azimuth.sin;
    point.z = station.registered.z + range * elevation.sin;
    point.intensity = intensity(hit, face.material.reflectance);
    point.classification = real ? face.material.classification : std::uint8_t{7};
    point.point_source_id = static_cast<std::uint16_t>(station_index + 1);
    point.label = real ? face.surface : 0;
    point.red = face.material.red;
    point.green = face.material.green;
    point.blue = face.material.blue;
    out.push_back(point);
  }
}

}  // namespace arris::synth
