#include "io/ply_header.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <optional>
#include <set>
#include <utility>

#include "core/error.h"
#include "core/text.h"

namespace arris::io {
namespace {

constexpr std::size_t kMaxHeaderBytes = std::size_t{1} << 20;
constexpr std::size_t kMaxLines = 200'000;
constexpr std::size_t kMaxElements = 4096;
constexpr std::size_t kMaxProblems = 20;

constexpr std::array<const char*, 10> kNewNames{"int8",   "uint8",   "int16",   "uint16", "int32",
                                                "uint32", "float32", "float64", "int64",  "uint64"};

std::optional<ScalarType> parse_type(std::string_view name) {
  for (std::size_t i = 0; i < kNewNames.size(); ++i) {
    const auto type = static_cast<ScalarType>(i);
    if (name == type_name(type) || name == kNewNames[i]) return type;
  }
  return std::nullopt;
}

/// Words between blanks; at most six, which is more than any valid line has (comments are not split).
std::vector<std::string_view> split_words(std::string_view line) {
  constexpr std::string_view kBlanks = " \t\v\f\r";
  std::vector<std::string_view> words;
  for (std::size_t at = line.find_first_not_of(kBlanks); at < line.size() && words.size() < 6;) {
    const std::size_t end = std::min(line.find_first_of(kBlanks, at), line.size());
    words.push_back(line.substr(at, end - at));
    at = line.find_first_not_of(kBlanks, end);
  }
  return words;
}

class HeaderParser {
 public:
  explicit HeaderParser(const InputFile& file) : file_(file) {}

  PlyHeader parse() {
    text_.resize(static_cast<std::size_t>(std::min<std::uint64_t>(file_.size_bytes(), kMaxHeaderBytes)));
    text_.resize(file_.read_some(0, std::as_writable_bytes(std::span(text_))));
    find_line_end();
    while (!ended_) parse_line(next_line());
    header_.body_begin = at_;
    if (!has_format_) refuse("there is no \"format\" line");
    check_vertices();
    return std::move(header_);
  }

 private:
  [[noreturn]] void refuse(std::string_view what,
                           std::string_view remedy = "the header is damaged: export the file again") const {
    io::refuse(file_, line_begin_,
               fmt::format("PLY header, line {}: {}", std::max<std::size_t>(1, header_.lines.size()), what), remedy);
  }

  void find_line_end() {
    const std::size_t end = text_.find_first_of("\r\n");
    if (!text_.starts_with("ply") || end == std::string::npos || split_words(text_.substr(0, end)).size() != 1) {
      refuse("this is not a PLY file: it does not begin with a line \"ply\"", "give a LAS or PLY file");
    }
    const bool carriage = text_[end] == '\r';
    const bool both = carriage && end + 1 < text_.size() && text_[end + 1] == '\n';
    header_.line_end = both ? "\r\n" : carriage ? "\r" : "\n";
  }

  /// Lines end at LF, or at CR if the first one does. A CR before LF is dropped, whatever the first line had.
  std::string_view next_line() {
    const char last = header_.line_end.back();
    const std::size_t end = text_.find(last, at_);
    line_begin_ = at_;
    if (end == std::string::npos) {
      refuse(text_.size() == kMaxHeaderBytes ? "the header exceeds 1 MiB without \"end_header\""
                                             : "the file ends within the header, \"end_header\" is missing");
    }
    std::string_view line = std::string_view(text_).substr(at_, end - at_);
    if (last == '\n' && line.ends_with('\r')) line.remove_suffix(1);
    at_ = end + 1;
    if (header_.lines.size() == kMaxLines) refuse(fmt::format("the header has more than {} lines", kMaxLines));
    header_.lines.emplace_back(line);
    return line;
  }

  void parse_line(std::string_view line) {
    const auto words = split_words(line);
    const std::string_view keyword = words.empty() ? std::string_view{} : words[0];
    if (header_.lines.size() == 1 || keyword.empty() || keyword == "comment" || keyword == "obj_info") return;
    if (keyword == "format") return parse_format(words);
    if (keyword == "element") return parse_element(words);
    if (keyword == "property") return parse_property(words);
    ended_ = keyword == "end_header";
    if (!ended_) pass_unknown(keyword);
  }

  /// Some writers break a comment into lines. Before the first element that is harmless; later it may be a misspelt
  /// property.
  void pass_unknown(std::string_view keyword) {
    if (!header_.elements.empty()) refuse(fmt::format("unknown keyword \"{}\"", printable(keyword, 40)));
    header_.problems.push_back({"ply-keyword",
                                fmt::format("PLY header, line {}: unknown keyword \"{}\", taken as a comment",
                                            header_.lines.size(), printable(keyword, 40)),
                                line_begin_});
    header_.lines.back().insert(0, "comment ");
    if (header_.problems.size() > kMaxProblems) refuse("too many unknown keywords");
  }

  void parse_format(const std::vector<std::string_view>& words) {
    if (has_format_) refuse("a second \"format\" line");
    if (words.size() != 3) refuse("expected \"format <name> 1.0\"");
    if (words[1] == "ascii") {
      header_.format = PlyFormat::kAscii;
    } else if (words[1] == "binary_little_endian") {
      header_.format = PlyFormat::kLittleEndian;
    } else if (words[1] == "binary_big_endian") {
      header_.format = PlyFormat::kBigEndian;
    } else {
      refuse(fmt::format("unknown format \"{}\"", printable(words[1], 40)));
    }
    has_format_ = true;
    header_.version = words[2];
    if (words[2] != "1.0") {
      header_.problems.push_back(
          {"ply-version", fmt::format("PLY version \"{}\" is read as 1.0", printable(words[2], 40)), line_begin_});
    }
  }

  void parse_element(const std::vector<std::string_view>& words) {
    if (words.size() != 3) refuse("expected \"element <name> <count>\"");
    PlyElement element;
    element.name = words[1];
    element.line = header_.lines.size() - 1;
    std::string_view digits = words[2];
    if (digits.starts_with('+')) digits.remove_prefix(1);
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), element.count);
    if (error != std::errc{} || end != digits.data() + digits.size()) {
      refuse(fmt::format("\"{}\" is not a number of elements", printable(words[2], 40)));
    }
    for (const PlyElement& other : header_.elements) {
      if (other.name == element.name) refuse(fmt::format("a second element \"{}\"", printable(element.name, 40)));
    }
    if (header_.elements.size() == kMaxElements) refuse("more than 4096 elements");
    header_.elements.push_back(std::move(element));
    names_.clear();
  }

  void parse_property(const std::vector<std::string_view>& words) {
    if (header_.elements.empty()) refuse("a property before any element");
    PlyProperty property;
    property.is_list = words.size() >= 2 && words[1] == "list";
    if (words.size() != (property.is_list ? 5U : 3U)) {
      refuse("expected \"property <type> <name>\" or \"property list <type> <type> <name>\"");
    }
    if (property.is_list) {
      property.count_type = known_type(words[2]);
      if (!is_integer(property.count_type)) refuse("the length of a list must have an integer type");
    }
    property.type = known_type(words[words.size() - 2]);
    property.name = words.back();
    if (!names_.insert(property.name).second) {
      refuse(fmt::format("a second property \"{}\"", printable(property.name, 40)), "rename one of them");
    }
    header_.elements.back().properties.push_back(std::move(property));
  }

  ScalarType known_type(std::string_view name) const {
    if (const auto type = parse_type(name)) return *type;
    refuse(fmt::format("unknown type \"{}\"", printable(name, 40)));
  }

  void check_vertices() {
    std::string names;
    for (std::size_t i = 0; i < header_.elements.size(); ++i) {
      if (header_.elements[i].name == "vertex") header_.vertex = i;
      if (names.size() < 200) names += (i > 0 ? ", " : "") + printable(header_.elements[i].name, 40);
    }
    if (header_.elements.empty() || header_.vertices().name != "vertex") {
      io::refuse(file_, 0, fmt::format("there is no element \"vertex\", only: {}", names.empty() ? "none" : names),
                 "a point cloud needs vertices with x, y and z");
    }
    for (const char* axis : {"x", "y", "z"}) {
      if (header_.vertices().find(axis) >= 0) continue;
      io::refuse(file_, 0, fmt::format("the vertices have no property \"{}\"", axis),
                 "x, y and z are needed: name them so, each with a number of its own");
    }
  }

  const InputFile& file_;
  PlyHeader header_;
  std::string text_;
  std::size_t at_ = 0;
  std::size_t line_begin_ = 0;
  bool ended_ = false;
  bool has_format_ = false;
  std::set<std::string> names_;  ///< Of the current element's properties.
};

}  // namespace

bool PlyElement::has_list() const {
  return std::any_of(properties.begin(), properties.end(), [](const PlyProperty& p) { return p.is_list; });
}

std::size_t PlyElement::least_bytes() const {
  std::size_t total = 0;
  for (const PlyProperty& p : properties) total += size_bytes(p.is_list ? p.count_type : p.type);
  return total;
}

int PlyElement::find(std::string_view property) const {
  for (std::size_t i = 0; i < properties.size(); ++i) {
    if (!properties[i].is_list && properties[i].name == property) return static_cast<int>(i);
  }
  return -1;
}

const char* format_name(PlyFormat format) {
  return format == PlyFormat::kAscii          ? "ascii"
         : format == PlyFormat::kLittleEndian ? "binary_little_endian"
                                              : "binary_big_endian";
}

PlyHeader read_ply_header(const InputFile& file) {
  return HeaderParser(file).parse();
}

}  // namespace arris::io
