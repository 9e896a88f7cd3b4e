# Compiler settings that every arris target shares.
add_library(arris_settings INTERFACE)
target_compile_features(arris_settings INTERFACE cxx_std_20)
# Contraction to fused multiply-add would make results depend on the processor; see docs/architecture.md, "Numerics".
target_compile_options(arris_settings INTERFACE -ffp-contract=off -Wall -Wextra -Wshadow -Wconversion -Wno-sign-conversion)
if(ARRIS_WERROR)
  target_compile_options(arris_settings INTERFACE -Werror)
endif()
if(ARRIS_SANITIZE)
  target_compile_options(arris_settings INTERFACE -fsanitize=${ARRIS_SANITIZE} -fno-omit-frame-pointer)
  target_link_options(arris_settings INTERFACE -fsanitize=${ARRIS_SANITIZE})
endif()

# arris_add_library(NAME SOURCES... ): static library of one folder, headers included as "folder/file.h".
function(arris_add_library name)
  add_library(${name} STATIC ${ARGN})
  add_library(arris::${name} ALIAS ${name})
  target_include_directories(${name} PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/src> $<INSTALL_INTERFACE:include/arris>)
  target_link_libraries(${name} PUBLIC $<BUILD_INTERFACE:arris_settings>)
  set_target_properties(${name} PROPERTIES POSITION_INDEPENDENT_CODE ON)
endfunction()

# arris_add_test(NAME LABEL SOURCES...): one GoogleTest program, one CTest entry.
function(arris_add_test name label)
  add_executable(${name} ${ARGN})
  target_link_libraries(${name} PRIVATE GTest::gtest_main rapidcheck arris_settings)
  target_compile_options(${name} PRIVATE -O1)  # Tests are compiled more often than they are waited for.
  add_test(NAME ${name} COMMAND ${name})
  set_tests_properties(${name} PROPERTIES LABELS ${label} TIMEOUT 600)
endfunction()
