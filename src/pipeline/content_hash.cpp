#include "pipeline/content_hash.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <xxhash.h>

#include <memory>
#include <vector>

#include "core/file_descriptor.h"

namespace arris::pipeline {

std::string content_hash(const std::filesystem::path& path) {
  const FileDescriptor file = FileDescriptor::open(path, O_RDONLY);
  const std::unique_ptr<XXH3_state_t, decltype(&XXH3_freeState)> state(XXH3_createState(), &XXH3_freeState);
  XXH3_64bits_reset(state.get());
  std::vector<std::byte> block(1024 * 1024);
  while (const std::size_t bytes = file.read_some(block)) XXH3_64bits_update(state.get(), block.data(), bytes);
  return fmt::format("{:016x}", XXH3_64bits_digest(state.get()));
}

}  // namespace arris::pipeline
