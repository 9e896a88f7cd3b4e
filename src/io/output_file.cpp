#include "io/output_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cassert>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <system_error>

#include "core/error.h"
#include "core/text.h"

namespace arris::io {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kBufferBytes = OutputFile::kMostExtension;

[[noreturn]] void fail(const fs::path& path, std::string_view what, int error, std::uint64_t size_bytes) {
  const char* advice = error == ENOSPC || error == EDQUOT ? "; free some space or choose another folder"
                       : error == EFBIG                   ? "; the system's limit on the size of a file is reached"
                                                          : "";
  throw IoError(fmt::format("{}: {} after {} bytes: {}{}", printable(path.string(), 1000), what, size_bytes,
                            std::generic_category().message(error), advice));
}

[[noreturn]] void refuse_existing(const fs::path& path) {
  throw ConfigError(fmt::format("{}: exists already; give --overwrite to replace it", printable(path.string(), 1000)));
}

void write_all(int descriptor, const fs::path& path, std::span<const std::byte> bytes, std::uint64_t offset) {
  while (!bytes.empty()) {
    const ssize_t done = ::pwrite(descriptor, bytes.data(), bytes.size(), static_cast<off_t>(offset));
    if (done < 0 && errno == EINTR) continue;
    if (done < 0) fail(path, "writing failed", errno, offset);
    bytes = bytes.subspan(static_cast<std::size_t>(done));
    offset += static_cast<std::uint64_t>(done);
  }
}

void check_final_path(const fs::path& path, bool overwrite) {
  struct stat status {};
  if (::lstat(path.c_str(), &status) != 0) return;  // Absent, or the opening of the partial file will say why not.
  if (!S_ISREG(status.st_mode) && !S_ISLNK(status.st_mode)) {
    throw ConfigError(fmt::format("{}: is not a regular file; choose another output", printable(path.string(), 1000)));
  }
  if (!overwrite) refuse_existing(path);
}

/// A partial file of a dead process that had our process id is taken over; one that another writer holds is refused.
int open_partial(const fs::path& partial) {
  const int descriptor = ::open(partial.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0666);
  if (descriptor < 0) fail(partial, "cannot be created", errno, 0);
  const bool held = ::flock(descriptor, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
  if (held || ::ftruncate(descriptor, 0) != 0) {
    const int error = held ? EBUSY : errno;
    ::close(descriptor);
    fail(partial, held ? "is being written by another output of the same name" : "cannot be emptied", error, 0);
  }
  return descriptor;
}

void sync_folder(const fs::path& file) {
  const fs::path folder = file.parent_path().empty() ? fs::path(".") : file.parent_path();
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return;  // A folder may be writable but not readable; then the system cannot be asked.
  const int result = ::fsync(descriptor);
  const int error = errno;
  ::close(descriptor);
  if (result != 0 && error != EINVAL && error != ENOTSUP) fail(folder, "syncing the folder failed", error, 0);
}

}  // namespace

OutputFile::OutputFile(fs::path final_path, bool overwrite)
    : final_path_(std::move(final_path)), overwrite_(overwrite), buffer_(new std::byte[kBufferBytes]) {
  check_final_path(final_path_, overwrite_);
  partial_path_ = final_path_;
  partial_path_ += fmt::format(".partial-{}", ::getpid());
  descriptor_ = open_partial(partial_path_);
}

OutputFile::~OutputFile() {
  if (descriptor_ < 0) return;
  ::unlink(partial_path_.c_str());
  ::close(descriptor_);
}

void OutputFile::write(std::span<const std::byte> bytes) {
  if (bytes.empty()) return;
  if (bytes.size() <= kBufferBytes) {
    std::memcpy(extend(bytes.size()).data(), bytes.data(), bytes.size());
    return;
  }
  flush();
  write_all(descriptor_, partial_path_, bytes, size_bytes_);
  size_bytes_ += bytes.size();
  writeback_.written(descriptor_, size_bytes_);
}

std::span<std::byte> OutputFile::extend(std::size_t size_bytes) {
  assert(size_bytes <= kMostExtension);
  if (size_bytes > kBufferBytes - buffered_) flush();
  const std::span<std::byte> place(buffer_.get() + buffered_, size_bytes);
  buffered_ += size_bytes;
  size_bytes_ += size_bytes;
  return place;
}

void OutputFile::write(std::string_view text) {
  write(std::as_bytes(std::span(text.data(), text.size())));
}

void OutputFile::patch(std::uint64_t offset, std::span<const std::byte> bytes) {
  if (offset > size_bytes_ || bytes.size() > size_bytes_ - offset) {
    throw IoError(fmt::format("{}: patch of {} bytes at {} lies behind the end at {}",
                              printable(partial_path_.string(), 1000), bytes.size(), offset, size_bytes_));
  }
  flush();
  write_all(descriptor_, partial_path_, bytes, offset);
}

void OutputFile::flush() {
  if (buffered_ == 0) return;
  write_all(descriptor_, partial_path_, {buffer_.get(), buffered_}, size_bytes_ - buffered_);
  buffered_ = 0;
  writeback_.written(descriptor_, size_bytes_);
}

void OutputFile::commit() {
  flush();
  if (::fsync(descriptor_) != 0) fail(partial_path_, "syncing failed", errno, size_bytes_);
  check_final_path(final_path_, overwrite_);
  int result = -1;
  if (!overwrite_) {
    result = ::renameat2(AT_FDCWD, partial_path_.c_str(), AT_FDCWD, final_path_.c_str(), RENAME_NOREPLACE);
    if (result != 0 && errno == EEXIST) refuse_existing(final_path_);
  }
  // Some file systems cannot rename without replacing; the check above has to do there.
  if (result != 0) result = ::rename(partial_path_.c_str(), final_path_.c_str());
  if (result != 0) fail(final_path_, "renaming the finished file failed", errno, size_bytes_);
  const int descriptor = descriptor_;
  descriptor_ = -1;
  if (::close(descriptor) != 0 && errno != EINTR) fail(final_path_, "closing failed", errno, size_bytes_);
  sync_folder(final_path_);
}

}  // namespace arris::io
