/// @file What users of `arris segment` rely on: every point labelled, records kept, planes told apart, clear errors.

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "corpus/strip.h"
#include "io/ply_view.h"
#include "supervoxel_runs.h"
#include "support/coloured_scan.h"
#include "support/temp_folder.h"
#include "tiling_matrix.h"

namespace arris::test {
namespace {

std::size_t entries(const std::filesystem::path& folder) {
  return static_cast<std::size_t>(
      std::distance(std::filesystem::directory_iterator(folder), std::filesystem::directory_iterator()));
}

void segment(const std::filesystem::path& input, const std::filesystem::path& output,
             const std::vector<std::string>& options = {}) {
  std::vector<std::string> arguments{"segment", input, "-o", output, "--overwrite", "-q"};
  arguments.insert(arguments.end(), options.begin(), options.end());
  const ProcessResult run = run_arris(arguments);
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(run.err, "");
}

/// Points of each label.
std::map<std::uint32_t, std::size_t> counts_of(const std::vector<std::uint32_t>& labels) {
  std::map<std::uint32_t, std::size_t> counts;
  for (const std::uint32_t label : labels) ++counts[label];
  return counts;
}

/// A floor and a wall, each n x n points 10 steps apart, and spray above that lies in no plane.
std::vector<std::array<std::int32_t, 3>> room_corner(int n, int spray) {
  std::vector<std::array<std::int32_t, 3>> points;
  std::uint64_t random = 9;
  const auto draw = [&random](std::uint64_t below) {
    random = random * 6364136223846793005U + 1442695040888963407U;
    return static_cast<std::int32_t>((random >> 33) % below);
  };
  for (std::int32_t i = 0; i < n; ++i) {
    for (std::int32_t j = 0; j < n; ++j) {
      points.push_back({i * 10, j * 10, draw(2)});
      points.push_back({draw(2), j * 10, 10 + i * 10});
    }
  }
  for (int i = 0; i < spray; ++i) points.push_back({500 + draw(3000), draw(3000), 500 + draw(3000)});
  return points;
}

TEST(Segment, FloorAndWall_AreTwoSegmentsAndSprayIsNone) {
  const TempFolder folder;
  write_las(folder / "in.las", room_corner(40, 400));
  for (const char* published : {"", "--as-published"}) {
    std::vector<std::string> options{"--report", folder / "report.json", "--temp-dir", folder.path()};
    if (*published) options.emplace_back(published);
    segment(folder / "in.las", folder / "out.las", options);
    const std::vector<std::uint32_t> labels = labels_of(view_las(folder / "out.las"));
    const auto counts = counts_of(labels);
    ASSERT_EQ(counts.size(), 3U) << published;
    EXPECT_EQ(counts.at(0), 400U);
    EXPECT_NEAR(static_cast<double>(counts.at(1)), 1600.0, 41.0);
    EXPECT_EQ(counts.at(1) + counts.at(2), 3200U);
    EXPECT_EQ(labels[0], 1U);  // The first point is on the floor: numbers go by the smallest id.
    const auto report = nlohmann::json::parse(file_bytes(folder / "report.json"));
    EXPECT_EQ(report["segments"], 2);
    EXPECT_EQ(report["points"]["labelled"], 3200);
    EXPECT_EQ(report["points"]["out"], 3600);
    EXPECT_EQ(report["parameters"]["as_published"], *published != '\0');
    EXPECT_LE(report["memory"]["measured_peak_bytes"].get<std::uint64_t>(),
              report["memory"]["budget_bytes"].get<std::uint64_t>());
    EXPECT_EQ(entries(folder.path()), 3U) << "temporary files stayed behind";
  }
}

TEST(Segment, WithoutOurColumnTheOutputIsTheInput) {
  const TempFolder folder;
  const std::vector<AddedColumn> column{{"SegmentId", 4}};
  write_coloured_las(folder / "in.las", coloured_room(40, 65535));
  segment(folder / "in.las", folder / "out.las");
  EXPECT_EQ(differing_fields(strip_las(file_bytes(folder / "out.las"), column), file_bytes(folder / "in.las")),
            std::set<std::string>{});
  expect_dense(labels_of(view_las(folder / "out.las")), counts_of(labels_of(view_las(folder / "out.las")))[0]);
  write_coloured_ply(folder / "in.ply", coloured_room(40, 255), "uchar");
  segment(folder / "in.ply", folder / "out.ply", {"--no-intensity"});
  const PlyParts input = split_ply(file_bytes(folder / "in.ply"));
  const PlyParts stripped = strip_ply(file_bytes(folder / "out.ply"), column);
  EXPECT_EQ(stripped.header, input.header);
  EXPECT_TRUE(stripped.body == input.body);
  EXPECT_EQ(view_ply(file_bytes(folder / "out.ply")).types.at("SegmentId"), "uint");
}

TEST(Segment, NoPointsOrOneOrAllInOnePlace_AreNoSegment) {
  const TempFolder folder;
  for (const std::size_t count : {std::size_t{0}, std::size_t{1}, std::size_t{100}}) {
    write_las(folder / "in.las", std::vector<std::array<std::int32_t, 3>>(count, {5, 6, 7}));
    segment(folder / "in.las", folder / "out.las");
    EXPECT_EQ(labels_of(view_las(folder / "out.las")), std::vector<std::uint32_t>(count, 0)) << count;
  }
}

// Noise of a fifth of the spacing and more, at which 8 neighbours make no plane.
TEST(Segment, NoisyGable_IsTwoSegmentsByItself) {
  const TempFolder folder;
  for (const char* noise : {"5mm", "2cm", "3cm"}) {
    synth_scan(folder / "gable.las", {"gable", "--spacing", "0.1", "--noise", noise, "--sampling", "random"});
    segment(folder / "gable.las", folder / "out.las", {"--report", folder / "report.json"});
    const auto counts = counts_of(labels_of(view_las(folder / "out.las")));
    EXPECT_EQ(counts.size() - counts.count(0), 2U) << noise;
    const auto report = nlohmann::json::parse(file_bytes(folder / "report.json"));
    EXPECT_EQ(report["parameters"]["neighbours"], 8);
    EXPECT_EQ(report["parameters"]["most_neighbours"] == 8, std::string(noise) == "5mm") << noise;
  }
}

TEST(Segment, PlyWithoutIntensities_WarnsAndGoesByShape) {
  const TempFolder folder;
  write_coloured_ply(folder / "in.ply", coloured_room(30, 255), "uchar");
  const ProcessResult run = run_arris({"segment", folder / "in.ply", "-o", folder / "out.ply"});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_NE(run.err.find("no-intensity"), std::string::npos) << run.err;
}

/// Points of a class, in point format 6, that have a segment; and all of that class.
std::pair<std::size_t, std::size_t> labelled_of_class(const LasView& view, unsigned char wanted) {
  constexpr std::size_t kClassByte = 16;
  const std::vector<std::uint32_t> labels = labels_of(view);
  std::pair<std::size_t, std::size_t> counts;
  for (std::uint64_t i = 0; i < view.points; ++i) {
    if (static_cast<unsigned char>(view.record(i)[kClassByte]) != wanted) continue;
    counts.first += labels[i] != 0;
    ++counts.second;
  }
  return counts;
}

TEST(Segment, MinHeight_LeavesTheGroundOut) {
  const TempFolder folder;
  synth_scan(folder / "roofs.las", {"roofs", "--spacing", "0.5", "--set", "ground=1"});
  segment(folder / "roofs.las", folder / "all.las");
  segment(folder / "roofs.las", folder / "high.las", {"--min-height", "1.5m"});
  const LasView all = view_las(folder / "all.las"), high = view_las(folder / "high.las");
  const auto [ground_labelled, ground] = labelled_of_class(all, 2);
  ASSERT_GT(ground, 10000U);
  EXPECT_GT(ground_labelled, ground * 9 / 10);
  EXPECT_EQ(labelled_of_class(high, 2).first, 0U);
  const auto [roof_labelled, roof] = labelled_of_class(high, 6);
  ASSERT_GT(roof, 1000U);
  EXPECT_GT(roof_labelled, roof * 9 / 10);
}

TEST(SegmentErrors, MinHeightWithoutGroundPoints_IsRefused) {
  const TempFolder folder;
  write_las(folder / "plain.las", noisy_plate(30, 10));
  const ProcessResult run =
      run_arris({"segment", folder / "plain.las", "-o", folder / "out.las", "--min-height", "1.5m"});
  EXPECT_EQ(run.exit_code, 1) << run.err;
  EXPECT_NE(run.err.find("class 2"), std::string::npos) << run.err;
  EXPECT_FALSE(std::filesystem::exists(folder / "out.las"));
}

struct Wrong {
  std::vector<std::string> options;
  std::string named;  ///< In the error line.
};

TEST(SegmentErrors, WrongOptions_ExitWith2AndOneLineThatNamesThem) {
  const TempFolder folder;
  write_las(folder / "in.las", noisy_plate(30, 10));
  const std::string out = folder / "out.las";
  for (const Wrong& wrong :
       {Wrong{{}, "--output"}, Wrong{{"-o", folder / "out.xyz"}, "out.xyz"},
        Wrong{{"-o", folder / "in.las", "--overwrite"}, "in.las"}, Wrong{{"-o", out, "-k", "2"}, "--neighbours"},
        Wrong{{"-o", out, "-k", "65"}, "--neighbours"}, Wrong{{"-o", out, "--angle", "0"}, "--angle"},
        Wrong{{"-o", out, "--angle", "nan"}, "--angle"}, Wrong{{"-o", out, "--radius", "5 parsec"}, "5 parsec"},
        Wrong{{"-o", out, "--min-points", "0"}, "--min-points"}, Wrong{{"-o", out, "--sweeps", "11"}, "--sweeps"},
        Wrong{{"-o", out, "--agreement", "2"}, "--agreement"}, Wrong{{"-o", out, "--curvature", "0"}, "--curvature"},
        Wrong{{"-o", out, "--intensity-step", "0"}, "--intensity-step"}}) {
    std::vector<std::string> arguments{"segment", folder / "in.las", "--temp-dir", folder.path()};
    arguments.insert(arguments.end(), wrong.options.begin(), wrong.options.end());
    const ProcessResult run = run_arris(arguments);
    EXPECT_EQ(run.exit_code, 2) << wrong.named << ": " << run.err;
    EXPECT_NE(run.err.find(wrong.named), std::string::npos) << wrong.named << ": " << run.err;
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
    EXPECT_EQ(run.out, "");
    EXPECT_EQ(entries(folder.path()), 1U) << wrong.named << ": something was left behind";
  }
}

TEST(SegmentErrors, TooLittleMemory_ExitsWith3AndSaysWhatWouldDo) {
  const TempFolder folder;
  write_las(folder / "in.las", noisy_plate(30, 10));
  const ProcessResult run = run_arris({"segment", folder / "in.las", "-o", folder / "out.las", "--memory", "20MiB"});
  EXPECT_EQ(run.exit_code, 3) << run.err;
  EXPECT_NE(run.err.find("at least"), std::string::npos) << run.err;
  EXPECT_FALSE(std::filesystem::exists(folder / "out.las"));
}

}  // namespace
}  // namespace arris::test
