#include "evaluate/truth.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <fstream>
#include <string_view>

#include "core/error.h"
#include "core/text.h"

namespace arris::evaluate {

namespace {

constexpr std::string_view kMagic = "# arris truth 1";
constexpr std::string_view kColumns = "kind,role,shape,angle_deg,x0,y0,z0,x1,y1,z1,x2,y2,z2,sweep_deg";
constexpr std::string_view kSpacingColumns = ",spacing,spacing_max";
constexpr std::size_t kTextFields = 3;
constexpr std::size_t kNumbers = 11, kSpacingNumbers = 2;
constexpr std::size_t kLongestLine = 4096;
constexpr double kUnitTolerance = 1e-6;  // Of hand-written axes; those that arris writes are good to 1e-15.

struct Row {
  std::array<std::string_view, kTextFields> words;
  std::array<double, kNumbers + kSpacingNumbers> numbers{};
};

class LineReader {
 public:
  LineReader(std::istream& in, const std::string& label) : in_(in), label_(label) {}

  bool next() {
    std::array<char, kLongestLine + 1> buffer;
    ++line_;
    if (!in_.getline(buffer.data(), static_cast<std::streamsize>(buffer.size()))) {
      if (in_.bad()) throw IoError("cannot read truth file " + printable(label_));
      if (in_.eof()) return false;
      fail("is longer than 4096 characters; this is not a truth file");
    }
    text_ = buffer.data();
    if (!text_.empty() && text_.back() == '\r') text_.pop_back();
    return true;
  }
  const std::string& text() const { return text_; }

  [[noreturn]] void fail(const std::string& problem) const {
    throw InputError(fmt::format("truth file {}, line {}: {}", printable(label_), line_, problem));
  }

 private:
  std::istream& in_;
  const std::string& label_;
  std::string text_;
  std::size_t line_ = 0;
};

bool parse_number(std::string_view text, double& value) {
  const auto result = std::from_chars(text.data(), text.data() + text.size(), value);
  return result.ec == std::errc{} && result.ptr == text.data() + text.size() && std::isfinite(value);
}

Row split(const LineReader& reader, bool with_spacing) {
  const std::size_t fields = kTextFields + kNumbers + (with_spacing ? kSpacingNumbers : 0);
  Row row;
  std::string_view rest = reader.text();
  for (std::size_t field = 0; field < fields; ++field) {
    const std::size_t comma = rest.find(',');
    if ((comma == std::string_view::npos) != (field + 1 == fields)) {
      reader.fail(fmt::format("must have {} fields: {}{}", fields, kColumns, with_spacing ? kSpacingColumns : ""));
    }
    const std::string_view value = rest.substr(0, comma);
    if (field < kTextFields) {
      row.words[field] = value;
    } else if (!parse_number(value, row.numbers[field - kTextFields])) {
      reader.fail(fmt::format("\"{}\" is not a finite number", printable(value)));
    }
    if (comma != std::string_view::npos) rest.remove_prefix(comma + 1);
  }
  return row;
}

bool is_role(std::string_view role) {
  return role.find_first_not_of("ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_") ==
         std::string_view::npos;
}

TruthEdge parse_edge(const LineReader& reader, bool with_spacing) {
  const Row row = split(reader, with_spacing);
  const auto& n = row.numbers;
  TruthEdge edge;
  const auto kind = edge_kind(row.words[0]);
  if (!kind) reader.fail(fmt::format("unknown kind \"{}\"", printable(row.words[0])));
  edge.kind = *kind;
  if (!is_role(row.words[1])) reader.fail("the role may hold letters, digits and '_' only");
  edge.role = row.words[1];
  if (row.words[2] != "segment" && row.words[2] != "arc") reader.fail("the shape must be segment or arc");
  edge.shape = row.words[2] == "arc" ? TruthEdge::Shape::kArc : TruthEdge::Shape::kSegment;
  edge.angle_deg = n[0];
  edge.a = {n[1], n[2], n[3]};
  edge.b = {n[4], n[5], n[6]};
  edge.start = {n[7], n[8], n[9]};
  edge.sweep_deg = n[10];
  edge.spacing = n[11];
  edge.spacing_max = n[12];
  if (edge.spacing < 0.0 || edge.spacing_max < 0.0) reader.fail("the spacing must be at least 0");
  if (edge.shape == TruthEdge::Shape::kArc) {
    if (std::abs(norm(edge.b) - 1.0) > kUnitTolerance) reader.fail("the axis of the arc must have length 1");
    const double radius = norm(edge.start);
    if (!(radius > 0.0) || !std::isfinite(radius)) reader.fail("the radius of the arc must be above 0 and finite");
    if (std::abs(dot(edge.b, edge.start)) > kUnitTolerance * radius)
      reader.fail("the axis of the arc must be perpendicular to its start vector");
    if (!(edge.sweep_deg > 0.0 && edge.sweep_deg <= 360.0)) reader.fail("the sweep of the arc must be in (0, 360]");
  }
  if (!std::isfinite(edge.length())) reader.fail("the edge is too long");
  return edge;
}

}  // namespace

double Truth::number(const std::string& key, double otherwise) const {
  const auto found = properties.find(key);
  double value = 0.0;
  if (found == properties.end() || !parse_number(found->second, value) || value < 0.0) return otherwise;
  return value;
}

std::string exact_text(double value) {
  return fmt::format("{:.17g}", value);
}

void write_truth_csv(std::ostream& out, const Truth& truth) {
  out << kMagic << '\n';
  for (const auto& [key, value] : truth.properties) out << "# " << key << '=' << value << '\n';
  const bool with_spacing = std::any_of(truth.edges.begin(), truth.edges.end(), [](const TruthEdge& edge) {
    return edge.spacing > 0.0 || edge.spacing_max > 0.0;
  });
  out << kColumns << (with_spacing ? kSpacingColumns : "") << '\n';
  for (const TruthEdge& edge : truth.edges) {
    out << name(edge.kind) << ',' << edge.role << ',' << (edge.shape == TruthEdge::Shape::kArc ? "arc" : "segment");
    for (const double value : {edge.angle_deg, edge.a.x, edge.a.y, edge.a.z, edge.b.x, edge.b.y, edge.b.z, edge.start.x,
                               edge.start.y, edge.start.z, edge.sweep_deg}) {
      out << ',' << exact_text(value);
    }
    if (with_spacing) out << ',' << exact_text(edge.spacing) << ',' << exact_text(edge.spacing_max);
    out << '\n';
  }
}

void write_truth_csv(const std::filesystem::path& path, const Truth& truth, bool overwrite) {
  const std::string shown = printable(path.string());
  if (!overwrite && std::filesystem::exists(path)) {
    throw ConfigError("output " + shown + " exists; choose another name or allow overwriting");
  }
  const std::filesystem::path partial = path.string() + ".partial";
  std::error_code ignored;
  errno = 0;
  std::ofstream out(partial, std::ios::binary | std::ios::trunc);
  if (out) write_truth_csv(out, truth);
  out.close();
  if (!out) {
    const int reason = errno;
    std::filesystem::remove(partial, ignored);
    throw IoError(
        fmt::format("cannot write {}.partial: {}", shown, reason != 0 ? std::strerror(reason) : "write failed"));
  }
  std::error_code failure;
  std::filesystem::rename(partial, path, failure);
  if (failure) {
    std::filesystem::remove(partial, ignored);
    throw IoError("cannot rename " + shown + ".partial to its final name: " + failure.message());
  }
}

Truth read_truth_csv(std::istream& in, const std::string& label) {
  LineReader reader(in, label);
  Truth truth;
  if (!reader.next() || reader.text() != kMagic) {
    reader.fail(fmt::format("must be \"{}\"; this is not a truth file", kMagic));
  }
  bool columns_seen = false, with_spacing = false;
  while (reader.next()) {
    const std::string_view text = reader.text();
    if (text.empty()) continue;
    if (text.front() == '#') {
      const std::size_t equals = text.find('=');
      if (equals != std::string_view::npos && equals > 2 && text[1] == ' ') {
        truth.properties[std::string(text.substr(2, equals - 2))] = text.substr(equals + 1);
      }
    } else if (!columns_seen) {
      with_spacing = text == std::string(kColumns) + std::string(kSpacingColumns);
      if (text != kColumns && !with_spacing) reader.fail(fmt::format("must name the columns: {}", kColumns));
      columns_seen = true;
    } else {
      truth.edges.push_back(parse_edge(reader, with_spacing));
    }
  }
  if (!columns_seen) reader.fail("the file ends before the line that names the columns; it was cut short");
  return truth;
}

Truth read_truth_csv(const std::filesystem::path& path) {
  errno = 0;
  std::ifstream in(path, std::ios::binary);
  if (!in) {
    throw IoError(fmt::format("cannot open truth file {}: {}", printable(path.string()), std::strerror(errno)));
  }
  return read_truth_csv(in, path.string());
}

}  // namespace arris::evaluate
