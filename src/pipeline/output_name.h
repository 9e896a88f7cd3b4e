#pragma once
/// @file Names of output files: their extension says what is written.

#include <filesystem>
#include <initializer_list>
#include <string>

namespace arris::pipeline {

/// ".csv", in small letters.
std::string small_extension(const std::filesystem::path& path);

/// Before any work: throws ConfigError unless the name (if not empty) ends in one of `extensions` and is free or may be
/// overwritten.
void check_output_name(const std::filesystem::path& path, const char* option, bool overwrite,
                       std::initializer_list<const char*> extensions);

}  // namespace arris::pipeline
