#pragma once
#include <filesystem>
#include <optional>

namespace arris::test {

/// A real scan outside of the project ($ARRIS_SHARED_DATA), or nothing where it is absent: such tests are skipped.
std::optional<std::filesystem::path> shared_data(const char* relative_path);

}  // namespace arris::test

/// Declares `variable`, or skips the test.
#define ARRIS_SHARED_DATA_OR_SKIP(variable, relative)                                    \
  const auto variable##_or_nothing = arris::test::shared_data(relative);                 \
  if (!variable##_or_nothing) GTEST_SKIP() << "shared data is not here: " << (relative); \
  const std::filesystem::path variable = *variable##_or_nothing
