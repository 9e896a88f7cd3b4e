#include "merge/segment_frontier.h"

#include <algorithm>
#include <utility>

#include "core/parallel.h"
#include "merge/frontier_walk.h"

namespace arris::merge {
namespace {

/// Of 64 thousand words when they are appended.
constexpr std::size_t kPartsAtATime = 32;

}  // namespace

SegmentFrontier::SegmentFrontier(std::filesystem::path file, std::size_t most_neighbours)
    : stride_(4 + most_neighbours), file_(std::move(file)) {}

void SegmentFrontier::append(std::span<const std::uint32_t> words) {
  std::vector<std::byte> bytes;
  encode_frontier(words, stride_, bytes);
  Part part;
  part.bytes = static_cast<std::uint32_t>(bytes.size());
  part.records = static_cast<std::uint32_t>(words.size() / stride_);
  const std::lock_guard lock(mutex_);
  part.offset = file_.size_bytes();
  file_.append(bytes);
  records_ += part.records;
  parts_.push_back(std::move(part));
}

void SegmentFrontier::keep_border(const PointLabels& labels, std::uint64_t most_bytes) {
  std::uint64_t kept_bytes = 0;
  bool keeps = true;
  std::vector<FrontierBlock> borders(std::min(kPartsAtATime, parts_.size()));
  for (std::size_t first = 0; first < parts_.size(); first += borders.size()) {
    const std::size_t count = std::min(borders.size(), parts_.size() - first);
    parallel_for_chunks(
        count, 1, [&](std::size_t i, std::size_t) { borders[i] = drop_interior(labels, parts_[first + i], keeps); });
    for (std::size_t i = 0; i < count; ++i) {
      Part& part = parts_[first + i];
      const auto dropped = static_cast<std::uint64_t>(std::count(part.dropped.begin(), part.dropped.end(), true));
      if (dropped == 0) part.dropped = {};
      records_ -= dropped;
      keeps = keeps && kept_bytes + borders[i].size_bytes() <= most_bytes;
      if (!keeps) continue;
      kept_bytes += borders[i].size_bytes();
      kept_.push_back(std::move(borders[i]));
    }
  }
}

FrontierBlock SegmentFrontier::drop_interior(const PointLabels& labels, Part& part, bool keeps) const {
  FrontierBlock block, border;
  read(part, block);
  part.dropped.resize(block.size());
  for_each_point(block, labels, [&](std::size_t i, const FrontierPoint& p) {
    const std::uint32_t own = labels[p.id];
    const auto same = [&](std::uint32_t neighbour) { return labels[neighbour] == own; };
    part.dropped[i] = own != 0 && std::all_of(p.neighbours.begin(), p.neighbours.end(), same);
    if (!part.dropped[i] && keeps) border.add(p);
  });
  border.shrink_to_fit();
  return border;
}

void SegmentFrontier::read(const Part& part, FrontierBlock& block) const {
  PageVector<std::byte> bytes(part.bytes);
  file_.read_at(part.offset, bytes);
  if (!decode_frontier(bytes, part.records, part.dropped, block)) file_.throw_damaged();
}

void SegmentFrontier::for_each_blocks(const std::function<void(std::span<const FrontierBlock>)>& use) const {
  for (std::size_t first = 0; first < kept_.size(); first += kPartsAtATime)
    use(std::span(kept_).subspan(first, std::min(kPartsAtATime, kept_.size() - first)));
  std::vector<FrontierBlock> blocks(std::min(kPartsAtATime, parts_.size() - kept_.size()));
  for (std::size_t first = kept_.size(); first < parts_.size(); first += blocks.size()) {
    const std::size_t count = std::min(blocks.size(), parts_.size() - first);
    parallel_for_chunks(count, 1, [&](std::size_t begin, std::size_t) { read(parts_[first + begin], blocks[begin]); });
    use(std::span(blocks).first(count));
  }
}

}  // namespace arris::merge
