#include "features/arris/arris_method.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "features/arris/arris_runner.h"
#include "features/neighbourhood/query_loop.h"

namespace arris {
namespace {

/// Local spacings scatter around the typical one; this covers nearly all of them.
constexpr double kHaloMargin = 1.25;

ArrisTask make_task(const PointTree& tree, const TilePoints& tile, const Lattice& lattice,
                    const ArrisParameters& parameters) {
  validate(parameters);
  ArrisTask task{tree, tile.covered, parameters, lattice};
  task.max_reach = parameters.max_radius / lattice.step;
  if (!(task.max_reach <= kMostReach)) {
    throw ConfigError(
        fmt::format("--max-radius {} is {:.3g} lattice steps of {}, more than 2^30: choose a smaller radius or a "
                    "larger lattice step",
                    parameters.max_radius, task.max_reach, lattice.step));
  }
  task.max_d2 = static_cast<std::uint64_t>(task.max_reach * task.max_reach);
  return task;
}

/// Gives what was found at a position to its duplicates too.
void add_duplicates(const PointTree& tree, const TilePoints& tile, const PageVector<ArrisRunner::Found>& found,
                    const std::vector<std::uint32_t>& isolated, TileContours& contours) {
  struct AtEntry {
    std::uint32_t entry;
    const ContourRecord* record;  // Null: isolated.
  };
  std::vector<AtEntry> at;
  for (const ArrisRunner::Found& f : found) at.push_back({tree.entry(f.slot), &f.record});
  for (const std::uint32_t slot : isolated) at.push_back({tree.entry(slot), nullptr});
  std::sort(at.begin(), at.end(), [](const AtEntry& a, const AtEntry& b) { return a.entry < b.entry; });
  for (const auto& [id, entry] : tile.duplicates) {
    const auto it = std::lower_bound(at.begin(), at.end(), entry,
                                     [](const AtEntry& a, std::uint32_t wanted) { return a.entry < wanted; });
    if (it == at.end() || it->entry != entry) continue;
    if (it->record == nullptr) {
      ++contours.isolated;
      continue;
    }
    contours.records.push_back(*it->record);
    contours.records.back().id = id;
  }
}

TileContours extract_with(const TilePoints& tile, const Lattice& lattice, const ArrisParameters& parameters,
                          const std::vector<std::uint8_t>* wanted) {
  TileContours contours;
  const PointTree tree(tile.positions, tile.ids);
  const ArrisTask task = make_task(tree, tile, lattice, parameters);
  if (tile.positions.empty()) return contours;
  PageVector<ArrisRunner::Found> found;
  std::vector<std::uint32_t> isolated;
  contours.unproven = run_queries(
      tree, tile, wanted, [&] { return ArrisRunner(task); },
      [&](const ArrisRunner& runner) {
        found.insert(found.end(), runner.found().begin(), runner.found().end());
        isolated.insert(isolated.end(), runner.isolated().begin(), runner.isolated().end());
      });
  contours.isolated = isolated.size();
  contours.records.reserve(found.size());
  for (const ArrisRunner::Found& f : found) contours.records.push_back(f.record);
  if (!tile.duplicates.empty()) add_duplicates(tree, tile, found, isolated, contours);
  std::sort(contours.records.begin(), contours.records.end(),
            [](const ContourRecord& a, const ContourRecord& b) { return a.id < b.id; });
  return contours;
}

}  // namespace

TileContours extract_arris(const TilePoints& tile, const Lattice& lattice, const ArrisParameters& parameters) {
  return extract_with(tile, lattice, parameters, nullptr);
}

TileContours extract_arris(const TilePoints& tile, const Lattice& lattice, const ArrisParameters& parameters,
                           std::span<const std::uint32_t> queries) {
  std::vector<std::uint8_t> wanted(tile.positions.size());
  for (const std::uint32_t entry : queries) wanted[entry] = 1;
  return extract_with(tile, lattice, parameters, &wanted);
}

double arris_halo(const ArrisParameters& parameters, double spacing) {
  if (parameters.spacing > 0.0) spacing = parameters.spacing;
  const double reach = kHaloMargin * kBallRadii[1] * spacing;
  return parameters.max_radius > 0.0 ? std::min(reach, parameters.max_radius) : reach;
}

}  // namespace arris
