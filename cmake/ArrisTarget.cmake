# Compiler settings that every arris target shares.
add_library(arris_settings INTERFACE)
target_compile_features(arris_settings INTERFACE cxx_std_20)
# Contraction to fused multiply-add would make results depend on the processor; see docs/architecture.md, "Numerics".
target_compile_options(arris_settings INTERFACE -ffp-contract=off)
# Neither changes a value: square roots and selections become vector code if nobody reads errno or floating-point exceptions.
target_compile_options(arris_settings INTERFACE -fno-math-errno -fno-trapping-math)
target_compile_options(arris_settings INTERFACE -Wall -Wextra -Wshadow -Wconversion -Wno-sign-conversion)
if(ARRIS_WERROR)
  target_compile_options(arris_settings INTERFACE -Werror)
endif()
# Directories of test code set it. What tests do themselves is watched by ASan and TSan, not by UBSan, whose checks of
# their templates take more than half of such a build; the libraries and arris have them all.
define_property(TARGET PROPERTY ARRIS_TEST_CODE INHERITED BRIEF_DOCS "Code of tests")
if(ARRIS_SANITIZE)
  target_compile_options(arris_settings INTERFACE -fsanitize=${ARRIS_SANITIZE} -fno-omit-frame-pointer
                         $<$<BOOL:$<TARGET_PROPERTY:ARRIS_TEST_CODE>>:-fno-sanitize=undefined>)
  target_link_options(arris_settings INTERFACE -fsanitize=${ARRIS_SANITIZE})
endif()
if(ARRIS_SANITIZE MATCHES "undefined")
  # What UBSan finds ends the program: only printed, it fails no test. As no code follows a finding, less is compiled: a
  # file full of OpenVDB's templates comes to half the code and two fifths of the data.
  target_compile_options(arris_settings INTERFACE -fno-sanitize-recover=all)
  # UBSan describes every place it checks by pointers. In a program that is loaded anywhere the loader would write them
  # all anew, in memory of its own, at each of the many starts that the tests make.
  target_link_options(arris_settings INTERFACE -no-pie)
endif()

# arris_add_library(NAME SOURCES... ): static library of one folder, headers included as "folder/file.h".
function(arris_add_library name)
  add_library(${name} STATIC ${ARGN})
  add_library(arris::${name} ALIAS ${name})
  target_include_directories(${name} PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/src> $<INSTALL_INTERFACE:include/arris>)
  target_link_libraries(${name} PUBLIC $<BUILD_INTERFACE:arris_settings>)
  set_target_properties(${name} PROPERTIES POSITION_INDEPENDENT_CODE ON)
  # Only with sanitizers: in a release every file proves that it includes what it uses.
  if(ARRIS_SANITIZE AND name STREQUAL arris_core)
    target_precompile_headers(arris_core PRIVATE <algorithm> <array> <cmath> <cstdint> <filesystem> <functional> <map>
                              <memory> <optional> <span> <string> <vector> <fmt/format.h>)
  elseif(ARRIS_SANITIZE)
    target_precompile_headers(${name} REUSE_FROM arris_core)
  endif()
endfunction()

# Optimisation of code that is compiled more often than it is waited for: tests, the command line. The sanitizers double
# the size of such code, and optimising it would take most of their builds; unoptimised they see the same and more.
set(ARRIS_LIGHT_OPTIMISATION -O1)
if(ARRIS_SANITIZE)
  set(ARRIS_LIGHT_OPTIMISATION -O0)
endif()

# arris_add_test(NAME LABELS SOURCES...): one GoogleTest program, one CTest entry of the same name.
function(arris_add_test name labels)
  add_executable(${name} ${ARGN})
  target_link_libraries(${name} PRIVATE GTest::gtest_main rapidcheck arris_settings)
  target_compile_options(${name} PRIVATE ${ARRIS_LIGHT_OPTIMISATION})
  target_precompile_headers(${name} REUSE_FROM arris_test_headers)
  arris_add_test_run(${name} ${name} "${labels}")
endfunction()

# arris_add_test_run(TEST PROGRAM LABELS ARGUMENTS...): a CTest entry that runs a test program. For every label (quick,
# long, pipeline: tests/README.md) there is a target labelled_LABEL that builds what `ctest -L LABEL` runs.
function(arris_add_test_run test program labels)
  add_test(NAME ${test} COMMAND ${program} ${ARGN})
  set_tests_properties(${test} PROPERTIES LABELS "${labels}" TIMEOUT 600)
  foreach(label IN LISTS labels)
    if(NOT TARGET labelled_${label})
      add_custom_target(labelled_${label})
    endif()
    add_dependencies(labelled_${label} ${program})
  endforeach()
endfunction()

# arris_test_runs_arris(PROGRAM TESTS...): these tests of a program run `arris`.
function(arris_test_runs_arris program)
  add_dependencies(${program} arris)
  set_tests_properties(${ARGN} PROPERTIES ENVIRONMENT "ARRIS_PROGRAM=$<TARGET_FILE:arris>" TIMEOUT 3600)
endfunction()
