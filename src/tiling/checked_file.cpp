#include "tiling/checked_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <sys/statvfs.h>
#include <unistd.h>
#include <xxhash.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <string>
#include <system_error>
#include <utility>

#include "core/error.h"
#include "core/text.h"

namespace arris::tiling {
namespace {

constexpr std::size_t kBufferBytes = 256 * 1024;

int open_checked(const std::filesystem::path& path, int flags, std::uint64_t needed_bytes) {
  for (;;) {
    const int descriptor = ::open(path.c_str(), flags | O_CLOEXEC | O_NOFOLLOW, 0600);
    if (descriptor >= 0) return descriptor;
    if (errno != EINTR) throw_io_error(path, "open", errno, needed_bytes);
  }
}

std::uint64_t file_size_bytes(int descriptor, const std::filesystem::path& path) {
  struct stat status {};
  if (::fstat(descriptor, &status) != 0) throw_io_error(path, "stat", errno);
  return static_cast<std::uint64_t>(status.st_size);
}

void sync_folder(const std::filesystem::path& folder) {
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) throw_io_error(folder, "open", errno);
  const int result = ::fsync(descriptor);
  const int reason = errno;
  ::close(descriptor);
  // Some file systems cannot sync folders and say EINVAL; nothing better can be done there.
  if (result != 0 && reason != EINVAL) throw_io_error(folder, "fsync", reason);
}

}  // namespace

void throw_io_error(const std::filesystem::path& path, const char* what, int reason, std::uint64_t needed_bytes) {
  std::string message =
      fmt::format("{}: {} failed: {}", printable(path.string()), what, std::generic_category().message(reason));
  if (reason == ENOSPC || reason == EDQUOT || reason == EFBIG) {
    struct statvfs space {};
    if (::statvfs(path.parent_path().c_str(), &space) == 0) {
      message += fmt::format("; {} free there", human_bytes(std::uint64_t{space.f_bavail} * space.f_frsize));
    }
    if (needed_bytes > 0) message += fmt::format(", about {} more needed", human_bytes(needed_bytes));
    message += "; free some space or choose another folder with --temp-dir";
  }
  throw IoError(message);
}

struct Hasher::State {
  XXH3_state_t* xxh = XXH3_createState();
  State() {
    if (!xxh) throw std::bad_alloc();
  }
  State(const State&) = delete;
  State& operator=(const State&) = delete;
  ~State() { XXH3_freeState(xxh); }
};

Hasher::Hasher() : state_(std::make_unique<State>()) {
  reset();
}
Hasher::~Hasher() = default;
void Hasher::reset() {
  XXH3_64bits_reset(state_->xxh);
}
void Hasher::update(const void* data, std::size_t size_bytes) {
  XXH3_64bits_update(state_->xxh, data, size_bytes);
}
std::uint64_t Hasher::digest() const {
  return XXH3_64bits_digest(state_->xxh);
}

FileReader::FileReader(std::filesystem::path path)
    : path_(std::move(path)), descriptor_(open_checked(path_, O_RDONLY, 0)) {
  try {
    size_bytes_ = file_size_bytes(descriptor_, path_);
  } catch (...) {
    ::close(descriptor_);
    throw;
  }
}

FileReader::~FileReader() {
  ::close(descriptor_);
}

void FileReader::rewind() {
  if (::lseek(descriptor_, 0, SEEK_SET) < 0) throw_io_error(path_, "seek", errno);
}

std::size_t FileReader::read(std::span<std::byte> buffer) {
  for (;;) {
    const ssize_t got = ::read(descriptor_, buffer.data(), buffer.size());
    if (got >= 0) return static_cast<std::size_t>(got);
    if (errno != EINTR) throw_io_error(path_, "read", errno);
  }
}

void FileReader::read_exactly(std::span<std::byte> buffer) {
  while (!buffer.empty()) {
    const std::size_t got = read(buffer);
    if (got == 0) throw_ended_early();
    buffer = buffer.subspan(got);
  }
}

void FileReader::read_exactly_at(std::uint64_t offset, std::span<std::byte> buffer) const {
  while (!buffer.empty()) {
    const ssize_t got = ::pread(descriptor_, buffer.data(), buffer.size(), static_cast<off_t>(offset));
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) throw_io_error(path_, "read", errno);
    if (got == 0) throw_ended_early();
    buffer = buffer.subspan(static_cast<std::size_t>(got));
    offset += static_cast<std::uint64_t>(got);
  }
}

void FileReader::throw_ended_early() const {
  throw IoError(fmt::format("{}: ended early; the file was damaged after it was written, run again with --no-resume",
                            printable(path_.string())));
}

HashingSource::HashingSource(FileReader& file)
    : file_(file), buffer_(std::make_unique_for_overwrite<char[]>(kBufferBytes)) {}

HashingSource::int_type HashingSource::underflow() {
  if (gptr() < egptr()) return traits_type::to_int_type(*gptr());
  const std::size_t got = file_.read(std::as_writable_bytes(std::span(buffer_.get(), kBufferBytes)));
  if (got == 0) return traits_type::eof();
  hasher_.update(buffer_.get(), got);
  consumed_ += got;
  setg(buffer_.get(), buffer_.get(), buffer_.get() + got);
  return traits_type::to_int_type(*gptr());
}

void HashingSource::drain() {
  do {
    setg(buffer_.get(), buffer_.get(), buffer_.get());
  } while (underflow() != traits_type::eof());
}

HashingSource::pos_type HashingSource::seekoff(off_type offset, std::ios_base::seekdir from, std::ios_base::openmode) {
  if (offset != 0 || from != std::ios_base::cur) return pos_type(off_type(-1));
  return pos_type(static_cast<off_type>(consumed_) - (egptr() - gptr()));
}

HashingSink::HashingSink(std::filesystem::path path, std::uint64_t needed_bytes)
    : path_(std::move(path)),
      partial_path_(path_.string() + ".partial"),
      needed_bytes_(needed_bytes),
      descriptor_(open_checked(partial_path_, O_WRONLY | O_CREAT | O_TRUNC, needed_bytes)),
      buffer_(std::make_unique_for_overwrite<char[]>(kBufferBytes)) {
  setp(buffer_.get(), buffer_.get() + kBufferBytes);
}

HashingSink::~HashingSink() {
  if (descriptor_ >= 0) ::close(descriptor_);
  if (!committed_) ::unlink(partial_path_.c_str());
}

std::uint64_t HashingSink::size_bytes() const {
  return written_bytes_ + static_cast<std::uint64_t>(pptr() - pbase());
}

void HashingSink::write_out(const char* data, std::size_t size) {
  hasher_.update(data, size);
  while (size > 0) {
    const ssize_t wrote = ::write(descriptor_, data, size);
    if (wrote < 0 && errno == EINTR) continue;
    if (wrote <= 0) fail("write", wrote == 0 ? ENOSPC : errno);
    data += wrote;
    size -= static_cast<std::size_t>(wrote);
    written_bytes_ += static_cast<std::uint64_t>(wrote);
  }
  writeback_.written(descriptor_, written_bytes_);
}

void HashingSink::flush_buffer() {
  const std::size_t size = static_cast<std::size_t>(pptr() - pbase());
  setp(buffer_.get(), buffer_.get() + kBufferBytes);
  write_out(buffer_.get(), size);
}

HashingSink::int_type HashingSink::overflow(int_type c) {
  flush_buffer();
  if (!traits_type::eq_int_type(c, traits_type::eof())) sputc(traits_type::to_char_type(c));
  return traits_type::not_eof(c);
}

std::streamsize HashingSink::xsputn(const char* data, std::streamsize size) {
  if (size > epptr() - pptr()) {
    flush_buffer();
    if (static_cast<std::size_t>(size) >= kBufferBytes) {
      write_out(data, static_cast<std::size_t>(size));
      return size;
    }
  }
  std::memcpy(pptr(), data, static_cast<std::size_t>(size));
  pbump(static_cast<int>(size));
  return size;
}

int HashingSink::sync() {
  flush_buffer();
  return 0;
}

HashingSink::pos_type HashingSink::seekoff(off_type offset, std::ios_base::seekdir from, std::ios_base::openmode) {
  if (offset != 0 || from != std::ios_base::cur) return pos_type(off_type(-1));
  return pos_type(static_cast<off_type>(size_bytes()));
}

void HashingSink::commit() {
  flush_buffer();
  if (::fsync(descriptor_) != 0) fail("fsync", errno);
  if (const std::uint64_t size = file_size_bytes(descriptor_, partial_path_); size != written_bytes_) {
    throw IoError(fmt::format("{}: {} bytes were written but the file holds {}; check the disk",
                              printable(path_.string()), written_bytes_, size));
  }
  const int descriptor = std::exchange(descriptor_, -1);
  if (::close(descriptor) != 0 && errno != EINTR) fail("close", errno);
  if (::rename(partial_path_.c_str(), path_.c_str()) != 0) fail("rename", errno);
  committed_ = true;
  sync_folder(path_.parent_path());
}

void HashingSink::fail(const char* what, int reason) const {
  throw_io_error(path_, what, reason, needed_bytes_ > written_bytes_ ? needed_bytes_ - written_bytes_ : 0);
}

}  // namespace arris::tiling
