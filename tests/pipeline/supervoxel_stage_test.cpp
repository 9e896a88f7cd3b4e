/// @file The stages from points to supervoxels on a small coloured room.

#include "pipeline/supervoxel_stage.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "core/error.h"
#include "pipeline/voxel_labels.h"
#include "pipeline/voxel_stage.h"
#include "silent_sink.h"
#include "support/coloured_scan.h"
#include "support/las_tools.h"
#include "support/temp_folder.h"
#include "tiling/voxel_oracle.h"

namespace arris::pipeline {
namespace {

constexpr std::uint64_t kMuch = std::uint64_t{4} << 30;
using Features = SupervoxelParameters::Features;
using Colour = SupervoxelParameters::Colour;

/// A room as voxels of 15 mm.
class SupervoxelStage : public ::testing::Test {
 protected:
  SupervoxelStage() : points_(test::coloured_room(60, 65535.0)) {
    test::write_coloured_las(folder_ / "room.las", points_);
    parameters_.voxel = 0.015;
    parameters_.seed = 0.12;
    voxelise(folder_ / "room.las", Colour::kAuto);
  }

  void voxelise(const std::filesystem::path& path, Colour colour) {
    io::InputSet inputs({path});
    const tiling::Survey survey = tiling::survey_inputs(inputs, {}, sink_, cancel_);
    scale_ = resolve_scale(parameters_, survey.spacing, survey.lattice);
    voxels_.reset();
    const std::unique_ptr<ColourSource> colours = wanted_colours(inputs, colour, sink_, cancel_);
    voxels_.emplace(run_voxel_stage(inputs, survey, scale_, colours.get(), folder_.path(),
                                    VoxelMemory(std::uint64_t{1} << 30), sink_, cancel_));
  }

  SupervoxelStageResult cluster(Features features, std::uint64_t cap = 0, std::uint64_t memory = kMuch) {
    parameters_.features = features;
    return run_supervoxel_stage(voxels_->store,
                                {{parameters_, scale_, voxels_->colours, memory, cap, 0, folder_.path()}, true}, sink_,
                                cancel_);
  }

  std::vector<LatticePoint> positions() const {
    std::vector<LatticePoint> positions;
    for (const auto& p : points_) positions.push_back({p.position[0], p.position[1], p.position[2]});
    return positions;
  }

  std::vector<Voxel> all_voxels() const {
    std::vector<Voxel> voxels;
    std::vector<std::uint32_t> ranks;
    voxels_->store.load(voxels_->store.index().bounds(), voxels, ranks);
    return voxels;
  }

  test::TempFolder folder_;
  test::SilentSink sink_;
  CancelToken cancel_;
  std::vector<test::ColouredPoint> points_;
  SupervoxelParameters parameters_;
  SupervoxelScale scale_;
  std::optional<VoxelStageResult> voxels_;
};

TEST_F(SupervoxelStage, VoxelStage_GivesTheVoxelsOfTheDefinitionWithColours) {
  std::vector<RawColour> colours;
  for (const auto& p : points_)
    colours.push_back({static_cast<std::uint16_t>(p.colour[0]), static_cast<std::uint16_t>(p.colour[1]),
                       static_cast<std::uint16_t>(p.colour[2])});
  EXPECT_TRUE(voxels_->colours);
  EXPECT_EQ(all_voxels(), test::voxels_of(15, positions(), colours));
  voxelise(folder_ / "room.las", Colour::kOff);
  EXPECT_FALSE(voxels_->colours);
  EXPECT_EQ(all_voxels(), test::voxels_of(15, positions(), {}));
}

TEST_F(SupervoxelStage, ColourDemandedWhereThereIsNone_IsAConfigError) {
  test::write_las(folder_ / "plain.las", {{0, 0, 0}, {100, 0, 0}});
  EXPECT_THROW(voxelise(folder_ / "plain.las", Colour::kOn), ConfigError);
  EXPECT_NO_THROW(voxelise(folder_ / "plain.las", Colour::kAuto));
}

TEST_F(SupervoxelStage, Ids_AreDenseInTheOrderOfRanksAndAdjacencyIsThatOfTheVoxels) {
  for (const Features features : {Features::kNormal, Features::kFpfh}) {
    const SupervoxelStageResult result = cluster(features);
    const tiling::VoxelIndex& index = voxels_->store.index();
    const std::vector<Voxel> voxels = all_voxels();
    ASSERT_EQ(result.ids.size(), voxels.size());
    std::uint32_t seen = 0;
    std::set<std::pair<std::uint32_t, std::uint32_t>> adjacent;
    for (std::uint32_t rank = 0; rank < voxels.size(); ++rank) {
      const std::uint32_t id = result.ids[rank];
      ASSERT_GE(id, 1U);
      ASSERT_LE(id, seen + 1);
      seen = std::max(seen, id);
      const LatticePoint& k = voxels[rank].key;
      for (int i = 0; i < 27; ++i) {
        const std::uint32_t other = index.rank({k.x + i / 9 - 1, k.y + i / 3 % 3 - 1, k.z + i % 3 - 1});
        if (other != tiling::VoxelIndex::kNone && result.ids[other] > id) adjacent.insert({id, result.ids[other]});
      }
    }
    EXPECT_EQ(seen, result.count);
    EXPECT_GT(result.count, 60U);
    EXPECT_TRUE(std::equal(adjacent.begin(), adjacent.end(), result.adjacency.begin(), result.adjacency.end()));
  }
}

TEST_F(SupervoxelStage, Supervoxels_AreOfTheSizeAskedForAndLieOnOneFace) {
  const SupervoxelStageResult result = cluster(Features::kNormal);
  VoxelLabels labels(voxels_->store, result);
  std::map<std::uint32_t, std::map<int, int>> faces;  // Id, face: points.
  std::map<std::uint32_t, LatticeBox> boxes;
  const std::int32_t far = 150 + 10 * 20;
  std::size_t clear = 0;
  const std::vector<LatticePoint> all = positions();
  std::vector<std::uint32_t> ids(all.size());
  labels.find(all, ids);
  for (std::size_t i = 0; i < all.size(); ++i) {
    const LatticePoint& p = all[i];
    int face = -1;
    int on = 0;
    for (int axis = 0; axis < 3; ++axis) {
      for (const std::int32_t at : {0, 150, far}) {
        if (std::abs(p[axis] - at) > 2) continue;
        face = 3 * axis + (at > 0) + (at > 150);
        ++on;
      }
    }
    const std::uint32_t id = ids[i];
    ASSERT_NE(id, 0U);
    boxes[id].include(p);
    if (on != 1) continue;
    ++clear;
    ++faces[id][face];
  }
  std::size_t minority = 0;
  for (const auto& [id, of] : faces) {
    int most = 0, sum = 0;
    for (const auto& [face, count] : of) {
      most = std::max(most, count);
      sum += count;
    }
    minority += static_cast<std::size_t>(sum - most);
  }
  EXPECT_LT(static_cast<double>(minority), 0.02 * static_cast<double>(clear)) << "undersegmentation";
  const std::int64_t widest = 2 * (scale_.levels + 3) * scale_.voxel_steps;
  for (const auto& [id, box] : boxes) {
    for (std::size_t axis = 0; axis < 3; ++axis) EXPECT_LE(box.max[axis] - box.min[axis], widest) << id;
  }
  EXPECT_EQ(result.shared.size(), (voxels_->store.size() + 63) / 64);
}

TEST_F(SupervoxelStage, TilesOfAnySize_GiveTheSameSupervoxels) {
  for (const Features features : {Features::kNormal, Features::kFpfh}) {
    const SupervoxelStageResult whole = cluster(features);
    EXPECT_EQ(whole.tiles, 1U);
    for (const std::uint64_t cap : {200U, 1500U}) {
      const SupervoxelStageResult cut = cluster(features, cap);
      EXPECT_GT(cut.tiles, 3U);
      EXPECT_EQ(cut.ids, whole.ids);
      EXPECT_EQ(cut.adjacency, whole.adjacency);
      EXPECT_EQ(cut.shared, whole.shared);
      EXPECT_EQ(cut.groups, whole.groups);
      EXPECT_EQ(cut.coarse, whole.coarse);
    }
  }
}

TEST_F(SupervoxelStage, WeightsOfZero_AreNoSpecialCase) {
  parameters_.normal_weight = parameters_.spatial_weight = parameters_.colour_weight = 0.0;
  const SupervoxelStageResult whole = cluster(Features::kNormal);
  EXPECT_GT(whole.count, 60U) << "every seed keeps a voxel";
  EXPECT_EQ(cluster(Features::kNormal, 300).ids, whole.ids);
}

TEST_F(SupervoxelStage, BudgetThatCannotDo_IsABudgetErrorThatSaysWhatWouldDo) {
  try {
    cluster(Features::kNormal, 0, 100'000);
    FAIL() << "100 kB were enough";
  } catch (const BudgetError& error) {
    EXPECT_NE(std::string(error.what()).find("at least --memory"), std::string::npos) << error.what();
  }
}

TEST_F(SupervoxelStage, Cancelled_StopsBetweenTiles) {
  cancel_.request();
  EXPECT_THROW(cluster(Features::kNormal), Cancelled);
}

TEST_F(SupervoxelStage, SpecksFarApart_AreSupervoxelsOnCoarserVoxels) {
  std::vector<std::array<std::int32_t, 3>> specks;
  for (std::int32_t i = 0; i < 9; ++i) specks.push_back({1000 * i, 0, 0});
  specks.push_back({20, 0, 0});  // In the next voxel of the first.
  test::write_las(folder_ / "specks.las", specks);
  voxelise(folder_ / "specks.las", Colour::kAuto);
  const SupervoxelStageResult result = cluster(Features::kNormal);
  EXPECT_EQ(result.count, 9U);
  EXPECT_EQ(result.coarse, 9U);
  EXPECT_EQ(result.groups, 0U);
  EXPECT_TRUE(result.adjacency.empty());
}

}  // namespace
}  // namespace arris::pipeline
