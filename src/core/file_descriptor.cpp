#include "core/file_descriptor.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

#include "core/error.h"

namespace arris {

FileDescriptor FileDescriptor::open(const std::filesystem::path& path, int flags) {
  FileDescriptor file(path, ::open(path.c_str(), flags | O_CLOEXEC, 0600));
  if (file.descriptor_ < 0) file.fail("cannot open");
  return file;
}

FileDescriptor::FileDescriptor(FileDescriptor&& other) noexcept
    : path_(std::move(other.path_)), descriptor_(std::exchange(other.descriptor_, -1)) {}

FileDescriptor::~FileDescriptor() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

void FileDescriptor::fail(const char* what) const {
  const int reason = errno;
  const char* remedy = reason == ENOSPC || reason == EDQUOT ? "; free space or choose another --temp-dir" : "";
  throw IoError(fmt::format("{}: {} ({}){}", path_.string(), what, std::strerror(reason), remedy));
}

void FileDescriptor::write_all(std::span<const std::byte> bytes) const {
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
    if (written < 0) {
      if (errno == EINTR) continue;
      fail("cannot write");
    }
    bytes = bytes.subspan(static_cast<std::size_t>(written));
  }
}

std::size_t FileDescriptor::read_some(std::span<std::byte> bytes) const {
  std::size_t done = 0;
  while (done < bytes.size()) {
    const ssize_t got = ::read(descriptor_, bytes.data() + done, bytes.size() - done);
    if (got < 0) {
      if (errno == EINTR) continue;
      fail("cannot read");
    }
    if (got == 0) break;
    done += static_cast<std::size_t>(got);
  }
  return done;
}

std::uint64_t FileDescriptor::size_bytes() const {
  struct stat status {};
  if (::fstat(descriptor_, &status) != 0) fail("cannot stat");
  return static_cast<std::uint64_t>(status.st_size);
}

}  // namespace arris
