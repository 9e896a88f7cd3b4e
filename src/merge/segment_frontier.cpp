#include "merge/segment_frontier.h"

#include <algorithm>
#include <cstring>
#include <utility>
#include <vector>

#include "core/byte_packing.h"
#include "features/segment/tile_growth.h"
#include "merge/packed_frontier.h"

namespace arris::merge {
namespace {

constexpr std::size_t kHeadWords = 4;
constexpr std::size_t kBlockRecords = 64 * 1024;

/// Before the packed records of a block.
struct BlockHead {
  std::uint32_t records, bytes;
};

std::vector<std::byte> packed_block(std::span<const std::uint32_t> words, std::size_t stride) {
  std::vector<std::byte> block(sizeof(BlockHead) + most_packed_bytes(words.size(), stride));
  const std::size_t bytes = pack_frontier(words, stride, block.data() + sizeof(BlockHead));
  const BlockHead head{static_cast<std::uint32_t>(words.size() / stride), static_cast<std::uint32_t>(bytes)};
  std::memcpy(block.data(), &head, sizeof(head));
  block.resize(sizeof(head) + bytes);
  return block;
}

}  // namespace

SegmentFrontier::SegmentFrontier(std::filesystem::path file, std::size_t most_neighbours)
    : stride_(kHeadWords + most_neighbours),
      path_(std::move(file)),
      file_(std::make_unique<tiling::ScratchFile>(path_)) {}

std::uint64_t SegmentFrontier::keep_border(const PointLabels& labels) {
  auto border = std::make_unique<tiling::ScratchFile>(path_.string() + "_border");
  std::uint64_t peak_bytes = bytes_on_disk();
  std::vector<std::uint32_t> kept;
  records_ = 0;
  read_blocks([&](std::span<const std::uint32_t> words, std::uint64_t offset) {
    kept.clear();
    for (std::size_t i = 0; i < words.size() / stride_; ++i) {
      const FrontierPoint p = point(words, i);
      const std::uint32_t own = labels[p.id];
      const auto same = [&](std::uint32_t neighbour) { return labels[neighbour] == own; };
      if (own != 0 && std::all_of(p.neighbours.begin(), p.neighbours.end(), same)) continue;
      const std::span<const std::uint32_t> record = words.subspan(i * stride_, stride_);
      kept.insert(kept.end(), record.begin(), record.end());
    }
    records_ += kept.size() / stride_;
    if (!kept.empty()) border->append(packed_block(kept, stride_));
    peak_bytes = std::max(peak_bytes, file_->bytes_on_disk() + border->size_bytes());
    file_->discard_before(offset);
  });
  file_ = std::move(border);
  return peak_bytes;
}

void SegmentFrontier::append(std::span<const std::uint32_t> words) {
  if (words.empty()) return;
  const std::vector<std::byte> block = packed_block(words, stride_);
  const std::lock_guard lock(mutex_);
  file_->append(block);
  records_ += words.size() / stride_;
}

void SegmentFrontier::for_each_block(const std::function<void(std::span<const std::uint32_t>)>& use) const {
  read_blocks([&](std::span<const std::uint32_t> words, std::uint64_t) { use(words); });
}

void SegmentFrontier::read_blocks(const std::function<void(std::span<const std::uint32_t>, std::uint64_t)>& use) const {
  std::vector<std::uint32_t> words;
  std::vector<std::byte> packed;
  for (std::uint64_t offset = 0; offset < file_->size_bytes();) {
    BlockHead head{};
    file_->read_at(offset, std::as_writable_bytes(std::span(&head, 1)));
    offset += sizeof(head);
    if (head.records > 2 * kBlockRecords || head.bytes > file_->size_bytes() - offset) file_->throw_damaged();
    packed.resize(head.bytes + kPackingSlackBytes);
    const std::span bytes = std::span(packed).first(head.bytes);
    file_->read_at(offset, bytes);
    offset += head.bytes;
    const std::size_t before = words.size();
    words.resize(before + head.records * stride_);
    if (!unpack_frontier(bytes, stride_, std::span(words).subspan(before))) file_->throw_damaged();
    if (words.size() < kBlockRecords * stride_ && offset < file_->size_bytes()) continue;
    use(words, offset);
    words.clear();
  }
}

FrontierPoint SegmentFrontier::point(std::span<const std::uint32_t> words, std::size_t index) const {
  const std::span<const std::uint32_t> record = words.subspan(index * stride_, stride_);
  std::size_t count = stride_ - kHeadWords;
  while (count > 0 && record[kHeadWords + count - 1] == TileGrowth::kNoId) --count;
  return {record[0],
          {static_cast<std::int32_t>(record[1]), static_cast<std::int32_t>(record[2]),
           static_cast<std::int32_t>(record[3])},
          record.subspan(kHeadWords, count)};
}

}  // namespace arris::merge
