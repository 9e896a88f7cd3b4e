#include "pipeline/text_rows.h"

#include <fmt/format.h>

#include "pipeline/output_name.h"

namespace arris::pipeline {
void check_text_output(const std::filesystem::path& path, const char* option, bool overwrite) {
  check_output_name(path, option, overwrite, {".csv", ".json"});
}

TextRows::TextRows(const std::filesystem::path& path, const char* header, bool overwrite)
    : file_(path, overwrite), json_(small_extension(path) == ".json") {
  file_.write(json_ ? std::string_view("[\n") : std::string_view(fmt::format("{}\n", header)));
}

void TextRows::add(const std::string& row) {
  if (json_ && !first_) file_.write(std::string_view(",\n"));
  first_ = false;
  file_.write(std::string_view(row));
  if (!json_) file_.write(std::string_view("\n"));
}

void TextRows::commit() {
  if (json_) file_.write(std::string_view("\n]\n"));
  file_.commit();
}

}  // namespace arris::pipeline
