#pragma once
/// @file Hash of a whole file, for reports.

#include <filesystem>
#include <string>

namespace arris::pipeline {

/// XXH3-64 of the file's bytes as 16 hexadecimal digits. Throws IoError.
std::string content_hash(const std::filesystem::path& path);

}  // namespace arris::pipeline
