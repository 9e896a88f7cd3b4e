#include "io/input_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <system_error>

#include "core/error.h"
#include "core/text.h"

namespace arris::io {
namespace {

constexpr std::size_t kWindowBytes = std::size_t{1} << 20;

std::string reason(int error) {
  return std::generic_category().message(error);
}

}  // namespace

InputFile::InputFile(std::filesystem::path path) : path_(std::move(path)) {
  // O_NONBLOCK: opening a pipe that nobody writes to must not hang; it has no effect on regular files.
  descriptor_ = ::open(path_.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (descriptor_ < 0) throw IoError(fmt::format("{}: cannot be opened: {}", name(), reason(errno)));
  struct stat status {};
  if (::fstat(descriptor_, &status) != 0) {
    const int error = errno;
    ::close(descriptor_);
    throw IoError(fmt::format("{}: cannot be examined: {}", name(), reason(error)));
  }
  if (!S_ISREG(status.st_mode)) {
    ::close(descriptor_);
    throw InputError(
        fmt::format("{}: is not a regular file; points are read several times, so save them to a file first", name()));
  }
  size_bytes_ = static_cast<std::uint64_t>(status.st_size);
  modified_ns_ = std::int64_t{status.st_mtim.tv_sec} * 1'000'000'000 + status.st_mtim.tv_nsec;
}

InputFile::InputFile(std::string name, std::vector<std::byte> bytes)
    : path_(std::move(name)), memory_(std::move(bytes)), size_bytes_(memory_.size()) {}

std::shared_ptr<const InputFile> InputFile::in_memory(std::string name, std::vector<std::byte> bytes) {
  return std::shared_ptr<const InputFile>(new InputFile(std::move(name), std::move(bytes)));
}

InputFile::~InputFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

void refuse(const InputFile& file, std::uint64_t byte, std::string_view what, std::string_view remedy) {
  throw InputError(fmt::format("{}: byte {}: {}; {}", file.name(), byte, what, remedy));
}

std::string InputFile::name() const {
  return printable(path_.string(), 1000);
}

std::size_t InputFile::read_some(std::uint64_t offset, std::span<std::byte> bytes) const {
  if (descriptor_ < 0) {
    if (offset >= size_bytes_) return 0;
    const auto there = static_cast<std::size_t>(std::min<std::uint64_t>(bytes.size(), size_bytes_ - offset));
    if (there > 0) std::memcpy(bytes.data(), memory_.data() + offset, there);
    return there;
  }
  std::size_t done = 0;
  while (done < bytes.size()) {
    const ssize_t got =
        ::pread(descriptor_, bytes.data() + done, bytes.size() - done, static_cast<off_t>(offset + done));
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) throw IoError(fmt::format("{}: reading byte {} failed: {}", name(), offset + done, reason(errno)));
    if (got == 0) break;
    done += static_cast<std::size_t>(got);
  }
  return done;
}

void InputFile::read(std::uint64_t offset, std::span<std::byte> bytes) const {
  const std::size_t done = read_some(offset, bytes);
  if (done == bytes.size()) return;
  refuse(*this, offset + done, fmt::format("the file ends here, but had {} bytes when it was opened", size_bytes_),
         "it was cut short while being read: run again when it is complete");
}

void FileWindow::seek(std::uint64_t offset) {
  buffer_offset_ = offset;
  begin_ = end_ = 0;
}

bool FileWindow::extend() {
  if (full() || at_file_end()) return false;
  const std::size_t unread = end_ - begin_;
  if (begin_ > 0) {
    std::memmove(buffer_.data(), buffer_.data() + begin_, unread);
    buffer_offset_ += begin_;
    begin_ = 0;
    end_ = unread;
  }
  const std::uint64_t left = file_.size_bytes() - (buffer_offset_ + unread);
  if (unread == buffer_.size()) {
    const std::uint64_t useful = std::min<std::uint64_t>(unread + left, std::max(kWindowBytes, 2 * unread));
    buffer_.resize(static_cast<std::size_t>(std::min<std::uint64_t>(useful, kMaxBytes)));
  }
  const auto wanted = static_cast<std::size_t>(std::min<std::uint64_t>(left, buffer_.size() - unread));
  file_.read(buffer_offset_ + unread, {buffer_.data() + unread, wanted});
  end_ = unread + wanted;
  return true;
}

}  // namespace arris::io
