#include "pipeline/run_folder.h"

#include <fmt/format.h>
#include <sys/statvfs.h>
#include <sys/vfs.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <string>

#include "core/error.h"

namespace arris::pipeline {

RunFolder::RunFolder(const std::filesystem::path& parent) {
  std::string name = (parent / "arris-XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr) {
    throw IoError(fmt::format("{}: cannot create a folder for temporary files ({}); choose another --temp-dir",
                              parent.string(), std::strerror(errno)));
  }
  path_ = name;
}

RunFolder::~RunFolder() {
  std::error_code ignored;  // Nothing sensible can be done about a leftover at this point.
  std::filesystem::remove_all(path_, ignored);
}

TempSpace temp_space(const std::filesystem::path& folder) {
  struct statvfs space {};
  struct statfs kind {};
  if (::statvfs(folder.c_str(), &space) != 0 || ::statfs(folder.c_str(), &kind) != 0) {
    throw IoError(fmt::format("{}: cannot use it for temporary files ({}); choose another --temp-dir", folder.string(),
                              std::strerror(errno)));
  }
  constexpr long kTmpfsMagic = 0x01021994;
  constexpr long kRamfsMagic = 0x858458f6L;
  return {static_cast<std::uint64_t>(space.f_bavail) * space.f_frsize,
          kind.f_type == kTmpfsMagic || kind.f_type == kRamfsMagic};
}

}  // namespace arris::pipeline
