#pragma once
/// @file Tables as CSV or JSON files, by the extension of their names.

#include <filesystem>
#include <string>

#include "io/output_file.h"

namespace arris::pipeline {

/// Before any work: throws ConfigError unless the name (if not empty) ends in .csv or .json and is free or may be
/// overwritten.
void check_text_output(const std::filesystem::path& path, const char* option, bool overwrite);

/// Lines of CSV below `header`, or elements of one JSON array; written as they come.
class TextRows {
 public:
  TextRows(const std::filesystem::path& path, const char* header, bool overwrite);

  /// Else CSV.
  bool json() const { return json_; }
  void add(const std::string& row);
  void commit();

 private:
  io::OutputFile file_;
  bool json_;
  bool first_ = true;
};

}  // namespace arris::pipeline
