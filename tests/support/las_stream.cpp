#include "support/las_stream.h"

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <stdexcept>

namespace arris::test {
namespace {

constexpr std::size_t kHeaderBytes = 227;
constexpr std::size_t kVlrHeaderBytes = 54;
constexpr std::size_t kDescriptorBytes = 192;
constexpr std::size_t kPointBytes = 20;
constexpr std::size_t kBufferBytes = 1 << 20;
constexpr std::uint8_t kDouble = 10;  // The LAS code of the type.

template <typename T>
void put(std::string& bytes, std::size_t at, T value) {
  std::memcpy(bytes.data() + at, &value, sizeof value);
}

std::string extra_bytes_vlr(int doubles) {
  std::string vlr(kVlrHeaderBytes, '\0');
  vlr.replace(2, 9, "LASF_Spec");
  put<std::uint16_t>(vlr, 18, 4);
  put(vlr, 20, static_cast<std::uint16_t>(kDescriptorBytes * static_cast<std::size_t>(doubles)));
  for (int i = 0; i < doubles; ++i) {
    std::string descriptor(kDescriptorBytes, '\0');
    put(descriptor, 2, kDouble);
    const std::string name = "extra" + std::to_string(i);
    descriptor.replace(4, name.size(), name);
    vlr += descriptor;
  }
  return vlr;
}

}  // namespace

LasStream::LasStream(const std::filesystem::path& path, double scale, int extra_doubles)
    : path_(path), file_(path, std::ios::binary), scale_(scale), extra_doubles_(extra_doubles), buffer_(header()) {}

void LasStream::add(const std::array<std::int32_t, 3>& position) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    low_[axis] = points_ == 0 ? position[axis] : std::min(low_[axis], position[axis]);
    high_[axis] = points_ == 0 ? position[axis] : std::max(high_[axis], position[axis]);
  }
  const std::size_t at = buffer_.size();
  buffer_.resize(at + kPointBytes + sizeof(double) * static_cast<std::size_t>(extra_doubles_));
  std::memcpy(buffer_.data() + at, position.data(), sizeof position);
  for (int i = 0; i < extra_doubles_; ++i)
    put(buffer_, at + kPointBytes + sizeof(double) * static_cast<std::size_t>(i), points_ + 0.125 * i);
  ++points_;
  if (buffer_.size() >= kBufferBytes) flush();
}

void LasStream::finish() {
  flush();
  file_.seekp(0);
  buffer_ = header();
  flush();
  file_.close();
  if (!file_) throw std::runtime_error("cannot write " + path_.string());
}

void LasStream::flush() {
  file_.write(buffer_.data(), static_cast<std::streamsize>(buffer_.size()));
  buffer_.clear();
}

std::string LasStream::header() const {
  const std::string vlr = extra_doubles_ > 0 ? extra_bytes_vlr(extra_doubles_) : "";
  std::string bytes(kHeaderBytes, '\0');
  bytes.replace(0, 4, "LASF");
  put<std::uint8_t>(bytes, 24, 1);
  put<std::uint8_t>(bytes, 25, 2);
  put<std::uint16_t>(bytes, 94, kHeaderBytes);
  put(bytes, 96, static_cast<std::uint32_t>(kHeaderBytes + vlr.size()));
  put<std::uint32_t>(bytes, 100, vlr.empty() ? 0 : 1);
  put(bytes, 105, static_cast<std::uint16_t>(kPointBytes + sizeof(double) * static_cast<std::size_t>(extra_doubles_)));
  put(bytes, 107, points_);
  put(bytes, 111, points_);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    put(bytes, 131 + 8 * axis, scale_);
    put(bytes, 179 + 16 * axis, high_[axis] * scale_);
    put(bytes, 187 + 16 * axis, low_[axis] * scale_);
  }
  return bytes + vlr;
}

}  // namespace arris::test
