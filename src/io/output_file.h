#pragma once
/// @file A file that appears whole or not at all.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string_view>

#include "core/writeback.h"

namespace arris::io {

/// Buffered sequential writer to "<final>.partial-<pid>", renamed by commit(). Every system call is checked; errors
/// become IoError with the path, the bytes written and the system's reason. Destroyed without commit: the partial file
/// is removed. Refuses (ConfigError) an existing final file unless overwrite is set. Not thread-safe.
class OutputFile {
 public:
  OutputFile(std::filesystem::path final_path, bool overwrite);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  void write(std::span<const std::byte> bytes);
  static constexpr std::size_t kMostExtension = std::size_t{1} << 20;
  /// Where the next so many bytes are to be put before anything else is called; at most kMostExtension.
  std::span<std::byte> extend(std::size_t size_bytes);
  void write(std::string_view text);
  /// Overwrites bytes already written (headers whose counts become known at the end). Must lie within size_bytes().
  void patch(std::uint64_t offset, std::span<const std::byte> bytes);
  std::uint64_t size_bytes() const { return size_bytes_; }
  /// Flush, fsync, rename, fsync of the folder.
  void commit();
  const std::filesystem::path& path() const { return final_path_; }
  /// For libraries that write files themselves: the file to fill (it is there, and empty) instead of calling write().
  const std::filesystem::path& partial_path() const { return partial_path_; }

 private:
  void flush();

  std::filesystem::path final_path_;
  std::filesystem::path partial_path_;
  bool overwrite_;
  int descriptor_ = -1;
  std::uint64_t size_bytes_ = 0;
  Writeback writeback_{std::uint64_t{8} << 20, std::uint64_t{256} << 20};
  std::size_t buffered_ = 0;
  std::unique_ptr<std::byte[]> buffer_;
};

}  // namespace arris::io
