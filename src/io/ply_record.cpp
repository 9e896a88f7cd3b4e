#include "io/ply_record.h"

#include <fast_float/fast_float.h>
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

#include "core/text.h"
#include "io/bytes.h"
#include "io/input_file.h"

namespace arris::io {
namespace {

bool is_space(char c) {
  return c == ' ' || (c >= '\t' && c <= '\r');
}

/// Older Windows libraries print 1.#INF, -1.#IND, 1.#QNAN00.
bool parse_windows_special(std::string_view token, double& value) {
  const bool negative = token.starts_with('-');
  if (negative) token.remove_prefix(1);
  if (!token.starts_with("1.#")) return false;
  token.remove_prefix(3);
  const bool infinite = token.starts_with("INF");
  if (!infinite && !token.starts_with("IND") && !token.starts_with("QNAN") && !token.starts_with("SNAN")) return false;
  value = infinite ? std::numeric_limits<double>::infinity() : std::numeric_limits<double>::quiet_NaN();
  if (infinite && negative) value = -value;
  return true;
}

bool parse_number(std::string_view token, double& value) {
  if (token.starts_with('+')) {
    token.remove_prefix(1);
    if (token.starts_with('-')) return false;
  }
  const char* end = token.data() + token.size();
  const auto result = fast_float::from_chars(token.data(), end, value);
  // Out of range is none of ours: too large or small a number is infinity or zero.
  if (result.ptr == end && result.ec != std::errc::invalid_argument) return true;
  return parse_windows_special(token, value);
}

template <std::endian kOrder>
double load_as_double(ScalarType type, const std::byte* at) {
  return with_scalar_type(type, [&](auto zero) { return static_cast<double>(load<decltype(zero), kOrder>(at)); });
}

std::string not_a_number(std::string_view token, const PlyProperty& property) {
  const char* hint = token.find(',') != std::string_view::npos ? "; decimals must be written with a point" : "";
  return fmt::format("\"{}\" is not a number ({} {}){}", printable(token, 40), property.is_list ? "list" : "property",
                     printable(property.name, 40), hint);
}

}  // namespace

double load_ply_value(PlyFormat format, ScalarType type, const std::byte* at) {
  return format == PlyFormat::kBigEndian ? load_as_double<std::endian::big>(type, at)
                                         : load_as_double<std::endian::little>(type, at);
}

PlyRecordWalker::PlyRecordWalker(PlyFormat format, const PlyElement& element, const std::vector<int>& wanted)
    : format_(format), values_(wanted.size()) {
  for (const PlyProperty& property : element.properties) steps_.push_back({property, -1});
  for (std::size_t slot = 0; slot < wanted.size(); ++slot)
    steps_.at(static_cast<std::size_t>(wanted[slot])).slot = static_cast<int>(slot);
}

PlyRecordWalker::Result PlyRecordWalker::walk(std::span<const std::byte> bytes, bool file_end) {
  begin_ = end_ = 0;
  if (format_ != PlyFormat::kAscii) return walk_binary(bytes);
  return walk_ascii({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, file_end);
}

PlyRecordWalker::Result PlyRecordWalker::bad(std::string problem) {
  problem_ = std::move(problem);
  return Result::kBad;
}

/// False if the text ends before a token does.
bool PlyRecordWalker::next_token(std::string_view text, bool file_end, std::string_view& token) {
  std::size_t at = end_;
  while (at < text.size() && is_space(text[at])) ++at;
  const std::size_t first = at;
  while (at < text.size() && !is_space(text[at])) ++at;
  if (first == at || (at == text.size() && !file_end)) return false;
  end_ = at;
  token = text.substr(first, at - first);
  return true;
}

PlyRecordWalker::Result PlyRecordWalker::walk_ascii(std::string_view text, bool file_end) {
  std::string_view token;
  bool first = true;
  for (const Step& step : steps_) {
    if (!next_token(text, file_end, token)) return Result::kMore;
    if (first) {
      begin_ = static_cast<std::size_t>(token.data() - text.data());
      follows_line_end_ = text.substr(0, begin_).find_first_of("\r\n") != std::string_view::npos;
      first = false;
    }
    // All are parsed, wanted or not: what is no number shows that the values have gone out of step.
    double value = 0.0;
    if (!step.property.is_list) {
      if (!parse_number(token, value)) return bad(not_a_number(token, step.property));
      if (step.slot >= 0) values_[static_cast<std::size_t>(step.slot)] = value;
      continue;
    }
    std::uint64_t items = 0;
    const auto [end, error] = std::from_chars(token.data(), token.data() + token.size(), items);
    if (error != std::errc{} || end != token.data() + token.size()) {
      return bad(fmt::format("\"{}\" is not the length of a list (property {})", printable(token, 40),
                             printable(step.property.name, 40)));
    }
    for (; items > 0; --items) {
      if (!next_token(text, file_end, token)) return Result::kMore;
      if (!parse_number(token, value)) return bad(not_a_number(token, step.property));
    }
  }
  return Result::kDone;
}

PlyRecordWalker::Result PlyRecordWalker::walk_binary(std::span<const std::byte> bytes) {
  for (const Step& step : steps_) {
    const PlyProperty& property = step.property;
    const std::size_t head = size_bytes(property.is_list ? property.count_type : property.type);
    if (bytes.size() - end_ < head) return Result::kMore;
    const std::byte* at = bytes.data() + end_;
    end_ += head;
    if (!property.is_list) {
      if (step.slot >= 0) values_[static_cast<std::size_t>(step.slot)] = load_ply_value(format_, property.type, at);
      continue;
    }
    const double items = load_ply_value(format_, property.count_type, at);
    if (items < 0.0) return bad(fmt::format("list {} has length {}", printable(property.name, 40), items));
    const double item_bytes = items * static_cast<double>(size_bytes(property.type));
    if (item_bytes > static_cast<double>(FileWindow::kMaxBytes)) {
      return bad(fmt::format("list {} has length {}, more than the {} that a record may take",
                             printable(property.name, 40), items, human_bytes(FileWindow::kMaxBytes)));
    }
    if (static_cast<double>(bytes.size() - end_) < item_bytes) return Result::kMore;
    end_ += static_cast<std::size_t>(item_bytes);
  }
  return Result::kDone;
}

}  // namespace arris::io
