#include "support/shared_data.h"

#include <cmath>
#include <set>

#include "io/file_summary.h"
#include "io_helpers.h"
#include "las_builder.h"

namespace arris::test {
namespace {

struct Scan {
  const char* path;
  std::uint64_t points;
  std::array<double, 3> extent;  ///< As indexed, rounded to about four digits.
};

/// Real scans of many writers, with the counts and extents an independent program found.
constexpr std::array kScans{
    Scan{"IGNF+ctview/data/las/test_data_0000_0000_LA93_IGN69_ground.las", 21172, {50, 50, 1.17}},
    Scan{"IGNF+ctview/data/las/test_data_class_6.las", 234, {4.68, 2.73, 3.27}},
    Scan{"IGNF+ctview/data/las/test_data_empty.las", 0, {0, 0, 0}},
    Scan{"IGNF+lidar-prod/tests/files/870000_6618000.subset.postValidation.las", 70840, {99.98, 61.87, 15.23}},
    Scan{"LASzip+LASzip/example/5points_14.las", 5, {1.39, 0.93, 1.53}},
    Scan{"PDAL+PDAL/test/data/autzen/autzen-dd.las", 1065, {0.01247, 0.01249, 54.8}},
    Scan{"PDAL+PDAL/test/data/autzen/autzen-thin.las", 10653, {3406, 4649, 187.1}},
    Scan{"PDAL+PDAL/test/data/las/bad_vlr_count.las", 10, {4.35, 1.98, 0.18}},
    Scan{"PDAL+PDAL/test/data/las/bad-geotiff-keys.las", 10, {4.35, 1.98, 0.18}},
    Scan{"PDAL+PDAL/test/data/las/lots_of_vlr.las", 1, {0, 0, 0}},
    Scan{"PDAL+PDAL/test/data/las/mvk-thin.las", 6280, {4992, 4999, 132.9}},
    Scan{"PDAL+PDAL/test/data/las/permutations/1.0_1.las", 1, {0, 0, 0}},
    Scan{"PDAL+PDAL/test/data/las/wontcompress3.las", 1000, {55.88, 33.54, 8.05}},
    Scan{"daavoo+pyntcloud/tests/data/has_offsets.las", 20, {94.53, 124.5, 27.4}},
    Scan{"hobuinc+laz-perf/cpp/test/raw-sets/rand1_6.las", 50000, {4.295e9, 4.295e9, 4.295e9}},
    Scan{"laspy+laspy/tests/data/1_4_w_evlr.las", 1000, {501.2, 5.27, 6.32}},
    Scan{"laspy+laspy/tests/data/extrabytes.las", 1065, {3363, 4636, 179.8}},
    Scan{"laspy+laspy/tests/data/simple1_3.las", 999, {498.7, 103.1, 8.717}},
    Scan{"pnext+samples/data/RandomSample/las/v4d7.las", 10, {848.8, 711.7, 940.1}},
    Scan{"visgl+loaders.gl/modules/las/test/data/indoor.las", 808042, {28.62, 9.52, 20.26}},
    Scan{"visgl+loaders.gl/modules/las/test/data/pdrf10-1.4.las", 1024, {4.289e9, 4.287e9, 4.294e9}},
    Scan{"visgl+loaders.gl/modules/las/test/data/pdrf4-1.3.las", 1024, {173.9, 112.5, 22.08}},
    Scan{"Fluci+ply-rs/example_plys/house_ok_ascii.ply", 5, {2, 3, 0}},
    Scan{"Fluci+ply-rs/example_plys/house_2_ok_little_endian.ply", 5, {2, 3, 0}},
    Scan{"Fluci+ply-rs/example_plys/empty_2_ok_ascii.ply", 0, {0, 0, 0}},
    Scan{"LukasKalbertodt+lox/old_code/src/io/ply/test_files/triangle_with_extra_props_bbe.ply", 3, {3, 153, 8}},
    Scan{"LukasKalbertodt+lox/old_code/src/io/ply/test_files/triangle_with_extra_props_ascii.ply", 3, {3, 153, 8}},
    Scan{"LukasKalbertodt+lox/old_code/src/io/ply/test_files/unusual_order_ble.ply", 4, {3, 3, 3}},
    Scan{"LukasKalbertodt+lox/old_code/tests/files/ply/sphere_bbe.ply", 386, {19.91, 19.91, 20}},
    Scan{"STORM-IRIT+pcednet-supp/scripts/3dmodels/default/GT/TwoPlane90.ply", 6002, {1, 0.9995, 1}},
    Scan{"assimp+assimp/test/models/PLY/cube_binary_header_with_RN_newline.ply", 8, {1, 1, 1}},
    Scan{"assimp+assimp/test/models/PLY/Wuson.ply", 11184, {0.92, 1.516, 3.244}},
    Scan{"daavoo+pyntcloud/tests/data/voxelgrid.ply", 6, {1, 1, 1}},
    Scan{"ddiakopoulos+tinyply/assets/sofa.ply", 12103, {2076, 877.9, 982.2}},
    Scan{"denabazazian+Edge_Extraction/ArtificialPointClouds/Wedge.ply", 3500, {0.9994, 0.4949, 0.9999}},
    Scan{"google+draco/testdata/int_point_cloud.ply", 16, {388, 268, 7}},
    Scan{"nmwsharp+happly/test/sampledata/platonic_shelf.ply", 50, {13.49, 2.316, 2.316}},
    Scan{"nmwsharp+happly/test/sampledata/platonic_shelf_ascii.ply", 50, {13.49, 2.316, 2.316}},
    Scan{"nmwsharp+happly/test/sampledata/platonic_shelf_big_endian.ply", 50, {13.49, 2.316, 2.316}},
    Scan{"visgl+loaders.gl/cpp/Model3DTiler/test/resources/ripple_bin.ply", 10201, {10, 10, 1.766}},
};

class RealScan : public ::testing::TestWithParam<Scan> {};

TEST_P(RealScan, CountAndExtent_AreAsIndexed) {
  ARRIS_SHARED_DATA_OR_SKIP(path, GetParam().path);
  const auto source = io::open_point_source(path);
  const io::SourceInfo& info = source->info();
  io::WorldExtent extent;
  io::PointBatch batch;
  std::uint64_t points = 0;
  while (source->read(batch, {})) {
    points += batch.count;
    const std::array stored{&batch.ix, &batch.iy, &batch.iz};
    const std::array world{&batch.x, &batch.y, &batch.z};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (std::size_t i = 0; i < batch.count; ++i) {
        const double value =
            info.scaled_integers ? (*stored[axis])[i] * info.scale[axis] + info.offset[axis] : (*world[axis])[i];
        extent.min[axis] = std::min(extent.min[axis], value);
        extent.max[axis] = std::max(extent.max[axis], value);
      }
    }
  }
  EXPECT_EQ(points, GetParam().points);
  for (std::size_t axis = 0; axis < 3 && points > 0; ++axis) {
    EXPECT_NEAR(extent.max[axis] - extent.min[axis], GetParam().extent[axis], 6e-4 * GetParam().extent[axis] + 1e-9);
  }
}

TEST_P(RealScan, KeptRecords_EqualTheInputsBytes) {
  ARRIS_SHARED_DATA_OR_SKIP(path, GetParam().path);
  const bool las = path.extension() == ".las";
  const TempFolder folder;
  const std::filesystem::path out = folder / (las ? "out.las" : "out.ply");
  const auto row = [](std::uint64_t id) { return std::string(1, static_cast<char>('!' + id % 90)); };
  write_kept(
      out, {path}, {{"Ours", ColumnType::kUint8, ""}}, [](std::uint64_t id) { return id % 3 == 0; }, row, 50000);
  const AllPoints in = read_all(path, true, 50000);
  const AllPoints kept = read_all(out, true, 50000);
  ASSERT_EQ(kept.records.size(), (in.records.size() + 2) / 3);
  for (std::size_t i = 0; i < kept.records.size(); ++i) {
    const std::string& original = in.records[3 * i];
    ASSERT_EQ(kept.records[i].substr(0, original.size()), original);
    ASSERT_GT(kept.records[i].size(), original.size());
  }
  if (!las || !io::open_point_source(path)->info().problems.empty()) return;
  const LasParts before = read_parts(file_bytes(path));
  const LasParts after = read_parts(file_bytes(out));
  EXPECT_EQ(before.gap, after.gap);
  EXPECT_EQ(before.evlrs.size(), after.evlrs.size());
}

INSTANTIATE_TEST_SUITE_P(Shared, RealScan, ::testing::ValuesIn(kScans), [](const auto& scan) {
  std::string name = std::filesystem::path(scan.param.path).filename().string();
  for (char& c : name) {
    if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
  }
  return name;
});

TEST(RealScan, DamagedFiles_AreRefused) {
  ARRIS_SHARED_DATA_OR_SKIP(truncated, "PDAL+PDAL/test/data/las/garbage_nVariableLength.las");
  EXPECT_HAS(message_of<InputError>([&] { io::open_point_source(truncated); }), "holds 718 whole points");
  ARRIS_SHARED_DATA_OR_SKIP(compressed, "visgl+loaders.gl/modules/las/test/data/indoor.laz");
  EXPECT_HAS(message_of<InputError>([&] { io::open_point_source(compressed); }), "LAZ");
  ARRIS_SHARED_DATA_OR_SKIP(no_lists, "assimp+assimp/test/models/PLY/issue623.ply");
  EXPECT_HAS(message_of<InputError>([&] { read_all(no_lists); }), "vertex 1 of 24");
  ARRIS_SHARED_DATA_OR_SKIP(no_vertices, "Fluci+ply-rs/example_plys/leading_spaces_ok_ascii.ply");
  EXPECT_HAS(message_of<InputError>([&] { io::open_point_source(no_vertices); }), "no element \"vertex\"");
}

TEST(RealScan, Crs_IsFound) {
  ARRIS_SHARED_DATA_OR_SKIP(wkt, "laspy+laspy/tests/data/1_4_w_evlr.las");
  EXPECT_FALSE(io::summarize_file(wkt).crs.name.empty());
  ARRIS_SHARED_DATA_OR_SKIP(keys, "IGNF+ctview/data/las/test_data_0000_0000_LA93_IGN69_ground.las");
  EXPECT_HAS(io::summarize_file(keys).crs.name, "93");
}

TEST(RealScan, EveryFileThatIsThere_IsReadOrRefused) {
  ARRIS_SHARED_DATA_OR_SKIP(index, "INDEX.md");
  const std::set<std::string> damaged{"1.2-with-color-clipped.las",
                                      "garbage_nVariableLength.las",
                                      "ply_empty_header.ply",
                                      "issue623.ply",
                                      "unsized_dims.ply",
                                      "sized_dims.ply",
                                      "leading_spaces_ok_ascii.ply",
                                      "all_atomic_types_ok_ascii.ply",
                                      "exponent_values_ok_ascii.ply"};
  std::size_t read = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(index.parent_path())) {
    const std::string extension = entry.path().extension().string();
    if (!entry.is_regular_file() || (extension != ".las" && extension != ".ply" && extension != ".laz")) continue;
    SCOPED_TRACE(entry.path().filename());
    try {
      const auto source = io::open_point_source(entry.path());
      io::summarize_file(entry.path());
      io::PointBatch batch;
      while (source->read(batch, {})) {
      }
      ++read;
    } catch (const InputError& error) {
      EXPECT_TRUE(extension == ".laz" || damaged.contains(entry.path().filename().string())) << error.what();
    }
  }
  EXPECT_GT(read, 100U);
}

}  // namespace
}  // namespace arris::test
