#include "pipeline/intensity_stage.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "silent_sink.h"
#include "support/las_tools.h"
#include "support/temp_folder.h"

namespace arris::pipeline {
namespace {

using Bytes = std::vector<std::uint8_t>;
using Paths = std::vector<std::filesystem::path>;

class IntensityStage : public ::testing::Test {
 protected:
  std::filesystem::path las(const char* name, const std::vector<std::uint16_t>& intensities) {
    const std::filesystem::path path = folder_ / name;
    test::write_las(path, std::vector<std::array<std::int32_t, 3>>(intensities.size()));
    std::string bytes = test::file_bytes(path);
    const test::LasView view = test::view_las(path);
    for (std::size_t i = 0; i < intensities.size(); ++i)
      std::memcpy(bytes.data() + view.offset_to_points + i * view.record_bytes + 12, &intensities[i], 2);
    test::write_bytes(path, bytes);
    return path;
  }
  /// Ascii, or binary if `type` is "float" and `binary`. An empty property: none.
  std::filesystem::path ply(const char* name, const std::string& property, const std::vector<float>& intensities,
                            bool binary = false) {
    std::string text = "ply\nformat " + std::string(binary ? "binary_little_endian" : "ascii") +
                       " 1.0\nelement vertex " + std::to_string(intensities.size()) +
                       "\nproperty float x\nproperty float y\nproperty float z\n";
    if (!property.empty()) text += "property float " + property + "\n";
    text += "end_header\n";
    for (const float value : intensities) {
      if (binary) {
        const std::array<float, 4> row{1.0F, 2.0F, 3.0F, value};
        text.append(reinterpret_cast<const char*>(row.data()), property.empty() ? 12 : 16);
      } else {
        text += "1 2 3 " + (property.empty() ? "" : std::to_string(value)) + "\n";
      }
    }
    test::write_bytes(folder_ / name, text);
    return folder_ / name;
  }
  static IntensityTable read(const Paths& paths) {
    io::InputSet inputs(paths);
    // Points that take no part count all the same.
    inputs.add_filter([](std::size_t, io::PointBatch& batch) { batch.excluded.assign(batch.count, 1); });
    test::SilentSink sink;
    const CancelToken cancel;
    return read_intensities(inputs, sink, cancel);
  }
  test::TempFolder folder_;
};

TEST_F(IntensityStage, EightBits_AreTakenAsTheyAre) {
  const IntensityTable table = read({las("a.las", {0, 7, 255}), las("b.las", {}), las("c.las", {9})});
  EXPECT_EQ(table.of_point, (Bytes{0, 7, 255, 9}));
  ASSERT_EQ(table.files.size(), 3U);
  for (const IntensityRange& file : table.files) EXPECT_TRUE(file.has && !file.scale.scaled);
}

TEST_F(IntensityStage, SixteenBits_AreScaledByPercentiles) {
  std::vector<std::uint16_t> values;
  for (int i = 0; i <= 1000; ++i) values.push_back(static_cast<std::uint16_t>(60 * i));
  const IntensityTable table = read({las("a.las", values)});
  EXPECT_TRUE(table.files[0].scale.scaled);
  EXPECT_EQ(table.files[0].scale.low, 600.0);
  EXPECT_EQ(table.files[0].scale.high, 59400.0);
  ASSERT_EQ(table.of_point.size(), values.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double exact = std::clamp(255.0 * (60.0 * static_cast<double>(i) - 600.0) / 58800.0, 0.0, 255.0);
    EXPECT_NEAR(table.of_point[i], exact, 0.5001) << i;
  }
}

TEST_F(IntensityStage, AnySplitIntoFiles_GivesTheSameBytes) {
  const std::vector<std::uint16_t> values{3, 200, 255, 60000, 1, 2, 900, 300};
  const IntensityTable whole = read({las("whole.las", values)});
  Paths parts;
  for (std::size_t i = 0; i < values.size(); ++i)
    parts.push_back(las(("p" + std::to_string(i) + ".las").c_str(), {values[i]}));
  EXPECT_EQ(read(parts).of_point, whole.of_point);
}

TEST_F(IntensityStage, LasAndPly_AreJudgedEachByItsOwnRange) {
  const IntensityTable table = read({las("a.las", {0, 50000}), ply("b.ply", "intensity", {10, 20}), las("c.las", {100}),
                                     ply("d.ply", "scalar_Intensity", {30}, true)});
  EXPECT_EQ(table.of_point, (Bytes{0, 255, 10, 20, 1, 30}));
  EXPECT_TRUE(table.files[0].scale.scaled && table.files[2].scale.scaled);
  EXPECT_FALSE(table.files[1].scale.scaled || table.files[3].scale.scaled);
}

TEST_F(IntensityStage, PlyFloats_AreScaledUnderEveryName) {
  for (const char* name : {"intensity", "scalar_Intensity", "Intensity", "scalar_intensity", "reflectance"}) {
    for (const bool binary : {false, true}) {
      const IntensityTable table = read({ply("a.ply", name, {0.0F, 0.25F, 0.5F, 1.0F}, binary)});
      EXPECT_EQ(table.of_point, (Bytes{0, 64, 128, 255})) << name << binary;
    }
  }
  const float nan = std::nanf("");
  EXPECT_EQ(read({ply("a.ply", "intensity", {-20.0F, nan, -10.0F, -15.0F})}).of_point, (Bytes{0, 0, 255, 128}));
}

TEST_F(IntensityStage, OneValueOnly_Becomes0IfItIsNo8Bits) {
  EXPECT_EQ(read({las("a.las", {4000, 4000})}).of_point, (Bytes{0, 0}));
  EXPECT_EQ(read({las("a.las", {40, 40})}).of_point, (Bytes{40, 40}));
}

TEST_F(IntensityStage, InputWithoutIntensity_LeavesTheTableEmptyAndIsMarked) {
  const IntensityTable table = read({las("a.las", {1, 2}), ply("b.ply", "", {1})});
  EXPECT_FALSE(table.complete());
  ASSERT_EQ(table.files.size(), 2U);
  EXPECT_TRUE(table.files[0].has);
  EXPECT_FALSE(table.files[1].has);
  EXPECT_TRUE(read({las("a.las", {1, 2}), ply("b.ply", "", {})}).complete()) << "no points, nothing is missing";
}

}  // namespace
}  // namespace arris::pipeline
