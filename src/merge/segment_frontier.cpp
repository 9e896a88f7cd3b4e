#include "merge/segment_frontier.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "features/segment/tile_growth.h"

namespace arris::merge {
namespace {

constexpr std::size_t kHeadWords = 4;
constexpr std::size_t kBlockRecords = 64 * 1024;

}  // namespace

SegmentFrontier::SegmentFrontier(std::filesystem::path file, std::size_t most_neighbours)
    : stride_(kHeadWords + most_neighbours),
      path_(std::move(file)),
      file_(std::make_unique<tiling::ScratchFile>(path_)) {}

void SegmentFrontier::keep_border(const PointLabels& labels) {
  auto border = std::make_unique<tiling::ScratchFile>(path_.string() + "_border");
  std::vector<std::uint32_t> kept;
  for_each_block([&](std::span<const std::uint32_t> words) {
    kept.clear();
    for (std::size_t i = 0; i < words.size() / stride_; ++i) {
      const FrontierPoint p = point(words, i);
      const std::uint32_t own = labels[p.id];
      const auto same = [&](std::uint32_t neighbour) { return labels[neighbour] == own; };
      if (own != 0 && std::all_of(p.neighbours.begin(), p.neighbours.end(), same)) continue;
      const std::span<const std::uint32_t> record = words.subspan(i * stride_, stride_);
      kept.insert(kept.end(), record.begin(), record.end());
    }
    border->append(std::as_bytes(std::span(kept)));
  });
  file_ = std::move(border);
}

void SegmentFrontier::append(std::span<const std::uint32_t> words) {
  const std::lock_guard lock(mutex_);
  file_->append(std::as_bytes(words));
}

void SegmentFrontier::for_each_block(const std::function<void(std::span<const std::uint32_t>)>& use) const {
  std::vector<std::uint32_t> words;
  const std::uint64_t all = records();
  for (std::uint64_t first = 0; first < all; first += kBlockRecords) {
    words.resize(stride_ * static_cast<std::size_t>(std::min<std::uint64_t>(kBlockRecords, all - first)));
    file_->read_at(first * stride_ * sizeof(std::uint32_t), std::as_writable_bytes(std::span(words)));
    use(words);
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
