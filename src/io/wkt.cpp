#include "io/wkt.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <span>
#include <vector>

namespace arris::io {
namespace {

/// Nodes deeper than this are not followed; real texts need ten levels.
constexpr std::size_t kMaxDepth = 64;

bool is_word(char c) {
  return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || c == '_';
}

std::string upper(std::string_view word) {
  std::string text(word);
  for (char& c : text) {
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  }
  return text;
}

bool is_one_of(const std::string& word, std::span<const char* const> words) {
  return std::any_of(words.begin(), words.end(), [&](const char* other) { return word == other; });
}

constexpr std::array kProjected{"PROJCS", "PROJCRS", "PROJECTEDCRS"};
constexpr std::array kGeographic{"GEOGCS", "GEOGCRS", "GEOGRAPHICCRS", "GEODCRS"};
constexpr std::array kUnits{"UNIT", "LENGTHUNIT", "ANGLEUNIT"};
constexpr std::array kRegisters{"AUTHORITY", "ID"};
constexpr std::array kApart{"DATUM",      "GEODETICDATUM", "PRIMEM",   "PRIMEMERIDIAN", "BASEGEOGCRS", "BASEGEODCRS",
                            "CONVERSION", "ELLIPSOID",     "SPHEROID", "VERT_CS",       "VERTCRS"};

/// Calls use(path, name) for every node that begins with a quoted name; path holds the keywords from the root on.
template <typename Use>
void for_each_named_node(std::string_view text, Use&& use) {
  std::vector<std::string> path;
  std::size_t word_begin = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '"') {
      const std::size_t end = std::min(text.find('"', i + 1), text.size());
      if (i > 0 && (text[i - 1] == '[' || text[i - 1] == '(')) use(path, text.substr(i + 1, end - i - 1));
      i = end;
    } else if (c == '[' || c == '(') {
      std::size_t begin = i;
      while (begin > word_begin && is_word(text[begin - 1])) --begin;
      if (path.size() == kMaxDepth) return;
      path.push_back(upper(text.substr(begin, i - begin)));
    } else if (c == ']' || c == ')') {
      if (path.empty()) return;
      path.pop_back();
    }
    if (!is_word(c)) word_begin = i + 1;
  }
}

bool lies_in(const std::vector<std::string>& path, std::span<const char* const> words) {
  return std::any_of(path.begin(), path.end(), [&](const std::string& word) { return is_one_of(word, words); });
}

}  // namespace

std::string wkt_name(std::string_view text) {
  std::string found;
  for_each_named_node(text, [&](const std::vector<std::string>& path, std::string_view name) {
    if (path.size() == 1 && found.empty()) found = name;
  });
  return found;
}

std::string wkt_unit(std::string_view text) {
  std::string projected;
  std::string geographic;
  for_each_named_node(text, [&](const std::vector<std::string>& path, std::string_view name) {
    if (!is_one_of(path.back(), kUnits)) return;
    const bool in_projected = lies_in(path, kProjected);
    const bool in_geographic = lies_in(path, kGeographic);
    if (in_projected && !in_geographic && !lies_in(path, kApart)) projected = name;
    if (in_geographic && !in_projected && !lies_in(path, kApart)) geographic = name;
  });
  return projected.empty() ? geographic : projected;
}

int wkt_epsg(std::string_view text) {
  int code = 0;
  for_each_named_node(text, [&](const std::vector<std::string>& path, std::string_view name) {
    if (path.size() != 2 || !is_one_of(path.back(), kRegisters) || upper(name) != "EPSG") return;
    // `name` lies in `text`; behind its quote comes the code, a number or a quoted one.
    std::string_view rest =
        text.substr(std::min(static_cast<std::size_t>(name.data() - text.data()) + name.size() + 1, text.size()));
    rest.remove_prefix(std::min(rest.find_first_not_of(", \t\n\""), rest.size()));
    int value = 0;
    const auto [end, error] = std::from_chars(rest.data(), rest.data() + rest.size(), value);
    if (error == std::errc{} && value > 0) code = value;
  });
  return code;
}

}  // namespace arris::io
