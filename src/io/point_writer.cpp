#include "io/point_writer.h"

#include <fmt/format.h>

#include <algorithm>
#include <system_error>

#include "core/error.h"
#include "core/text.h"
#include "io/fresh_cloud_writers.h"
#include "io/kept_writers.h"
#include "io/las_sharing.h"
#include "io/ply_sharing.h"

namespace arris::io {
namespace {

namespace fs = std::filesystem;

std::string shown(const fs::path& path) {
  return printable(path.string(), 1000);
}

Format format_of(const fs::path& path) {
  std::string extension = path.extension().string();
  for (char& c : extension) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  if (extension == ".las") return Format::kLas;
  if (extension == ".ply") return Format::kPly;
  throw ConfigError(fmt::format("{}: cannot write \"{}\"; the name of a point output must end in .las or .ply",
                                shown(path), printable(extension, 20)));
}

void check_columns(const std::vector<ColumnSpec>& columns) {
  for (const ColumnSpec& column : columns) {
    const bool blank = column.name.find_first_of(" \t\r\n") != std::string::npos;
    if (column.name.empty() || column.name.size() > 32 || blank || column.description.size() > 32) {
      throw ConfigError(
          fmt::format("column \"{}\": names need 1 to 32 characters without blanks, descriptions at most 32",
                      printable(column.name, 40)));
    }
  }
}

}  // namespace

std::unique_ptr<KeptPointWriter> create_kept_point_writer(const fs::path& path, const InputSet& inputs,
                                                          const std::vector<ColumnSpec>& columns,
                                                          const OutputOptions& options) {
  const Format format = format_of(path);
  check_columns(columns);
  const KeptJob job{path, inputs.sources(), columns, options};
  bool all_las = true;
  bool all_ply = true;
  for (const SourceInfo& input : job.inputs) {
    std::error_code ignored;
    if (fs::equivalent(path, input.path, ignored)) {
      throw ConfigError(fmt::format("{}: is an input as well; choose another name for the output", shown(path)));
    }
    all_las = all_las && input.format == Format::kLas;
    all_ply = all_ply && input.format == Format::kPly;
  }
  if (format == Format::kLas) {
    return all_las && las_difference(job.inputs).empty() ? create_las_kept_writer(job)
                                                         : create_converted_las_writer(job);
  }
  return all_ply && ply_difference(job.inputs).empty() ? create_ply_kept_writer(job) : create_converted_ply_writer(job);
}

std::unique_ptr<FreshCloudWriter> create_fresh_cloud_writer(const fs::path& path, const FreshCloud& cloud,
                                                            const OutputOptions& options) {
  const Format format = format_of(path);
  if (!(cloud.scale > 0.0) || cloud.scale > 1e6)
    throw ConfigError(fmt::format("{}: scale {} must be positive", shown(path), cloud.scale));
  if (cloud.label) {
    check_columns({*cloud.label});
    if (cloud.label->type != ColumnType::kUint32)
      throw ConfigError(fmt::format("{}: labels of fresh points are 32-bit", shown(path)));
  }
  return format == Format::kLas ? create_fresh_las_writer(path, cloud, options)
                                : create_fresh_ply_writer(path, cloud, options);
}

std::vector<ColumnSpec> rename_taken_columns(std::vector<ColumnSpec> columns, const std::vector<std::string>& taken,
                                             std::vector<std::string>& warnings) {
  std::vector<std::string> names = taken;
  const auto is_taken = [&](const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
  };
  for (ColumnSpec& column : columns) {
    const std::string wanted = column.name;
    for (int n = 2; is_taken(column.name); ++n) {
      const std::string suffix = fmt::format("_{}", n);
      column.name = wanted.substr(0, 32 - suffix.size()) + suffix;
    }
    names.push_back(column.name);
    if (column.name != wanted) {
      warnings.push_back(
          fmt::format("the input already has an attribute {}; ours is written as {}", wanted, column.name));
    }
  }
  return columns;
}

void copy_bytes(const InputFile& from, std::uint64_t begin, std::uint64_t end, OutputFile& to) {
  constexpr std::uint64_t kBlock = std::uint64_t{1} << 20;
  std::vector<std::byte> block(static_cast<std::size_t>(std::min(kBlock, end - begin)));
  while (begin < end) {
    const auto part =
        std::span(block).first(static_cast<std::size_t>(std::min<std::uint64_t>(block.size(), end - begin)));
    from.read(begin, part);
    to.write(std::span<const std::byte>(part));
    begin += part.size();
  }
}

}  // namespace arris::io
