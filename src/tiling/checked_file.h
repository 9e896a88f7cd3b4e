#pragma once
/// @file Files of the temp folder whose every system call is checked and whose bytes are hashed on their way.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <streambuf>

#include "core/writeback.h"

namespace arris::tiling {

/// IoError: "<path>: <what> failed: <reason>", and for a full disk how much is free and (if not 0) how much more is
/// needed.
[[noreturn]] void throw_io_error(const std::filesystem::path& path, const char* what, int reason,
                                 std::uint64_t needed_bytes = 0);

/// A running XXH3-64.
class Hasher {
 public:
  Hasher();
  ~Hasher();
  Hasher(const Hasher&) = delete;
  Hasher& operator=(const Hasher&) = delete;
  void reset();
  void update(const void* data, std::size_t size_bytes);
  std::uint64_t digest() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Sequential reads of a whole file. Throws IoError. Not thread-safe.
class FileReader {
 public:
  explicit FileReader(std::filesystem::path path);
  ~FileReader();
  FileReader(const FileReader&) = delete;
  FileReader& operator=(const FileReader&) = delete;

  const std::filesystem::path& path() const { return path_; }
  std::uint64_t size_bytes() const { return size_bytes_; }  ///< When it was opened.
  void rewind();
  /// Reads up to buffer.size() bytes; 0 only at the end of the file.
  std::size_t read(std::span<std::byte> buffer);
  /// Fills the buffer or throws.
  void read_exactly(std::span<std::byte> buffer);
  /// The same from a place of its own; where read() goes on stays as it is.
  void read_exactly_at(std::uint64_t offset, std::span<std::byte> buffer) const;

 private:
  [[noreturn]] void throw_ended_early() const;

  std::filesystem::path path_;
  int descriptor_ = -1;
  std::uint64_t size_bytes_ = 0;
};

/// Input stream buffer over a FileReader, for OpenVDB; hashes what it reads. Only tells its position, cannot seek.
class HashingSource : public std::streambuf {
 public:
  explicit HashingSource(FileReader& file);
  const Hasher& hasher() const { return hasher_; }
  /// Reads the rest of the file, so that the hash is that of the whole.
  void drain();

 protected:
  int_type underflow() override;
  pos_type seekoff(off_type offset, std::ios_base::seekdir from, std::ios_base::openmode mode) override;

 private:
  FileReader& file_;
  Hasher hasher_;
  std::uint64_t consumed_ = 0;  // Bytes before the buffer's end.
  std::unique_ptr<char[]> buffer_;
};

/// Output stream buffer to "<path>.partial", which commit() turns into <path>. Removes the partial file unless
/// committed. Failures are IoErrors thrown through the stream (set its exception mask to badbit). Only tells its
/// position, cannot seek.
class HashingSink : public std::streambuf {
 public:
  /// @param needed_bytes  predicted size, for the message of a full disk.
  HashingSink(std::filesystem::path path, std::uint64_t needed_bytes);
  ~HashingSink() override;
  HashingSink(const HashingSink&) = delete;
  HashingSink& operator=(const HashingSink&) = delete;

  /// Flush, fsync, compare the size, rename, fsync of the folder.
  void commit();
  std::uint64_t size_bytes() const;
  std::uint64_t digest() const { return hasher_.digest(); }  ///< Valid after commit().

 protected:
  int_type overflow(int_type c) override;
  std::streamsize xsputn(const char* data, std::streamsize size) override;
  int sync() override;
  pos_type seekoff(off_type offset, std::ios_base::seekdir from, std::ios_base::openmode mode) override;

 private:
  void write_out(const char* data, std::size_t size);
  void flush_buffer();
  [[noreturn]] void fail(const char* what, int reason) const;

  std::filesystem::path path_;
  std::filesystem::path partial_path_;
  std::uint64_t needed_bytes_;
  int descriptor_ = -1;
  bool committed_ = false;
  std::uint64_t written_bytes_ = 0;
  Writeback writeback_{std::uint64_t{1} << 20};
  Hasher hasher_;
  std::unique_ptr<char[]> buffer_;
};

}  // namespace arris::tiling
