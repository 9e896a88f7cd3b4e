#include "tiling/scratch_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <utility>

#include "core/error.h"
#include "core/text.h"
#include "tiling/checked_file.h"

namespace arris::tiling {
namespace {

int open_checked(const std::filesystem::path& path, int flags) {
  for (;;) {
    const int descriptor = ::open(path.c_str(), flags | O_CLOEXEC | O_NOFOLLOW, 0600);
    if (descriptor >= 0) return descriptor;
    if (errno != EINTR) throw_io_error(path, "open", errno);
  }
}

}  // namespace

ScratchFile::ScratchFile(std::filesystem::path path)
    : path_(std::move(path)), descriptor_(open_checked(path_, O_RDWR | O_CREAT | O_TRUNC)) {}

ScratchFile::~ScratchFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
  ::unlink(path_.c_str());
}

void ScratchFile::append(std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t wrote = ::pwrite(descriptor_, bytes.data(), bytes.size(), static_cast<off_t>(size_bytes_));
    if (wrote < 0 && errno == EINTR) continue;
    if (wrote <= 0) throw_io_error(path_, "write", wrote == 0 ? ENOSPC : errno);
    bytes = bytes.subspan(static_cast<std::size_t>(wrote));
    size_bytes_ += static_cast<std::uint64_t>(wrote);
  }
}

void ScratchFile::read_at(std::uint64_t offset, std::span<std::byte> bytes) const {
  while (!bytes.empty()) {
    const ssize_t got = ::pread(descriptor_, bytes.data(), bytes.size(), static_cast<off_t>(offset));
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) throw_io_error(path_, "read", errno);
    if (got == 0) throw_damaged();
    bytes = bytes.subspan(static_cast<std::size_t>(got));
    offset += static_cast<std::uint64_t>(got);
  }
}

void ScratchFile::close() {
  const int descriptor = std::exchange(descriptor_, -1);
  if (descriptor >= 0 && ::close(descriptor) != 0 && errno != EINTR) throw_io_error(path_, "close", errno);
}

void ScratchFile::reopen() {
  if (descriptor_ < 0) descriptor_ = open_checked(path_, O_RDWR);
}

void ScratchFile::throw_damaged() const {
  throw IoError(
      fmt::format("{}: damaged after it was written; check the disk, or choose another folder with --temp-dir",
                  printable(path_.string())));
}

}  // namespace arris::tiling
