#include "pipeline/libraries.h"

#include <fmt/format.h>
#include <openvdb/version.h>
#include <tbb/version.h>
#include <xxhash.h>

#include <Eigen/Core>

#include "io/sqlite_database.h"

namespace arris::pipeline {

std::string library_versions() {
  return fmt::format("OpenVDB {}, TBB {}.{}, Eigen {}.{}.{}, xxHash {}.{}.{}, SQLite {}",
                     OPENVDB_LIBRARY_VERSION_STRING, TBB_VERSION_MAJOR, TBB_VERSION_MINOR, EIGEN_WORLD_VERSION,
                     EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION, XXH_VERSION_MAJOR, XXH_VERSION_MINOR,
                     XXH_VERSION_RELEASE, io::sqlite_version());
}

}  // namespace arris::pipeline
