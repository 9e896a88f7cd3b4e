#include "pipeline/output_name.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "core/error.h"

namespace arris::pipeline {

std::string small_extension(const std::filesystem::path& path) {
  std::string text = path.extension().string();
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
  return text;
}

void check_output_name(const std::filesystem::path& path, const char* option, bool overwrite,
                       std::initializer_list<const char*> extensions) {
  if (path.empty()) return;
  if (std::find(extensions.begin(), extensions.end(), small_extension(path)) == extensions.end())
    throw ConfigError(fmt::format("{} {}: the name must end in {}", option, path.string(),
                                  fmt::join(extensions.begin(), extensions.end(), " or ")));
  std::error_code unknown;
  if (!overwrite && std::filesystem::exists(path, unknown))
    throw ConfigError(fmt::format("{} exists; add --overwrite to replace it", path.string()));
}

}  // namespace arris::pipeline
