#pragma once
/// @file The coordinate reference system a LAS file names, as text for people.

#include <string>

#include "io/las_file.h"

namespace arris::io {

/// WKT (record 2112) if there is one that is not empty, else the citations of the GeoTIFF records (34735, 34737), else
/// the EPSG code of their projected or geographic key. Printable, at most 4000 characters; empty if nothing is there or
/// it is damaged. Never throws for bad content.
std::string describe_crs(const InputFile& file, const LasFile& las);

}  // namespace arris::io
