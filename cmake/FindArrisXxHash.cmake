# xxHash (libxxhash-dev): target arris::xxhash.
find_path(ArrisXxHash_INCLUDE_DIR xxhash.h)
find_library(ArrisXxHash_LIBRARY xxhash)
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(ArrisXxHash REQUIRED_VARS ArrisXxHash_LIBRARY ArrisXxHash_INCLUDE_DIR)
if(ArrisXxHash_FOUND AND NOT TARGET arris::xxhash)
  add_library(arris::xxhash UNKNOWN IMPORTED)
  set_target_properties(arris::xxhash PROPERTIES
    IMPORTED_LOCATION ${ArrisXxHash_LIBRARY}
    INTERFACE_SYSTEM_INCLUDE_DIRECTORIES ${ArrisXxHash_INCLUDE_DIR})
endif()
