#pragma once
/// @file The folder of a run's temporary files.

#include <cstdint>
#include <filesystem>

namespace arris::pipeline {

/// A fresh folder "arris-XXXXXX" (mode 0700) inside `parent`, removed with everything in it on destruction.
class RunFolder {
 public:
  explicit RunFolder(const std::filesystem::path& parent);
  ~RunFolder();
  RunFolder(const RunFolder&) = delete;
  RunFolder& operator=(const RunFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

struct TempSpace {
  std::uint64_t free_bytes = 0;
  bool in_memory = false;  ///< tmpfs or ramfs: its files count as memory.
};
TempSpace temp_space(const std::filesystem::path& folder);

}  // namespace arris::pipeline
