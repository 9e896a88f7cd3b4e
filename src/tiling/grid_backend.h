#pragma once
/// @file What makes and reads the grids of PointGrid. Private to point_grid.h.
///
/// The program `arris` loads it from a module beside it when a job needs grids: linking OpenVDB takes the loader 50 ms,
/// which is most of the time of a short command. Everything else (tests, programs that use the library) is linked with
/// it. Which of both it is depends on the library that defines grid_backend(): see CMakeLists.txt.

#include <cstdint>
#include <functional>
#include <istream>
#include <map>
#include <memory>
#include <ostream>
#include <span>
#include <string>

#include "core/lattice.h"
#include "tiling/point_grid.h"

namespace arris::tiling {

/// Functions as those of PointGrid.
class StoredGrid {
 public:
  virtual ~StoredGrid() = default;
  virtual void write(std::ostream& stream) const = 0;
  virtual SortedPoints take_points() = 0;
};

/// Thread-safe.
class GridBackend {
 public:
  virtual ~GridBackend() = default;
  virtual std::unique_ptr<StoredGrid> make(std::span<const LatticePoint> positions, std::span<const std::uint64_t> ids,
                                           const std::map<std::string, std::string>& metadata) const = 0;
  virtual SortedPoints read(std::istream& stream, const std::function<bool(const LatticeBox&)>& wanted) const = 0;
};

/// The one on OpenVDB.
const GridBackend& vdb_backend();

/// The one of this program. Throws IoError if it cannot be loaded.
const GridBackend& grid_backend();
/// Name of the function of the module that returns a pointer to vdb_backend().
constexpr const char* kVdbModuleFunction = "arris_vdb_backend";
constexpr const char* kVdbModuleFile = "arris_vdb.so";

}  // namespace arris::tiling
