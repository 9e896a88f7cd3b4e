#pragma once
/// @file What people want to know of a coordinate reference system in well-known text (OGC 01-009, ISO 19162).

#include <string>
#include <string_view>

namespace arris::io {

/// The quoted name of the outermost node: "RGF93 / Lambert-93". Empty if there is none.
std::string wkt_name(std::string_view text);

/// Name of the unit of the horizontal axes: that of the projected system if there is one, else of the geographic one.
/// Empty if the text does not say, or is damaged. Linear time; never throws for bad content.
std::string wkt_unit(std::string_view text);

/// Code of the outermost node in the register of EPSG: 2154; 0 if the text does not say, or is damaged. Linear time;
/// never throws for bad content.
int wkt_epsg(std::string_view text);

}  // namespace arris::io
