#include "evaluate/plane_text.h"

#include <fmt/format.h>

#include <array>
#include <nlohmann/json.hpp>
#include <string_view>

#include "core/text.h"

namespace arris::evaluate {

namespace {

using Json = nlohmann::ordered_json;

struct Count {
  std::string_view name;
  std::uint64_t value;
};
struct Rate {
  std::string_view name;
  std::optional<double> value;
};

std::array<Count, 10> counts_of(const PlaneFigures& f) {
  const PlaneRelations& r = f.relations;
  return {{{"planes", f.planes},
           {"planes_found", f.planes_found},
           {"segments", f.segments},
           {"segments_right", f.segments_right},
           {"one_to_one", r.one_to_one},
           {"one_to_many", r.one_to_many},
           {"many_to_one", r.many_to_one},
           {"many_to_many", r.many_to_many},
           {"planes_alone", r.planes_alone},
           {"segments_alone", r.segments_alone}}};
}

std::array<Rate, 6> rates_of(const PlaneFigures& f) {
  return {{{"found_rate", f.found_rate},
           {"right_rate", f.right_rate},
           {"quality", f.quality},
           {"completeness", f.completeness},
           {"correctness", f.correctness},
           {"iou", f.iou}}};
}

std::optional<double> share(std::uint64_t part, std::uint64_t whole) {
  if (whole == 0) return std::nullopt;
  return static_cast<double>(part) / static_cast<double>(whole);
}

std::array<Rate, 3> point_rates(const PlaneComparison& c) {
  return {{{"unsegmented_share", share(c.points_unsegmented, c.points)},
           {"strays_unsegmented_share", share(c.strays_unsegmented, c.strays)},
           {"adjusted_rand", c.adjusted_rand}}};
}

Json number(const std::optional<double>& value) {
  return value ? Json(*value) : Json(nullptr);
}

Json figures_json(const PlaneFigures& f) {
  Json result = Json::object();
  for (const Count& count : counts_of(f)) result[std::string(count.name)] = count.value;
  for (const Rate& rate : rates_of(f)) result[std::string(rate.name)] = number(rate.value);
  return result;
}

std::string text(const std::optional<double>& value) {
  return value ? fmt::format("{:.4f}", *value) : "-";
}

}  // namespace

Json planes_json(const PlaneComparison& c) {
  Json result{{"min_area", c.min_area}, {"points", c.points}, {"strays", c.strays}};
  for (const Rate& rate : point_rates(c)) result[std::string(rate.name)] = number(rate.value);
  result["all"] = figures_json(c.all);
  result["large"] = figures_json(c.large);
  Json matches = Json::array();
  for (const PlaneMatch& match : c.matches) {
    matches.push_back({{"face", match.face},
                       {"points", match.points},
                       {"area", static_cast<double>(match.points) * c.spacing * c.spacing},
                       {"segment", match.segment},
                       {"completeness", match.completeness()},
                       {"correctness", number(match.correctness())},
                       {"iou", match.iou()}});
  }
  result["matches"] = matches;
  return result;
}

std::vector<std::pair<std::string, std::string>> planes_cells(const PlaneComparison& c) {
  std::vector<std::pair<std::string, std::string>> cells;
  const auto add_rate = [&](std::string_view set, const Rate& rate) {
    cells.emplace_back(fmt::format("plane_{}{}", set, rate.name), rate.value ? fmt::format("{:.6g}", *rate.value) : "");
  };
  cells.emplace_back("plane_min_area", fmt::format("{:.6g}", c.min_area));
  for (const Rate& rate : point_rates(c)) add_rate("", rate);
  for (const auto& [set, figures] : {std::pair{"all_", &c.all}, std::pair{"large_", &c.large}}) {
    for (const Count& count : counts_of(*figures)) {
      cells.emplace_back(fmt::format("plane_{}{}", set, count.name), fmt::format("{}", count.value));
    }
    for (const Rate& rate : rates_of(*figures)) add_rate(set, rate);
  }
  return cells;
}

std::string planes_table(const PlaneComparison& c) {
  std::string result = fmt::format(
      "planes    {} points, {} without a segment; {} points on no surface, {} without a segment\n", grouped(c.points),
      text(share(c.points_unsegmented, c.points)), grouped(c.strays), text(share(c.strays_unsegmented, c.strays)));
  constexpr std::string_view kRow = "{:<28} {:>10} {:>10}\n";
  result += fmt::format(kRow, "", "all", fmt::format(">= {:.3g}", c.min_area));
  const auto line = [&](std::string_view name, const std::string& all, const std::string& large) {
    result += fmt::format(kRow, name, all, large);
  };
  const auto of = [](std::uint64_t part, std::uint64_t whole) { return fmt::format("{} / {}", part, whole); };
  const PlaneFigures &a = c.all, &b = c.large;
  line("planes found", of(a.planes_found, a.planes), of(b.planes_found, b.planes));
  line("segments right", of(a.segments_right, a.segments), of(b.segments_right, b.segments));
  line("quality", text(a.quality), text(b.quality));
  line("completeness of planes", text(a.completeness), text(b.completeness));
  line("correctness of planes", text(a.correctness), text(b.correctness));
  line("IoU of planes", text(a.iou), text(b.iou));
  const auto relations = [](const PlaneRelations& r) {
    return fmt::format("1:1 {}, 1:M {}, N:1 {}, N:M {}, planes alone {}, segments alone {}", r.one_to_one,
                       r.one_to_many, r.many_to_one, r.many_to_many, r.planes_alone, r.segments_alone);
  };
  result += fmt::format("planes : segments, all       {}\n", relations(a.relations));
  result += fmt::format("planes : segments, >= {:<7.3g}{}\n", c.min_area, relations(b.relations));
  return result + fmt::format("adjusted Rand index, all points {}\n", text(c.adjusted_rand));
}

}  // namespace arris::evaluate
