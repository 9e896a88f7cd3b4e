#include "libraries.h"

#include <fmt/format.h>

#include <CLI/Version.hpp>
#include <nlohmann/json.hpp>

#include "core/version.h"
#include "pipeline/libraries.h"

namespace arris::tools {

std::string version_text() {
  return fmt::format("arris {} ({}, fmt {}.{}.{}, nlohmann-json {}.{}.{}, CLI11 {})", kVersion,
                     pipeline::library_versions(), FMT_VERSION / 10000, FMT_VERSION / 100 % 100, FMT_VERSION % 100,
                     NLOHMANN_JSON_VERSION_MAJOR, NLOHMANN_JSON_VERSION_MINOR, NLOHMANN_JSON_VERSION_PATCH,
                     CLI11_VERSION);
}

}  // namespace arris::tools
