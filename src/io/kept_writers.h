#pragma once
/// @file The writers behind create_kept_point_writer(), one per pair of formats, and what they share.

#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "io/input_file.h"
#include "io/output_file.h"
#include "io/point_writer.h"

namespace arris::io {

/// What every kept-point writer is made from. `inputs` is not empty.
struct KeptJob {
  std::filesystem::path path;
  std::vector<SourceInfo> inputs;
  std::vector<ColumnSpec> columns;
  OutputOptions options;
};

std::unique_ptr<KeptPointWriter> create_las_kept_writer(const KeptJob& job);
std::unique_ptr<KeptPointWriter> create_ply_kept_writer(const KeptJob& job);
std::unique_ptr<KeptPointWriter> create_converted_las_writer(const KeptJob& job);
std::unique_ptr<KeptPointWriter> create_converted_ply_writer(const KeptJob& job);

/// Columns whose names are already taken by attributes of the input get "_2", "_3", ... (a result of ours fed to us
/// again); each renaming is added to `warnings`.
std::vector<ColumnSpec> rename_taken_columns(std::vector<ColumnSpec> columns, const std::vector<std::string>& taken,
                                             std::vector<std::string>& warnings);

/// Copies bytes [begin, end) of the input to the output.
void copy_bytes(const InputFile& from, std::uint64_t begin, std::uint64_t end, OutputFile& to);

/// Original record of one point of a batch.
inline std::span<const std::byte> record_of(const PointBatch& batch, std::size_t point) {
  const std::size_t begin = batch.record_begin[point];
  return {batch.records.data() + begin, batch.record_begin[point + 1] - begin};
}

}  // namespace arris::io
