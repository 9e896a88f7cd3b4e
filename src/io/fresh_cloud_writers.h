#pragma once
/// @file The writers behind create_fresh_cloud_writer().

#include <filesystem>
#include <memory>

#include "io/point_writer.h"

namespace arris::io {

std::unique_ptr<FreshCloudWriter> create_fresh_las_writer(const std::filesystem::path& path, const FreshCloud& cloud,
                                                          const OutputOptions& options);
std::unique_ptr<FreshCloudWriter> create_fresh_ply_writer(const std::filesystem::path& path, const FreshCloud& cloud,
                                                          const OutputOptions& options);

}  // namespace arris::io
