#include "core/units.h"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>
#include <string>
#include <utility>

#include "core/error.h"
#include "core/text.h"

namespace arris {
namespace {

struct Quantity {
  double value;
  std::string unit;
};

Quantity split_quantity(std::string_view text, const char* what) {
  const auto fail = [&] {
    throw ConfigError(fmt::format("{} '{}' is not a number with an optional unit", what, printable(text, 40)));
  };
  while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
  while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
  Quantity quantity{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), quantity.value);
  if (error != std::errc{} || !std::isfinite(quantity.value)) fail();
  std::string_view unit(end, static_cast<std::size_t>(text.data() + text.size() - end));
  while (!unit.empty() && unit.front() == ' ') unit.remove_prefix(1);
  quantity.unit = std::string(unit);
  return quantity;
}

}  // namespace

std::uint64_t parse_size_bytes(std::string_view text, std::uint64_t whole_bytes) {
  const Quantity q = split_quantity(text, "size");
  static constexpr std::array<std::pair<const char*, double>, 15> kUnits{{{"", 1.0},
                                                                          {"B", 1.0},
                                                                          {"K", 1024.0},
                                                                          {"KiB", 1024.0},
                                                                          {"kB", 1e3},
                                                                          {"M", 1048576.0},
                                                                          {"MiB", 1048576.0},
                                                                          {"MB", 1e6},
                                                                          {"G", 1073741824.0},
                                                                          {"GiB", 1073741824.0},
                                                                          {"GB", 1e9},
                                                                          {"T", 1099511627776.0},
                                                                          {"TiB", 1099511627776.0},
                                                                          {"TB", 1e12},
                                                                          {"%", -1.0}}};
  for (const auto& [unit, factor] : kUnits) {
    if (q.unit != unit) continue;
    const double bytes = factor < 0 ? q.value / 100.0 * static_cast<double>(whole_bytes) : q.value * factor;
    if (!(bytes >= 1.0 && bytes < 1.8e19) || (factor < 0 && q.value > 100.0)) break;
    return static_cast<std::uint64_t>(bytes);
  }
  throw ConfigError(
      fmt::format("size '{}' is not understood; write it like 8GiB, 512MiB, 2GB or 60%", printable(text, 40)));
}

double parse_length(std::string_view text) {
  const Quantity q = split_quantity(text, "length");
  static constexpr std::array<std::pair<const char*, double>, 7> kUnits{
      {{"", 1.0}, {"m", 1.0}, {"dm", 0.1}, {"cm", 0.01}, {"mm", 0.001}, {"ft", 0.3048}, {"in", 0.0254}}};
  for (const auto& [unit, factor] : kUnits) {
    if (q.unit == unit && q.value >= 0.0) return q.value * factor;
  }
  throw ConfigError(fmt::format("length '{}' is not understood; write it like 0.03, '5 cm' or 30mm, not negative",
                                printable(text, 40)));
}

double parse_angle_deg(std::string_view text) {
  const Quantity q = split_quantity(text, "angle");
  if (q.unit.empty() || q.unit == "deg") return q.value;
  throw ConfigError(fmt::format("angle '{}' is not understood; write degrees, like 120", printable(text, 40)));
}

}  // namespace arris
