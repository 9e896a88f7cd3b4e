#include "pipeline/ground_stage.h"

#include <cmath>
#include <utility>

#include "core/error.h"
#include "pipeline/batch_pass.h"

namespace arris::pipeline {
namespace {

constexpr std::size_t kGroundClass = 2;

}  // namespace

GroundModel read_ground(io::InputSet& inputs, ProgressSink& progress, const CancelToken& cancel) {
  GroundSums sums;
  io::ReadOptions options;
  options.exclusion.only_classes.set(kGroundClass);
  for_each_batch(inputs, options, "ground", progress, cancel, [&](std::size_t index, const io::PointBatch& batch) {
    const io::SourceInfo& source = inputs.sources()[index];
    for (std::size_t i = 0; i < batch.count; ++i) {
      if (batch.excluded[i] != 0) continue;
      sums.add(io::world_coordinate(source, batch, i, 0), io::world_coordinate(source, batch, i, 1),
               io::world_coordinate(source, batch, i, 2));
    }
  });
  if (sums.empty())
    throw InputError("no point is classified as ground (class 2); classify the scan or leave out --min-height");
  return GroundModel(std::move(sums));
}

io::PointFilter above_ground(std::shared_ptr<const GroundModel> ground, double min_height,
                             const std::vector<io::SourceInfo>& sources) {
  return [ground = std::move(ground), min_height, sources](std::size_t index, io::PointBatch& batch) {
    const io::SourceInfo& source = sources.at(index);
    for (std::size_t i = 0; i < batch.count; ++i) {
      if (batch.excluded[i] != 0) continue;
      const double x = io::world_coordinate(source, batch, i, 0);
      const double y = io::world_coordinate(source, batch, i, 1);
      const double z = io::world_coordinate(source, batch, i, 2);
      if (!std::isfinite(x) || !std::isfinite(y) || !std::isfinite(z)) continue;
      batch.excluded[i] = z - ground->height_at(x, y) < min_height;
    }
  };
}

}  // namespace arris::pipeline
