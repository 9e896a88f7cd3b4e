#pragma once
/// @file A checked POSIX file descriptor for temporary files.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>

namespace arris {

/// Owns a descriptor. Every failing system call becomes an IoError that names the path and the reason; interrupted and
/// short calls are continued. Not thread-safe, except that different objects are independent.
class FileDescriptor {
 public:
  /// @param flags  as open(2); O_CLOEXEC is added, new files get mode 0600.
  static FileDescriptor open(const std::filesystem::path& path, int flags);
  FileDescriptor(FileDescriptor&& other) noexcept;
  FileDescriptor(const FileDescriptor&) = delete;
  FileDescriptor& operator=(const FileDescriptor&) = delete;
  FileDescriptor& operator=(FileDescriptor&&) = delete;
  ~FileDescriptor();

  void write_all(std::span<const std::byte> bytes) const;
  /// Reads until `bytes` is full or the file ends; returns the bytes read.
  std::size_t read_some(std::span<std::byte> bytes) const;
  std::uint64_t size_bytes() const;

 private:
  FileDescriptor(std::filesystem::path path, int descriptor) : path_(std::move(path)), descriptor_(descriptor) {}
  [[noreturn]] void fail(const char* what) const;

  std::filesystem::path path_;
  int descriptor_;
};

}  // namespace arris
