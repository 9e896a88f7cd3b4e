#include "support/shared_data.h"

#include <cstdlib>

namespace arris::test {

std::optional<std::filesystem::path> shared_data(const char* relative_path) {
  const char* folder = std::getenv("ARRIS_SHARED_DATA");
  const std::filesystem::path path = std::filesystem::path(folder ? folder : ARRIS_DEFAULT_SHARED_DATA) / relative_path;
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored)) return std::nullopt;
  return path;
}

}  // namespace arris::test
