#include <dlfcn.h>
#include <fmt/format.h>

#include <atomic>
#include <future>

#include "core/error.h"
#include "core/parallel.h"
#include "core/text.h"
#include "tiling/grid_backend.h"

namespace arris::tiling {
namespace {

/// Resident when OpenVDB 10.0.1 and what it needs are linked and initialized; nearly all of it are pages of files.
constexpr std::uint64_t kModuleBytes = 32'000'000;

/// The module stays loaded: what it made may live as long as the program.
const GridBackend* load_backend() {
  void* const module = dlopen(kVdbModuleFile, RTLD_NOW | RTLD_LOCAL);
  void* const function = module ? dlsym(module, kVdbModuleFunction) : nullptr;
  if (!function) {
    throw IoError(
        fmt::format("cannot load {}, a part of arris: {}; install arris again", kVdbModuleFile, printable(dlerror())));
  }
  return reinterpret_cast<const GridBackend* (*)()>(function)();
}

std::atomic<bool> begun{false};

/// The first call decides whether it is loaded on a thread of its own or when somebody waits for it.
std::shared_future<const GridBackend*> backend(std::launch policy) {
  static const std::shared_future<const GridBackend*> loading = std::async(policy, load_backend).share();
  begun = true;
  return loading;
}

}  // namespace

const GridBackend& grid_backend() {
  return *backend(std::launch::deferred).get();
}

PointGridPreparation::PointGridPreparation() {
  if (loop_threads() > 1) backend(std::launch::async);
}

PointGridPreparation::~PointGridPreparation() {
  if (begun) backend(std::launch::deferred).wait();
}

std::uint64_t point_grid_bytes_to_come() {
  if (!begun) return kModuleBytes;
  grid_backend();
  return 0;
}

}  // namespace arris::tiling
