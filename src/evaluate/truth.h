#pragma once
/// @file The truth of a scene and its text form, a CSV that any spreadsheet opens.
///
///     # arris truth 1
///     # scene=block
///     # spacing=0.25
///     kind,role,shape,angle_deg,x0,y0,z0,x1,y1,z1,x2,y2,z2,sweep_deg
///     convex,box,segment,90,0,0,0,24,0,0,0,0,0,0
///     rim_convex,cylinder,arc,90,12,12,18,0,0,1,7,0,0,360
///
/// Segment: ends (x0 y0 z0) and (x1 y1 z1). Arc: centre, unit axis, vector from the centre to the first point, sweep.
///
/// Scans whose spacing differs from place to place have two more columns, `spacing` and `spacing_max` (TruthEdge says
/// what they hold); they are written if any edge has one of them. 0: the file's property "spacing" applies.
///
/// Law: reading what was written gives the same doubles, bit for bit.

#include <filesystem>
#include <iosfwd>
#include <map>
#include <string>
#include <vector>

#include "evaluate/truth_edge.h"

namespace arris::evaluate {

struct Truth {
  std::map<std::string, std::string>
      properties;  ///< "scene", "spacing", "noise", "seed", ...: keys and values of one line each.
  std::vector<TruthEdge> edges;

  friend bool operator==(const Truth&, const Truth&) = default;

  /// A property as a finite number >= 0, or `otherwise` if it is absent or no such number.
  double number(const std::string& key, double otherwise) const;
};

/// A double as text with 17 significant digits, so that reading it gives the same bits.
std::string exact_text(double value);

void write_truth_csv(std::ostream& out, const Truth& truth);
/// Writes "<path>.partial" and renames it. Throws IoError, or ConfigError if the file exists and overwrite is not set.
void write_truth_csv(const std::filesystem::path& path, const Truth& truth, bool overwrite);

/// @param label  the file's name, for messages. Throws InputError that names the line.
Truth read_truth_csv(std::istream& in, const std::string& label);
Truth read_truth_csv(const std::filesystem::path& path);

}  // namespace arris::evaluate
