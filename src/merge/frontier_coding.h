#pragma once
/// @file Frontier records in few bytes: points near each other have mostly the same neighbours.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/lattice.h"
#include "core/pages.h"

namespace arris::merge {

/// One record of TileGrowth::frontier.
struct FrontierPoint {
  std::uint32_t id = 0;
  LatticePoint position;
  std::span<const std::uint32_t> neighbours;  ///< Ids.
};

/// Records of a part of a tile, as numbers.
class FrontierBlock {
 public:
  std::size_t size() const { return begins_.size(); }
  FrontierPoint point(std::size_t index) const {
    const std::uint32_t* record = words_.data() + begins_[index];
    return {record[0],
            {static_cast<std::int32_t>(record[1]), static_cast<std::int32_t>(record[2]),
             static_cast<std::int32_t>(record[3])},
            {record + kHeadWords, record[4]}};
  }

  void clear();
  void add(const FrontierPoint& point);
  void shrink_to_fit();
  /// In memory, if it was shrunk to fit.
  std::uint64_t size_bytes() const { return sizeof(std::uint32_t) * (words_.size() + begins_.size()); }

 private:
  static constexpr std::size_t kHeadWords = 5;  ///< id, x, y, z, number of neighbours.
  PageVector<std::uint32_t> words_;
  PageVector<std::uint32_t> begins_;
};

/// Appends the bytes of records to `out`. Ids that were among the last few hundred different ones take a byte, others
/// their difference from the last such one; positions their difference from the one before: about 10 bytes and one and
/// a half per neighbour in the order of a tile's points. Any order is allowed.
/// @param words   TileGrowth::frontier: (4 + k) words each. @param stride  4 + k, k < 256.
void encode_frontier(std::span<const std::uint32_t> words, std::size_t stride, std::vector<std::byte>& out);

/// The reverse, of what one call appended. @param dropped  per record, or empty: these are left out. @return whether
/// the bytes were those of that many records.
bool decode_frontier(std::span<const std::byte> bytes, std::size_t records, const std::vector<bool>& dropped,
                     FrontierBlock& block);

}  // namespace arris::merge
