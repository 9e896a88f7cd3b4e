#include "tiling/packed_points.h"

#include "core/byte_packing.h"

namespace arris::tiling {
namespace {

std::uint32_t bits(std::int32_t value) {
  return static_cast<std::uint32_t>(value);
}
std::int32_t coordinate(std::uint32_t coded, std::int32_t before) {
  return static_cast<std::int32_t>(unzigzag(coded, bits(before)));
}

/// Binary logarithm of the bytes that hold it.
unsigned id_code(std::uint64_t value) {
  return unsigned{value > 0xff} + unsigned{value > 0xffff} + unsigned{value > 0xffffffff};
}

}  // namespace

std::size_t pack_points(std::span<const SpooledPoint> points, std::byte* out) {
  const std::byte* const begin = out;
  SpooledPoint before{{0, 0, 0}, 0};
  for (const SpooledPoint& point : points) {
    const std::uint32_t x = zigzag(bits(point.position.x), bits(before.position.x));
    const std::uint32_t y = zigzag(bits(point.position.y), bits(before.position.y));
    const std::uint32_t z = zigzag(bits(point.position.z), bits(before.position.z));
    const std::uint64_t id = zigzag(point.id, before.id);
    const unsigned cx = bytes_code(x), cy = bytes_code(y), cz = bytes_code(z), ci = id_code(id);
    *out++ = static_cast<std::byte>(cx | cy << 2 | cz << 4 | ci << 6);
    put_bytes(out, x, cx + 1);
    put_bytes(out, y, cy + 1);
    put_bytes(out, z, cz + 1);
    put_bytes(out, id, 1U << ci);
    before = point;
  }
  return static_cast<std::size_t>(out - begin);
}

bool unpack_points(std::span<const std::byte> packed, std::span<LatticePoint> positions, std::span<std::uint64_t> ids) {
  const std::byte* in = packed.data();
  const std::byte* const end = in + packed.size();
  LatticePoint position{0, 0, 0};
  std::uint64_t id = 0;
  for (std::size_t i = 0; i < positions.size(); ++i) {
    if (end - in < static_cast<std::ptrdiff_t>(kLeastPackedBytes)) return false;
    const auto control = static_cast<unsigned>(*in++);
    position.x = coordinate(get_bytes<std::uint32_t>(in, (control & 3) + 1), position.x);
    position.y = coordinate(get_bytes<std::uint32_t>(in, (control >> 2 & 3) + 1), position.y);
    position.z = coordinate(get_bytes<std::uint32_t>(in, (control >> 4 & 3) + 1), position.z);
    id = unzigzag(get_bytes<std::uint64_t>(in, 1U << (control >> 6)), id);
    positions[i] = position;
    ids[i] = id;
  }
  return in == end;
}

}  // namespace arris::tiling
