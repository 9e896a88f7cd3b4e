#include "verdict_table.h"

#include <cctype>
#include <cstdlib>
#include <fstream>
#include <ostream>
#include <sstream>
#include <stdexcept>

namespace arris::test {
namespace {

using Row = std::map<std::string, std::string>;

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, separator);) parts.push_back(part);
  if (text.ends_with(separator)) parts.emplace_back();
  return parts;
}

std::uint64_t to_count(const std::string& text) {
  return text.empty() ? 0 : std::stoull(text);
}

Verdict to_verdict(const Row& row) {
  Verdict verdict;
  verdict.path = row.at("path");
  verdict.read = row.at("verdict") == "read";
  verdict.error = row.at("error");
  verdict.format = row.at("format");
  verdict.promised = to_count(row.at("promised"));
  verdict.count = to_count(row.at("count"));
  const std::array<std::string, 3> axes{"x", "y", "z"};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    verdict.sums[axis] = row.at("sum_" + axes[axis]);
    verdict.has_extent = !row.at("min_x").empty();
    if (!verdict.has_extent) continue;
    verdict.min[axis] = std::strtod(row.at("min_" + axes[axis]).c_str(), nullptr);
    verdict.max[axis] = std::strtod(row.at("max_" + axes[axis]).c_str(), nullptr);
  }
  verdict.intensity = row.at("intensity");
  verdict.red = row.at("red");
  verdict.digest = row.at("digest");
  for (const std::string& code : split(row.at("problems"), ' ')) verdict.problems.insert(code);
  for (const std::string& field : split(row.at("wrong_fields"), ' ')) {
    const std::size_t mark = field.find('=');
    verdict.wrong_fields[field.substr(0, mark)] = field.substr(mark + 1);
  }
  return verdict;
}

}  // namespace

std::vector<Verdict> load_verdicts() {
  std::ifstream file(ARRIS_VERDICTS);
  std::string line;
  if (!std::getline(file, line)) throw std::runtime_error("cannot read " ARRIS_VERDICTS);
  const std::vector<std::string> names = split(line, ',');
  std::vector<Verdict> verdicts;
  while (std::getline(file, line)) {
    const std::vector<std::string> cells = split(line, ',');
    if (cells.size() != names.size()) throw std::runtime_error("a line of the table has other columns: " + line);
    Row row;
    for (std::size_t i = 0; i < names.size(); ++i) row[names[i]] = cells[i];
    verdicts.push_back(to_verdict(row));
  }
  return verdicts;
}

std::string test_name(const Verdict& verdict, std::size_t index) {
  std::string name = std::to_string(index) + "_" + std::filesystem::path(verdict.path).filename().string();
  for (char& c : name) {
    if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
  }
  return name;
}

void PrintTo(const Verdict& verdict, std::ostream* out) {
  *out << verdict.path;
}

}  // namespace arris::test
