#pragma once
/// @file Which thread of a loop does which chunks.

#include <algorithm>
#include <cstddef>
#include <mutex>
#include <optional>
#include <vector>

namespace arris {

/// Chunks 0 .. count - 1 in as many parts as threads may share them, one after the other: in loops over the same array
/// a thread meets the same chunks again, whose memory is in its cache. Who is through with its own part takes from the
/// ends of the others, where their threads come last. Thread-safe.
class ChunkParts {
 public:
  /// @param parts  >= 1.
  ChunkParts(std::size_t count, std::size_t parts) : parts_(parts) {
    for (std::size_t i = 0; i < parts; ++i) {
      parts_[i].begin = count / parts * i + std::min(i, count % parts);
      parts_[i].end = count / parts * (i + 1) + std::min(i + 1, count % parts);
    }
  }

  /// A chunk that nobody has taken; none if all are. @param own  < parts.
  std::optional<std::size_t> take(std::size_t own) {
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      Part& part = parts_[(own + i) % parts_.size()];
      const std::lock_guard lock(part.mutex);
      if (part.begin < part.end) return i == 0 ? part.begin++ : --part.end;
    }
    return std::nullopt;
  }

 private:
  struct alignas(64) Part {  // A line of the cache: each part has its own.
    std::mutex mutex;
    std::size_t begin = 0, end = 0;
  };
  std::vector<Part> parts_;
};

}  // namespace arris
