# cmake --install: the program, the library with its headers, and a package that find_package(arris) finds:
#   find_package(arris REQUIRED)  target_link_libraries(mine PRIVATE arris::arris_pipeline)
include(CMakePackageConfigHelpers)

install(TARGETS arris RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
if(NOT ARRIS_SANITIZE)
  install(TARGETS arris_vdb_module LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}/arris)
endif()
install(TARGETS arris_core arris_io arris_tiling arris_vdb arris_vdb_linked arris_features arris_merge arris_evaluate arris_synth arris_pipeline
        EXPORT arrisTargets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(EXPORT arrisTargets NAMESPACE arris:: DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/arris)
foreach(folder core io tiling features merge evaluate synth pipeline)
  install(DIRECTORY src/${folder} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/arris FILES_MATCHING PATTERN "*.h")
endforeach()
install(FILES ${PROJECT_BINARY_DIR}/src/core/include/core/version.h DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/arris/core)

configure_package_config_file(cmake/arrisConfig.cmake.in arrisConfig.cmake
                              INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/arris)
write_basic_package_version_file(arrisConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/arrisConfig.cmake ${CMAKE_CURRENT_BINARY_DIR}/arrisConfigVersion.cmake
              cmake/FindArrisOpenVDB.cmake cmake/FindArrisXxHash.cmake
        DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/arris)
