#include "features/liu/liu_method.h"

#include "features/liu/liu_engine.h"
#include "features/liu/liu_runner.h"
#include "features/neighbourhood/query_loop.h"

namespace arris {
TileContours extract_liu_with(const TilePoints& tile, const Lattice& lattice, const LiuParameters& parameters,
                              const std::vector<std::uint8_t>* wanted, const LiuSwitches& switches) {
  const LiuSettings settings(parameters, lattice, switches);
  TileContours contours;
  if (tile.positions.empty()) return contours;
  const PointTree tree(tile.positions, tile.ids);
  ContourAccumulator results(tree.size(), parameters.fold);
  const LiuTask task{tree, tile.covered, settings, results};
  contours.unproven = run_queries(
      tree, tile, wanted, [&] { return LiuRunner(task); }, [](LiuRunner&) {});
  ContourAccumulator::Outcome outcome = results.finish(tree, tile);
  contours.records = std::move(outcome.records);
  contours.isolated = outcome.isolated;
  return contours;
}

TileContours extract_liu(const TilePoints& tile, const Lattice& lattice, const LiuParameters& parameters) {
  return extract_liu_with(tile, lattice, parameters, nullptr, {});
}

TileContours extract_liu(const TilePoints& tile, const Lattice& lattice, const LiuParameters& parameters,
                         std::span<const std::uint32_t> queries) {
  std::vector<std::uint8_t> wanted(tile.positions.size());
  for (const std::uint32_t entry : queries) wanted[entry] = 1;
  return extract_liu_with(tile, lattice, parameters, &wanted, {});
}

}  // namespace arris
