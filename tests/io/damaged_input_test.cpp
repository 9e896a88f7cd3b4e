#include <random>

#include "io/file_summary.h"
#include "io_helpers.h"
#include "las_builder.h"
#include "ply_builder.h"

namespace arris::test {
namespace {

/// Writes one point of each batch, to the end in some rounds only: that waits for the disk.
void copy_points(const std::filesystem::path& path, int round) {
  const TempFolder folder;
  io::InputSet inputs({path});
  const auto output = folder / (round % 2 == 0 ? "out.las" : "out.ply");
  const auto writer = io::create_kept_point_writer(output, inputs, {{"A", ColumnType::kFloat32, ""}}, {});
  io::PointBatch batch;
  io::ReadOptions options;
  options.records = true;
  options.batch_points = 7;
  while (inputs.read(batch, options))
    writer->append(0, batch, std::vector<std::uint32_t>{0}, std::as_bytes(std::span("abcd", 4)));
  if (round % 8 < 2) writer->commit();
  if (round % 8 < 2) read_all(output);
}

/// Whatever the bytes, a file is read or refused; nothing else. (Sanitizers watch these runs.)
void read_or_refuse(const std::filesystem::path& path, int round) {
  try {
    const auto source = io::open_point_source(path);
    io::summarize_file(path);
    io::PointBatch batch;
    io::ReadOptions options;
    options.records = true;
    std::uint64_t points = 0;
    while (source->read(batch, options)) points += batch.count;
    EXPECT_EQ(points, source->info().points);
    EXPECT_LE(points, std::filesystem::file_size(path));
    copy_points(path, round);
  } catch (const Error& error) {
    EXPECT_EQ(std::string(error.what()).find_first_of("\n\x1b"), std::string::npos);
  }
}

void mutate_and_read(const std::string& seed_file, unsigned seed, int rounds) {
  const TempFolder folder;
  std::mt19937 random(seed);
  SCOPED_TRACE(seed);
  for (int round = 0; round < rounds; ++round) {
    std::string bytes = seed_file;
    const unsigned changes = 1 + random() % 4;
    for (unsigned i = 0; i < changes; ++i) {
      const std::size_t at = random() % std::min<std::size_t>(bytes.size(), random() % 2 == 0 ? 500 : bytes.size());
      switch (random() % 5) {
        case 0:
          bytes[at] = static_cast<char>(random());
          break;
        case 1:
          bytes[at] = static_cast<char>(0xff);
          break;
        case 2:
          bytes[at] = 0;
          break;
        case 3:
          bytes.erase(at, 1 + random() % 8);
          break;
        default:
          bytes.insert(at, bytes.substr(random() % bytes.size(), random() % 16));
          break;
      }
    }
    if (random() % 8 == 0) bytes.resize(random() % bytes.size());
    write_new(folder / "m", bytes);
    read_or_refuse(folder / "m", round);
  }
}

TEST(DamagedInput, MutatedLas_IsReadOrRefused) {
  for (const int minor : {2, 4}) {
    LasPlan plan;
    plan.minor = minor;
    plan.format = minor == 4 ? 6 : 3;
    plan.record_bytes = kFormatBytes[static_cast<std::size_t>(plan.format)] + 3;
    plan.points = make_records(20, plan.record_bytes);
    plan.vlrs = {{"LASF_Projection", 34735, std::string(24, '\1')},
                 {"LASF_Spec", 4, extra_entry(1, "a") + extra_entry(3, "b")}};
    if (minor == 4) plan.evlrs = {{"LASF_Projection", 2112, "WKT"}};
    mutate_and_read(build_las(plan), static_cast<unsigned>(minor), 400);
  }
}

TEST(DamagedInput, MutatedPly_IsReadOrRefused) {
  const PlyTable faces{"face", {{"vertex_indices", "int", "uchar"}}, {{{0, 1, 2}}, {{3, 4}}}};
  for (const std::string format : {"ascii", "binary_little_endian", "binary_big_endian"}) {
    for (const bool lists : {false, true}) {
      std::vector<PlyColumn> columns{{"x"}, {"y", "double"}, {"z"}, {"red", "uchar"}};
      if (lists) columns.push_back({"l", "short", "int"});
      mutate_and_read(build_ply({format, "\n", {"comment c"}, {faces, make_vertices(columns, 20)}}), lists ? 7 : 8,
                      150);
    }
  }
}

}  // namespace
}  // namespace arris::test
