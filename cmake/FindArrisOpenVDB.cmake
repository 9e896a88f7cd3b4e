# OpenVDB as Debian ships it (libopenvdb-dev): target arris::openvdb. The upstream module asks for development
# packages (Boost, Blosc) that using the library does not need.
find_path(ArrisOpenVDB_INCLUDE_DIR openvdb/openvdb.h)
find_library(ArrisOpenVDB_LIBRARY openvdb)
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(ArrisOpenVDB REQUIRED_VARS ArrisOpenVDB_LIBRARY ArrisOpenVDB_INCLUDE_DIR)
if(ArrisOpenVDB_FOUND AND NOT TARGET arris::openvdb)
  add_library(arris::openvdb UNKNOWN IMPORTED)
  set_target_properties(arris::openvdb PROPERTIES
    IMPORTED_LOCATION ${ArrisOpenVDB_LIBRARY}
    INTERFACE_SYSTEM_INCLUDE_DIRECTORIES ${ArrisOpenVDB_INCLUDE_DIR}
    INTERFACE_LINK_LIBRARIES TBB::tbb)
endif()
