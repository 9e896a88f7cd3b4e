#pragma once
/// @file What several tests of the readers and writers need.

#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/error.h"
#include "io/point_source.h"
#include "io/point_writer.h"
#include "support/las_tools.h"
#include "support/temp_folder.h"

namespace arris::test {

/// Writes a file anew. (Rewriting one in place makes some file systems wait for the disk, thousands of times in these
/// tests.)
inline void write_new(const std::filesystem::path& path, const std::string& bytes) {
  std::filesystem::remove(path);
  write_bytes(path, bytes);
}

/// All points of a file, read in small batches.
struct AllPoints {
  std::vector<std::array<std::int32_t, 3>> stored{};
  std::vector<std::array<double, 3>> world{};
  std::vector<std::string> records{};
};

inline AllPoints read_all(io::PointSource& source, bool records = true, std::size_t batch_points = 3) {
  AllPoints all;
  io::PointBatch batch;
  io::ReadOptions options;
  options.records = records;
  options.batch_points = batch_points;
  std::uint64_t expected_id = 0;
  while (source.read(batch, options)) {
    EXPECT_EQ(batch.first_id, expected_id);
    EXPECT_GT(batch.count, 0U);
    EXPECT_LE(batch.count, batch_points);
    expected_id += batch.count;
    for (std::size_t i = 0; i < batch.count; ++i) {
      if (source.info().scaled_integers) all.stored.push_back({batch.ix[i], batch.iy[i], batch.iz[i]});
      if (!source.info().scaled_integers) all.world.push_back({batch.x[i], batch.y[i], batch.z[i]});
      if (!records) continue;
      const auto* begin = reinterpret_cast<const char*>(batch.records.data());
      all.records.emplace_back(begin + batch.record_begin[i], begin + batch.record_begin[i + 1]);
    }
  }
  EXPECT_EQ(batch.count, 0U);
  EXPECT_EQ(expected_id, source.info().points);
  return all;
}

inline AllPoints read_all(const std::filesystem::path& path, bool records = true, std::size_t batch_points = 3) {
  return read_all(*io::open_point_source(path), records, batch_points);
}

/// The message of the expected error; fails the test if nothing or something else is thrown.
template <typename ExpectedError>
std::string message_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const ExpectedError& error) {
    const std::string text = error.what();
    EXPECT_EQ(text.find('\n'), std::string::npos);
    EXPECT_FALSE(text.empty());
    return text;
  } catch (const std::exception& error) {
    ADD_FAILURE() << "another error: " << error.what();
    return {};
  }
  ADD_FAILURE() << "no error";
  return {};
}

#define EXPECT_HAS(text, part) EXPECT_NE(std::string(text).find(part), std::string::npos) << (text)

/// A column of ours and its value for a point.
inline const std::vector<ColumnSpec> kIdColumn{{"Id", ColumnType::kUint32, "number"}};
inline std::string id_row(std::uint64_t id) {
  const auto value = static_cast<std::uint32_t>(id + 1000);
  return {reinterpret_cast<const char*>(&value), sizeof value};
}

/// Writes the chosen points (by global id) of inputs with one row of `columns` each, and returns the warnings.
inline std::vector<std::string> write_kept(const std::filesystem::path& output,
                                           const std::vector<std::filesystem::path>& inputs,
                                           const std::vector<ColumnSpec>& columns,
                                           const std::function<bool(std::uint64_t)>& keep,
                                           const std::function<std::string(std::uint64_t)>& row,
                                           std::size_t batch_points = 4) {
  io::InputSet set(inputs);
  const auto writer = io::create_kept_point_writer(output, set, columns, {});
  io::PointBatch batch;
  io::ReadOptions options;
  options.records = true;
  options.batch_points = batch_points;
  while (set.read(batch, options)) {
    std::vector<std::uint32_t> kept;
    std::string rows;
    for (std::size_t i = 0; i < batch.count; ++i) {
      if (!keep(batch.first_id + i)) continue;
      kept.push_back(static_cast<std::uint32_t>(i));
      rows += row(batch.first_id + i);
    }
    writer->append(set.source_index(), batch, kept, std::as_bytes(std::span(rows)));
  }
  EXPECT_FALSE(std::filesystem::exists(output));
  writer->commit();
  return writer->warnings();
}

}  // namespace arris::test
