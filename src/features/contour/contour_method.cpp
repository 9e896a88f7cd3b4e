#include "features/contour/contour_method.h"

#include <algorithm>

#include "core/columns.h"
#include "features/arris/arris_method.h"
#include "features/liu/liu_method.h"

namespace arris {

using Method = ContourParameters::Method;

const double kContourBytesPerThread = std::max({kArrisBytesPerThread, kLiuBytesPerThread, kZhengBytesPerThread});

double contour_bytes_per_point(const ContourParameters& parameters) {
  switch (parameters.method) {
    case Method::kArris:
      return kArrisBytesPerPoint;
    case Method::kLiu:
      return kLiuBytesPerPoint;
    case Method::kZheng:
      break;
  }
  return kZhengBytesPerPoint;
}

double contour_bytes_per_thread(const ContourParameters& parameters) {
  // Where noise makes balls large, liu needs as much as arris.
  return parameters.by_supervoxels() ? kZhengBytesPerThread : std::max(kArrisBytesPerThread, kLiuBytesPerThread);
}

std::string_view ContourParameters::name() const {
  return method == Method::kArris ? "arris" : method == Method::kLiu ? "liu" : "zheng";
}
double ContourParameters::spacing() const {
  return method == Method::kArris ? arris.spacing : method == Method::kLiu ? liu.spacing : zheng.spacing;
}
double ContourParameters::max_radius() const {
  return method == Method::kArris ? arris.max_radius : method == Method::kLiu ? liu.max_radius : zheng_halo(zheng);
}
void ContourParameters::set_max_radius(double radius) {
  if (method == Method::kArris) arris.max_radius = radius;
  if (method == Method::kLiu) liu.max_radius = radius;
}
bool ContourParameters::any_test() const {
  return method == Method::kArris ? arris.boundary || arris.fold
         : method == Method::kLiu ? liu.boundary || liu.fold
                                  : zheng.boundary || zheng.fold;
}

void validate(const ContourParameters& parameters) {
  switch (parameters.method) {
    case Method::kArris:
      return validate(parameters.arris);
    case Method::kLiu:
      return validate(parameters.liu);
    case Method::kZheng:
      validate(parameters.zheng);
      return validate(parameters.supervoxel);
  }
}

TileContours extract_contours(const TilePoints& tile, const Lattice& lattice, const ContourParameters& parameters) {
  return parameters.method == Method::kArris ? extract_arris(tile, lattice, parameters.arris)
                                             : extract_liu(tile, lattice, parameters.liu);
}

TileContours extract_contours(const TilePoints& tile, const Lattice& lattice, const ContourParameters& parameters,
                              std::span<const std::uint32_t> queries) {
  return parameters.method == Method::kArris ? extract_arris(tile, lattice, parameters.arris, queries)
                                             : extract_liu(tile, lattice, parameters.liu, queries);
}

double contour_halo(const ContourParameters& parameters, double spacing) {
  return parameters.method == Method::kArris ? arris_halo(parameters.arris, spacing)
         : parameters.method == Method::kLiu ? liu_halo(parameters.liu, spacing)
                                             : zheng_halo(parameters.zheng);
}

void finish_record(ContourRecord& record, const ContourParameters& parameters) {
  if (parameters.method != Method::kLiu) return;  // Scored and filtered point by point.
  if (record.votes < static_cast<std::uint32_t>(parameters.liu.min_votes)) {
    record.classes = static_cast<std::uint8_t>(record.classes & ~kFold);
    record.votes = 0;
    record.fold_angle_deg = 0.0F;
  }
  record.score = record.classes ? liu_score(record, parameters.liu) : 0.0F;
}

}  // namespace arris
