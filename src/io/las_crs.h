#pragma once
/// @file The coordinate reference system a LAS file names, for people.

#include <string>
#include <vector>

#include "io/las_file.h"

namespace arris::io {

/// Printable texts, each at most 4000 characters; empty where the file does not say, or is damaged.
struct CrsSummary {
  std::string name;  ///< "RGF93 / Lambert-93"; of GeoTIFF keys their citations, else "EPSG:n".
  std::string unit;  ///< Of x and y: "metre".
  std::string text;  ///< The WKT record 2112 whole, if there is one that is not empty; else the name.
  int epsg = 0;      ///< Code in the register of EPSG, 0 if unknown.
};

/// WKT (record 2112) if there is one that is not empty, else the GeoTIFF records (34735, 34737). Never throws for bad
/// content.
CrsSummary describe_crs(const InputFile& file, const LasFile& las);

/// Adds what is wrong with the records of the coordinate reference system. They are carried verbatim all the same.
void note_crs_problems(const InputFile& file, const LasFile& las, std::vector<Problem>& problems);

}  // namespace arris::io
