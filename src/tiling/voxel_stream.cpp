#include "tiling/voxel_stream.h"

#include "core/stages.h"

namespace arris::tiling {
namespace {

/// Than the table has lanes.
constexpr std::size_t kMoreBatches = 4;

}  // namespace

VoxelStream::VoxelStream(VoxelTable& table, const std::function<bool(VoxelPoints&)>& fill)
    : table_(table), fill_(fill), batches_(table.lanes() + kMoreBatches) {
  for (Batch& batch : batches_) table.deal({}, batch.dealt);
}

void VoxelStream::add(Batch& batch, std::size_t lane) {
  if (!table_.add_to_lane(lane, batch.points.positions, batch.points.colours, batch.dealt)) full_ = true;
}

/// Of batches that lanes did not come to the end of. False: the table is full again.
bool VoxelStream::add_rest() {
  full_ = false;
  for (Batch& batch : batches_) {
    for (std::size_t lane = 0; lane < table_.lanes(); ++lane) add(batch, lane);
  }
  return !full_;
}

bool VoxelStream::run() {
  if (!add_rest()) return false;
  if (ended_) return true;
  std::vector<Stage> stages{{StageOrder::kAnyOrder, [this](std::size_t place) {
                               table_.deal(batches_[place].points.positions, batches_[place].dealt);
                             }}};
  for (std::size_t lane = 0; lane < table_.lanes(); ++lane) {
    stages.push_back({StageOrder::kInTurn, [this, lane](std::size_t place) {
                        if (!full_) add(batches_[place], lane);
                      }});
  }
  const auto fill = [this](std::size_t place) {
    if (full_) return false;
    Batch& batch = batches_[place];
    batch.points.positions.clear();
    batch.points.colours.clear();
    ended_ = !fill_(batch.points);
    if (ended_) table_.deal({}, batch.dealt);  // There is nothing left of what was here before.
    return !ended_;
  };
  run_stages(batches_.size(), fill, stages);
  return !full_;
}

}  // namespace arris::tiling
