#include "tiling/grid_backend.h"

/// What `arris` asks the module for (kVdbModuleFunction).
extern "C" __attribute__((visibility("default"))) const arris::tiling::GridBackend* arris_vdb_backend();

const arris::tiling::GridBackend* arris_vdb_backend() {
  return &arris::tiling::vdb_backend();
}
