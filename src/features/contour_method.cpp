#include "features/contour_method.h"

#include <algorithm>

#include "core/columns.h"
#include "features/arris_method.h"
#include "features/liu_method.h"

namespace arris {
namespace {

bool is_arris(const ContourParameters& parameters) {
  return parameters.method == ContourParameters::Method::kArris;
}

}  // namespace

const double kContourBytesPerPoint = std::max(kArrisBytesPerPoint, kLiuBytesPerPoint);
const double kContourBytesPerThread = std::max(kArrisBytesPerThread, kLiuBytesPerThread);

void validate(const ContourParameters& parameters) {
  is_arris(parameters) ? validate(parameters.arris) : validate(parameters.liu);
}

TileContours extract_contours(const TilePoints& tile, const Lattice& lattice, const ContourParameters& parameters) {
  return is_arris(parameters) ? extract_arris(tile, lattice, parameters.arris)
                              : extract_liu(tile, lattice, parameters.liu);
}

TileContours extract_contours(const TilePoints& tile, const Lattice& lattice, const ContourParameters& parameters,
                              std::span<const std::uint32_t> queries) {
  return is_arris(parameters) ? extract_arris(tile, lattice, parameters.arris, queries)
                              : extract_liu(tile, lattice, parameters.liu, queries);
}

double contour_halo(const ContourParameters& parameters, double spacing) {
  return is_arris(parameters) ? arris_halo(parameters.arris, spacing) : liu_halo(parameters.liu, spacing);
}

void finish_record(ContourRecord& record, const ContourParameters& parameters) {
  if (is_arris(parameters)) return;  // Scored and filtered point by point.
  if (record.votes < static_cast<std::uint32_t>(parameters.liu.min_votes)) {
    record.classes = static_cast<std::uint8_t>(record.classes & ~kFold);
    record.votes = 0;
    record.fold_angle_deg = 0.0F;
  }
  record.score = record.classes ? liu_score(record, parameters.liu) : 0.0F;
}

}  // namespace arris
