#pragma once
/// @file Progress as the library reports it; how it is shown is up to the host.

#include <cstdint>
#include <string_view>

namespace arris {

/// Receives progress. update() may be called from any thread, many times a second.
class ProgressSink {
 public:
  virtual ~ProgressSink() = default;
  /// A new phase begins; `total_points` is the work in it (0 if unknown).
  virtual void phase(std::string_view name, std::uint64_t total_points) = 0;
  /// `done_points` more points are done.
  virtual void advance(std::uint64_t done_points) = 0;
  /// Something the user should know; `code` is a stable identifier, `text` one printable line.
  virtual void warning(std::string_view code, std::string_view text) = 0;
  virtual void note(std::string_view text) = 0;
};

}  // namespace arris
