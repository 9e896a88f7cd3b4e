#include "merge/frontier_coding.h"

#include <array>

#include "core/byte_packing.h"
#include "features/segment/tile_growth.h"

namespace arris::merge {
namespace {

constexpr std::size_t kRecordHeadWords = 4;
/// Stands before the bytes of an id that is not among the recent ones.
constexpr std::uint32_t kNewId = 255;

/// The last kNewId different ids, in places that are used in turn.
class RecentIds {
 public:
  std::uint32_t at(std::uint32_t place) const { return ids_[place]; }
  std::uint32_t last_new() const { return last_new_; }
  /// @return its place.
  std::uint32_t add(std::uint32_t id) {
    const std::uint32_t place = next_;
    ids_[place] = last_new_ = id;
    next_ = place + 1 == kNewId ? 0 : place + 1;
    return place;
  }

 private:
  std::array<std::uint32_t, kNewId> ids_{};
  std::uint32_t next_ = 0;
  std::uint32_t last_new_ = 0;
};

class Encoder {
 public:
  explicit Encoder(std::vector<std::byte>& out) : out_(out) {}

  void put_id(std::uint32_t id) {
    // One place per hash: an id that was pushed out costs some bytes, nothing else.
    std::uint8_t& place = place_of_[(id * 0x9e3779b1U) >> (32 - kHashBits)];
    if (recent_.at(place) == id) {
      put_byte(place);
      return;
    }
    put_byte(kNewId);
    put_number(zigzag(id, recent_.last_new()));
    place = static_cast<std::uint8_t>(recent_.add(id));
  }
  void put_number(std::uint32_t number) {
    put_sevens(number, [&](std::uint32_t byte) { put_byte(byte); });
  }
  void put_byte(std::uint32_t byte) { out_.push_back(static_cast<std::byte>(byte)); }

 private:
  static constexpr int kHashBits = 11;
  std::vector<std::byte>& out_;
  RecentIds recent_;
  std::array<std::uint8_t, 1U << kHashBits> place_of_{};
};

class Decoder {
 public:
  explicit Decoder(std::span<const std::byte> bytes) : next_(bytes.data()), end_(bytes.data() + bytes.size()) {}

  std::uint32_t id() {
    const std::uint32_t place = byte();
    if (place != kNewId) return recent_.at(place);
    const std::uint32_t id = unzigzag(number(), recent_.last_new());
    recent_.add(id);
    return id;
  }
  std::uint32_t number() {
    std::uint32_t result;
    if (!get_sevens(result, [&] { return byte(); })) sound_ = false;
    return result;
  }
  std::uint32_t byte() {
    if (next_ != end_) return static_cast<std::uint32_t>(*next_++);
    sound_ = false;
    return 0;
  }
  bool sound() const { return sound_; }
  bool done() const { return next_ == end_; }

 private:
  const std::byte* next_;
  const std::byte* end_;
  RecentIds recent_;
  bool sound_ = true;
};

}  // namespace

void FrontierBlock::clear() {
  words_.clear();
  begins_.clear();
}

void FrontierBlock::add(const FrontierPoint& point) {
  begins_.push_back(static_cast<std::uint32_t>(words_.size()));
  words_.insert(words_.end(),
                {point.id, static_cast<std::uint32_t>(point.position.x), static_cast<std::uint32_t>(point.position.y),
                 static_cast<std::uint32_t>(point.position.z), static_cast<std::uint32_t>(point.neighbours.size())});
  words_.insert(words_.end(), point.neighbours.begin(), point.neighbours.end());
}

void FrontierBlock::shrink_to_fit() {
  words_.shrink_to_fit();
  begins_.shrink_to_fit();
}

void encode_frontier(std::span<const std::uint32_t> words, std::size_t stride, std::vector<std::byte>& out) {
  Encoder encoder(out);
  std::array<std::uint32_t, 3> before{};
  for (std::size_t begin = 0; begin < words.size(); begin += stride) {
    const std::span<const std::uint32_t> record = words.subspan(begin, stride);
    encoder.put_id(record[0]);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      encoder.put_number(zigzag(record[1 + axis], before[axis]));
      before[axis] = record[1 + axis];
    }
    std::size_t count = stride - kRecordHeadWords;
    while (count > 0 && record[kRecordHeadWords + count - 1] == TileGrowth::kNoId) --count;
    encoder.put_byte(static_cast<std::uint32_t>(count));
    for (std::size_t i = 0; i < count; ++i) encoder.put_id(record[kRecordHeadWords + i]);
  }
}

bool decode_frontier(std::span<const std::byte> bytes, std::size_t records, const std::vector<bool>& dropped,
                     FrontierBlock& block) {
  block.clear();
  Decoder decoder(bytes);
  std::array<std::uint32_t, 3> position{};
  std::array<std::uint32_t, 256> neighbours;
  for (std::size_t i = 0; i < records && decoder.sound(); ++i) {
    const std::uint32_t id = decoder.id();
    for (std::uint32_t& c : position) c = unzigzag(decoder.number(), c);
    const std::uint32_t count = decoder.byte();
    for (std::uint32_t n = 0; n < count; ++n) neighbours[n] = decoder.id();
    if (!dropped.empty() && dropped[i]) continue;
    block.add({id,
               {static_cast<std::int32_t>(position[0]), static_cast<std::int32_t>(position[1]),
                static_cast<std::int32_t>(position[2])},
               std::span(neighbours).first(count)});
  }
  return decoder.sound() && decoder.done();
}

}  // namespace arris::merge
