#include "merge/result_coding.h"

#include <algorithm>
#include <array>
#include <bit>

#include "core/byte_packing.h"

namespace arris::merge {
namespace {

/// A record begins with its classes and a byte that tells what follows: in the low bits the bytes of the id's
/// difference from the one before, less one, then a bit for each field that is not zero.
enum FieldBit : unsigned {
  kVotes = 1U << 2,
  kGap = 1U << 3,
  kStrength = 1U << 4,
  kAngle = 1U << 5,
  kScore = 1U << 6,
  kToEdge = 1U << 7,
};
constexpr unsigned kIdCode = 3;
/// Head, id, votes in sevens of bits, four numbers and the way to the edge.
constexpr std::size_t kMostRecordBytes = 2 + 4 + 5 + 4 * 4 + 12;

std::uint32_t bits(float value) {
  return std::bit_cast<std::uint32_t>(value);
}

std::byte* encode(const ContourRecord& r, std::uint32_t id_difference, std::byte* out) {
  const std::array<std::uint32_t, 5> fields{r.votes, bits(r.gap_deg), bits(r.fold_strength), bits(r.fold_angle_deg),
                                            bits(r.score)};
  unsigned head = bytes_code(id_difference);
  for (std::size_t i = 0; i < fields.size(); ++i) head |= fields[i] != 0 ? unsigned{kVotes} << i : 0;
  const bool to_edge = std::any_of(r.to_edge.begin(), r.to_edge.end(), [](float axis) { return bits(axis) != 0; });
  if (to_edge) head |= kToEdge;
  put_bytes(out, std::uint8_t{r.classes}, 1);
  put_bytes(out, static_cast<std::uint8_t>(head), 1);
  put_bytes(out, id_difference, (head & kIdCode) + 1);
  // Votes are seldom more than some hundred.
  if (r.votes != 0)
    put_sevens(r.votes, [&](std::uint32_t byte) { put_bytes(out, static_cast<std::uint8_t>(byte), 1); });
  for (std::size_t i = 1; i < fields.size(); ++i)
    if (fields[i] != 0) put_bytes(out, fields[i], 4);
  if (to_edge)
    for (const float axis : r.to_edge) put_bytes(out, bits(axis), 4);
  return out;
}

std::uint32_t get_votes(const std::byte*& in) {
  std::uint32_t votes;
  get_sevens(votes, [&] { return std::uint32_t{get_bytes<std::uint8_t>(in, 1)}; });  // Any bits are votes.
  return votes;
}

const std::byte* decode(const std::byte* in, ContourRecord& r) {
  r.classes = get_bytes<std::uint8_t>(in, 1);
  const unsigned head = get_bytes<std::uint8_t>(in, 1);
  r.id += get_bytes<std::uint32_t>(in, (head & kIdCode) + 1);
  const auto number = [&](unsigned field) {
    return (head & field) != 0 ? std::bit_cast<float>(get_bytes<std::uint32_t>(in, 4)) : 0.0F;
  };
  r.votes = (head & kVotes) != 0 ? get_votes(in) : 0;
  r.gap_deg = number(kGap);
  r.fold_strength = number(kStrength);
  r.fold_angle_deg = number(kAngle);
  r.score = number(kScore);
  for (float& axis : r.to_edge) axis = number(kToEdge);
  return in;
}

}  // namespace

void encode_results(std::span<const ContourRecord> records, std::uint64_t first_id, PageVector<std::byte>& out) {
  const std::size_t begin = out.size();
  out.resize(begin + records.size() * kMostRecordBytes + kPackingSlackBytes);
  std::byte* next = out.data() + begin;
  std::uint64_t before = first_id;
  for (const ContourRecord& record : records) {
    next = encode(record, static_cast<std::uint32_t>(record.id - before), next);
    before = record.id;
  }
  out.resize(static_cast<std::size_t>(next - out.data()));
}

bool decode_results(std::span<const std::byte> bytes, std::size_t count, std::uint64_t first_id,
                    ContourRecords& records) {
  records.clear();
  const std::byte* next = bytes.data();
  const std::byte* const end = next + bytes.size();
  // Far from the end no record can pass it; what is near it is decoded where it may.
  std::array<std::byte, 2 * kMostRecordBytes + kPackingSlackBytes> rest{};
  ContourRecord record;
  record.id = first_id;
  for (std::size_t i = 0; i < count; ++i) {
    const auto left = static_cast<std::size_t>(end - next);
    if (left >= kMostRecordBytes + kPackingSlackBytes) {
      next = decode(next, record);
    } else {
      std::copy(next, end, rest.begin());
      const auto used = static_cast<std::size_t>(decode(rest.data(), record) - rest.data());
      if (used > left) return false;
      next += used;
    }
    records.push_back(record);
  }
  return next == end;
}

}  // namespace arris::merge
