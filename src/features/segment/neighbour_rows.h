#pragma once
/// @file Which points are the neighbours of which, in half the bytes of their slots.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <mutex>
#include <vector>

#include "core/pages.h"
#include "features/segment/neighbourhood_batch.h"

namespace arris {

/// Slots of neighbours, read from their row. A range.
class NeighbourList {
 public:
  std::size_t size() const { return count_; }
  bool empty() const { return count_ == 0; }
  std::uint32_t operator[](std::size_t i) const { return slots_[i]; }
  const std::uint32_t* begin() const { return slots_.data(); }
  const std::uint32_t* end() const { return slots_.data() + count_; }

 private:
  friend class NeighbourRows;
  std::size_t count_ = 0;
  std::array<std::uint32_t, kMostNeighbours> slots_;  ///< The first count_ of them.
};

/// A row of up to `most` neighbours for every slot. Slots that are close in space are mostly close in number, so a row
/// holds differences of 16 bits; a row with a greater one says where its slots are written out. 2 bytes per neighbour,
/// 4 more in about one row of ten, and one per slot. Rows are written by Writers, several at a time, each of other
/// slots; reading is thread-safe while nobody writes.
class NeighbourRows {
 public:
  /// All empty. @param most  2 to kMostNeighbours.
  NeighbourRows(std::size_t slots, std::size_t most);

  std::size_t most() const { return most_; }
  std::size_t count(std::uint32_t slot) const { return counts_[slot] & kCount; }
  NeighbourList operator[](std::uint32_t slot) const {
    NeighbourList list;
    list.count_ = count(slot);
    if ((counts_[slot] & kFar) != 0) {
      std::copy_n(far_row(slot), list.count_, list.slots_.begin());
      return list;
    }
    const std::int16_t* const row = near_.data() + std::size_t{slot} * most_;
    for (std::size_t block = 0; block < list.count_; block += kBlock) {
      for (std::size_t i = block; i < block + kBlock; ++i)  // Beyond the count: never looked at.
        list.slots_[i] = slot + static_cast<std::uint32_t>(std::int32_t{row[i]});
    }
    return list;
  }
  /// @param i  less than the count.
  std::uint32_t at(std::uint32_t slot, std::size_t i) const {
    if ((counts_[slot] & kFar) != 0) return far_row(slot)[i];
    return slot + static_cast<std::uint32_t>(std::int32_t{near_[std::size_t{slot} * most_ + i]});
  }
  /// Calls use(slot of neighbour) in order until it returns false.
  template <class Use>
  void visit(std::uint32_t slot, Use&& use) const {
    const std::size_t size = count(slot);
    if ((counts_[slot] & kFar) != 0) {
      const std::uint32_t* const row = far_row(slot);
      for (std::size_t i = 0; i < size; ++i)
        if (!use(row[i])) return;
    } else {
      const std::int16_t* const row = near_.data() + std::size_t{slot} * most_;
      for (std::size_t i = 0; i < size; ++i)
        if (!use(slot + static_cast<std::uint32_t>(std::int32_t{row[i]}))) return;
    }
  }
  /// Of a row that is not empty.
  std::uint32_t last(std::uint32_t slot) const { return at(slot, count(slot) - 1); }

  class Writer;

 private:
  static constexpr std::uint8_t kFar = 0x80, kCount = 0x7f;
  static constexpr std::size_t kBlock = 8;
  static_assert(kMostNeighbours % kBlock == 0 && kMostNeighbours <= kCount);
  /// Rows that are written out come in sheets, so that none of them ever moves.
  static constexpr std::uint32_t kSheetRows = 256;
  struct Sheet {
    std::uint32_t number = 0;
    std::uint32_t used = 0;
    std::uint32_t* rows = nullptr;
  };

  const std::uint32_t* far_row(std::uint32_t slot) const {
    std::uint32_t at;
    std::memcpy(&at, near_.data() + std::size_t{slot} * most_, sizeof(at));
    return sheets_[at / kSheetRows].get() + std::size_t{at % kSheetRows} * most_;
  }
  Sheet take_sheet();
  void return_sheet(const Sheet& sheet);

  std::size_t most_;
  PageVector<std::int16_t> near_;  ///< Written where asked for only.
  PageVector<std::uint8_t> counts_;
  std::mutex mutex_;
  std::vector<std::unique_ptr<std::uint32_t[]>> sheets_;
  std::vector<Sheet> open_;  ///< Not full, and with no writer.
};

/// One per thread at a time.
class NeighbourRows::Writer {
 public:
  explicit Writer(NeighbourRows& rows) : rows_(rows) {}
  ~Writer() { rows_.return_sheet(sheet_); }
  Writer(const Writer&) = delete;
  Writer& operator=(const Writer&) = delete;

  /// Once per slot. @param slot_of(i)  of the i-th of `count` neighbours, most() at most.
  template <class SlotOf>
  void put(std::uint32_t slot, std::size_t count, const SlotOf& slot_of) {
    std::int16_t* const row = rows_.near_.data() + std::size_t{slot} * rows_.most_;
    bool far = false;
    for (std::size_t i = 0; i < count; ++i) {
      const auto difference = static_cast<std::int32_t>(slot_of(i) - slot);
      row[i] = static_cast<std::int16_t>(difference);
      far |= row[i] != difference;
    }
    rows_.counts_[slot] = static_cast<std::uint8_t>(count);
    if (!far) return;
    std::uint32_t* const written_out = far_row(slot);
    for (std::size_t i = 0; i < count; ++i) written_out[i] = slot_of(i);
  }

 private:
  /// Where a row is written out; says so in the row.
  std::uint32_t* far_row(std::uint32_t slot);

  NeighbourRows& rows_;
  Sheet sheet_;
};

}  // namespace arris
