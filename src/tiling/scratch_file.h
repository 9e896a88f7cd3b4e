#pragma once
/// @file A temporary file whose every system call is checked and that is gone when its owner is.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>

namespace arris::tiling {

/// Made empty, written from front to back, read anywhere, removed on destruction (also while an exception unwinds).
/// Throws IoError (checked_file.h: throw_io_error). Different objects are independent; read_at() is thread-safe.
class ScratchFile {
 public:
  /// Replaces what is at `path`.
  explicit ScratchFile(std::filesystem::path path);
  ~ScratchFile();
  ScratchFile(const ScratchFile&) = delete;
  ScratchFile& operator=(const ScratchFile&) = delete;

  void append(std::span<const std::byte> bytes);
  /// Fills `bytes` or throws.
  void read_at(std::uint64_t offset, std::span<std::byte> bytes) const;
  /// Saves the descriptor while the file waits: close() after append(), reopen() before read_at().
  void close();
  void reopen();

  const std::filesystem::path& path() const { return path_; }
  std::uint64_t size_bytes() const { return size_bytes_; }  ///< As written.
  /// IoError: the file is not what was written.
  [[noreturn]] void throw_damaged() const;

 private:
  std::filesystem::path path_;
  int descriptor_ = -1;
  std::uint64_t size_bytes_ = 0;
};

}  // namespace arris::tiling
