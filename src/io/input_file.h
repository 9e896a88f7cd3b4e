#pragma once
/// @file An input file read by position, and a sliding window over it.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace arris::io {

/// Read-only regular file, or bytes in memory. Its size is taken once, at opening; a file that turns out shorter later
/// was cut short while we read it, which is an InputError. Failing system calls are IoErrors. Reading is const and
/// thread-safe.
class InputFile {
 public:
  explicit InputFile(std::filesystem::path path);
  /// Bytes that are read like a file; messages call them `name`.
  static std::shared_ptr<const InputFile> in_memory(std::string name, std::vector<std::byte> bytes);
  ~InputFile();
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;

  const std::filesystem::path& path() const { return path_; }
  /// The path as messages show it.
  std::string name() const;
  std::uint64_t size_bytes() const { return size_bytes_; }
  /// Time of the last change when the file was opened, nanoseconds since 1970; 0 in memory.
  std::int64_t modified_ns() const { return modified_ns_; }

  /// Reads at `offset` until `bytes` is full or the file ends; returns the bytes read.
  std::size_t read_some(std::uint64_t offset, std::span<std::byte> bytes) const;
  /// Reads all of `bytes` at `offset`, or throws InputError.
  void read(std::uint64_t offset, std::span<std::byte> bytes) const;

 private:
  InputFile(std::string name, std::vector<std::byte> bytes);

  std::filesystem::path path_;
  int descriptor_ = -1;  ///< -1: the bytes are in memory_.
  std::vector<std::byte> memory_;
  std::uint64_t size_bytes_ = 0;
  std::int64_t modified_ns_ = 0;
};

/// Throws the InputError that every reader gives for content it cannot trust: "<file>: byte <byte>: <what>; <remedy>".
/// @param byte  where the fault lies; texts of the file must have passed printable().
[[noreturn]] void refuse(const InputFile& file, std::uint64_t byte, std::string_view what, std::string_view remedy);

/// A window of unread bytes that slides over a file, for records whose length is known only once they have been read.
class FileWindow {
 public:
  /// Longest record that can be held. Real records are smaller by orders of magnitude; this bounds the memory that a
  /// damaged list length can ask for.
  static constexpr std::size_t kMaxBytes = std::size_t{16} << 20;

  explicit FileWindow(const InputFile& file) : file_(file) {}

  void seek(std::uint64_t offset);
  /// Bytes at hand, from position() on.
  std::span<const std::byte> bytes() const { return {buffer_.data() + begin_, end_ - begin_}; }
  /// Reads on, keeping the bytes at hand. False if the file has no more, or the window is full (see full()).
  bool extend();
  bool full() const { return end_ - begin_ >= kMaxBytes; }
  bool at_file_end() const { return position() + (end_ - begin_) >= file_.size_bytes(); }
  void consume(std::size_t count) { begin_ += count; }
  /// Offset in the file of the first byte at hand.
  std::uint64_t position() const { return buffer_offset_ + begin_; }

 private:
  const InputFile& file_;
  std::vector<std::byte> buffer_;
  std::uint64_t buffer_offset_ = 0;  ///< Offset in the file of buffer_[0].
  std::size_t begin_ = 0;
  std::size_t end_ = 0;
};

}  // namespace arris::io
