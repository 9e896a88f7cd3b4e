#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <map>
#include <sstream>
#include <stdexcept>

#include "strip.h"

namespace arris::test {
namespace {

const std::map<std::string, std::size_t> kTypeBytes{{"char", 1},  {"uchar", 1},  {"short", 2},   {"ushort", 2},
                                                    {"int", 4},   {"uint", 4},   {"float", 4},   {"double", 8},
                                                    {"int8", 1},  {"uint8", 1},  {"int16", 2},   {"uint16", 2},
                                                    {"int32", 4}, {"uint32", 4}, {"float32", 4}, {"float64", 8}};

[[noreturn]] void fail(const std::string& what) {
  throw std::runtime_error("strip_ply: " + what);
}

std::vector<std::string> words_of(const std::string& line) {
  std::istringstream stream(line);
  std::vector<std::string> words;
  for (std::string word; stream >> word;) words.push_back(word);
  return words;
}

struct Property {
  std::size_t size_bytes = 0;
  std::size_t count_bytes = 0;  ///< Of the length of a list, or 0.
};

struct Element {
  std::string name;
  std::uint64_t count = 0;
  std::vector<Property> properties;
};

std::vector<Element> elements_of(const PlyParts& ply) {
  std::vector<Element> elements;
  for (const std::string& line : ply.header) {
    const std::vector<std::string> words = words_of(line);
    if (words.empty()) continue;
    if (words[0] == "element") elements.push_back({words.at(1), std::stoull(words.at(2)), {}});
    if (words[0] != "property") continue;
    const bool list = words.at(1) == "list";
    elements.back().properties.push_back({kTypeBytes.at(words[words.size() - 2]), list ? kTypeBytes.at(words[2]) : 0});
  }
  return elements;
}

/// Steps over the records of a body and copies all but the last `dropped` properties of the vertices.
class Body {
 public:
  Body(const PlyParts& from, PlyParts& to, bool big_endian) : from_(from), to_(to), big_endian_(big_endian) {}

  void copy(const Element& element, std::size_t dropped) {
    for (std::uint64_t i = 0; i < element.count; ++i) {
      for (std::size_t p = 0; p < element.properties.size(); ++p) {
        const Property& property = element.properties[p];
        const bool kept = p + dropped < element.properties.size();
        const std::size_t items = property.count_bytes == 0 ? 1 : list_length(property.count_bytes, kept);
        take(items, items * property.size_bytes, kept);
      }
    }
  }

  void copy_rest() { take(from_.tokens.size() - at_, from_.body.size() - at_, true); }

 private:
  void take(std::size_t tokens, std::size_t bytes, bool kept) {
    const std::size_t step = from_.ascii ? tokens : bytes;
    if (step > (from_.ascii ? from_.tokens.size() : from_.body.size()) - at_) fail("the body is too short");
    if (kept && from_.ascii) {
      const auto first = from_.tokens.begin() + static_cast<std::ptrdiff_t>(at_);
      to_.tokens.insert(to_.tokens.end(), first, first + static_cast<std::ptrdiff_t>(step));
    } else if (kept) {
      to_.body.append(from_.body, at_, step);
    }
    at_ += step;
  }

  std::size_t list_length(std::size_t count_bytes, bool kept) {
    const std::size_t at = at_;
    take(1, count_bytes, kept);
    if (from_.ascii) return std::stoull(from_.tokens[at]);
    std::size_t length = 0;
    for (std::size_t i = 0; i < count_bytes; ++i) {
      const std::size_t place = big_endian_ ? count_bytes - 1 - i : i;
      length |= static_cast<std::size_t>(static_cast<unsigned char>(from_.body[at + i])) << (8 * place);
    }
    return length;
  }

  const PlyParts& from_;
  PlyParts& to_;
  bool big_endian_;
  std::size_t at_ = 0;  ///< Token or byte.
};

/// The header without our comment and properties.
std::vector<std::string> strip_header(const std::vector<std::string>& header, const std::vector<AddedColumn>& columns) {
  std::vector<std::string> kept;
  for (const std::string& line : header) {
    const bool element = line.starts_with("element ");
    if (line.starts_with("comment written by arris .")) continue;
    // Ours are the last properties of the vertices: right before the next element, or the end.
    kept.push_back(line);
    if (!element && !line.starts_with("end_header")) continue;
    std::size_t end = kept.size() - 1;
    for (auto column = columns.rbegin(); column != columns.rend() && end > 0; ++column) {
      const std::vector<std::string> words = words_of(kept[end - 1]);
      if (words.size() != 3 || words[0] != "property" || words[2] != column->name) break;
      --end;
    }
    if (kept.size() - 1 - end == columns.size()) {
      kept.erase(kept.begin() + static_cast<std::ptrdiff_t>(end), kept.end() - 1);
    }
  }
  return kept;
}

}  // namespace

PlyParts split_ply(const std::string& bytes) {
  PlyParts ply;
  const std::size_t first = bytes.find_first_of("\r\n");
  ply.line_end = bytes[first] == '\n' ? "\n" : bytes[first + 1] == '\n' ? "\r\n" : "\r";
  std::size_t at = 0;
  do {
    const std::size_t end = bytes.find(ply.line_end, at);
    if (end == std::string::npos) fail("no end of the header");
    std::string line = bytes.substr(at, end - at);
    if (ply.line_end == "\n" && line.ends_with('\r')) line.pop_back();
    const std::vector<std::string> words = words_of(line);
    if (!words.empty() && words[0] == "element") line = "element " + words.at(1) + " " + words.at(2);
    ply.header.push_back(line);
    if (words.size() > 1 && words[0] == "format") ply.ascii = words[1] == "ascii";
    at = end + ply.line_end.size();
  } while (words_of(ply.header.back()) != std::vector<std::string>{"end_header"});
  if (ply.ascii) {
    ply.tokens = words_of(bytes.substr(at));
  } else {
    ply.body = bytes.substr(at);
  }
  return ply;
}

PlyParts strip_ply(const std::string& output, const std::vector<AddedColumn>& columns) {
  const PlyParts whole = split_ply(output);
  PlyParts stripped = whole;
  stripped.header = strip_header(whole.header, columns);
  if (whole.header.size() - stripped.header.size() != columns.size() + 1) fail("our header lines are not there");
  stripped.tokens.clear();
  stripped.body.clear();
  const bool big_endian = std::any_of(whole.header.begin(), whole.header.end(), [](const std::string& line) {
    return line.starts_with("format binary_big_endian");
  });
  Body body(whole, stripped, big_endian);
  for (const Element& element : elements_of(whole)) {
    body.copy(element, element.name == "vertex" ? columns.size() : 0);
  }
  body.copy_rest();
  return stripped;
}

}  // namespace arris::test
