#include "tiling/tile_store.h"

#include <fmt/format.h>

#include <istream>
#include <map>
#include <mutex>
#include <new>
#include <optional>
#include <ostream>
#include <system_error>

#include "core/error.h"
#include "core/text.h"
#include "tiling/checked_file.h"
#include "tiling/fold_sorted.h"
#include "tiling/manifest.h"
#include "tiling/point_grid.h"
#include "tiling/spool.h"

namespace arris::tiling {
namespace {

// Measured peaks of surface scans are 48 and 41 bytes per point in tiles of a million points; scattered points cost up
// to 8 more. The fixed part is stream and page buffers.
constexpr double kBuildBytesPerPoint = 56.0;
constexpr double kLoadBytesPerPoint = 50.0;
constexpr double kFixedBytes = 8.0 * 1024 * 1024;
// Bytes of a tile file per point, for the message of a full disk only.
constexpr std::uint64_t kDiskBytesPerPoint = 16;

std::string text_of(const LatticeBox& box) {
  return fmt::format("[{}, {}) [{}, {}) [{}, {})", box.min[0], box.max[0], box.min[1], box.max[1], box.min[2],
                     box.max[2]);
}

}  // namespace

struct TileStore::Impl {
  Impl(std::filesystem::path where, const Lattice& run_lattice, const TilePlan& plan, std::string hash)
      : folder(std::move(where)),
        lattice(run_lattice),
        tiles(plan.tiles),
        parameters_hash(std::move(hash)),
        manifest(folder, run_lattice, plan.tiles.size(), parameters_hash) {}

  std::filesystem::path tile_path(std::size_t tile) const { return folder / fmt::format("{}.vdb", tile); }

  std::map<std::string, std::string> metadata(std::size_t tile) const {
    return {{"arris_core", text_of(tiles[tile].core)},
            {"arris_covered", text_of(tiles[tile].covered)},
            {"arris_lattice_step", fmt::format("{}", lattice.step)},
            {"arris_lattice_origin", fmt::format("{} {} {}", lattice.origin[0], lattice.origin[1], lattice.origin[2])},
            {"arris_parameters_hash", printable(parameters_hash)}};
  }

  std::optional<ManifestEntry> entry(std::size_t tile) const {
    const std::lock_guard lock(mutex);
    const auto found = built.find(tile);
    return found == built.end() ? std::nullopt : std::optional(found->second);
  }

  SortedPoints read(std::size_t tile, const std::function<bool(const LatticeBox&)>& near = {}) const;

  TilePoints folded(std::size_t tile, SortedPoints&& points) const {
    TilePoints out;
    out.core = tiles.at(tile).core;
    out.covered = tiles.at(tile).covered;
    fold_sorted(std::move(points.positions), std::move(points.ids), out);
    return out;
  }

  const std::filesystem::path folder;
  const Lattice lattice;
  const std::vector<PlannedTile> tiles;
  const std::string parameters_hash;
  mutable std::mutex mutex;  // Guards what follows.
  Manifest manifest;
  std::map<std::size_t, ManifestEntry> built;
};

TileStore::TileStore(std::filesystem::path folder, const Lattice& lattice, const TilePlan& plan,
                     std::string parameters_hash)
    : impl_(std::make_unique<Impl>(std::move(folder), lattice, plan, std::move(parameters_hash))) {}
TileStore::~TileStore() = default;

TilePoints TileStore::build(std::size_t tile) {
  const std::filesystem::path spool = spool_path(impl_->folder, tile);
  LatticePoints positions;
  PointIds ids;
  read_spool(spool, positions, ids);
  const std::uint64_t points = positions.size();
  PointGrid grid(positions, ids, impl_->metadata(tile));
  LatticePoints().swap(positions);
  PointIds().swap(ids);

  HashingSink sink(impl_->tile_path(tile), points * kDiskBytesPerPoint);
  std::ostream stream(&sink);
  stream.exceptions(std::ios::badbit | std::ios::failbit);
  try {
    grid.write(stream);
    stream.flush();
  } catch (const Error&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    throw IoError(fmt::format("{}: could not be written: {}", printable(impl_->tile_path(tile).string()),
                              printable(error.what())));
  }
  sink.commit();

  const ManifestEntry entry{tile, points, sink.size_bytes(), sink.digest()};
  {
    const std::lock_guard lock(impl_->mutex);
    impl_->manifest.append(entry, impl_->tiles.at(tile));
    impl_->built[tile] = entry;
  }
  std::error_code ignored;  // A spool that stays costs space, nothing else.
  std::filesystem::remove(spool, ignored);
  return impl_->folded(tile, std::move(grid).take_points());
}

SortedPoints TileStore::Impl::read(std::size_t tile, const std::function<bool(const LatticeBox&)>& near) const {
  const std::filesystem::path path = tile_path(tile);
  const std::optional<ManifestEntry> expected = entry(tile);
  if (!expected) throw IoError(fmt::format("{}: tile {} has not been built", printable(path.string()), tile));
  const auto damaged = [&](const std::string& what) {
    return IoError(fmt::format(
        "{}: {}: its bytes are not those that were written; check the disk, then run again with --no-resume",
        printable(path.string()), what));
  };
  FileReader file(path);
  if (file.size_bytes() != expected->size_bytes) {
    throw damaged(fmt::format("{} bytes instead of {}", file.size_bytes(), expected->size_bytes));
  }
  // OpenVDB trusts what it reads (sizes, counts), so nothing unverified may reach it.
  HashingSource check(file);
  check.drain();
  if (check.hasher().digest() != expected->xxh3) throw damaged("wrong checksum");
  file.rewind();
  HashingSource source(file);
  std::istream stream(&source);
  stream.exceptions(std::ios::badbit);
  SortedPoints points;
  try {
    points = read_point_grid(stream, near);
  } catch (const Error&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    throw damaged(printable(error.what()));
  }
  source.drain();
  if (source.hasher().digest() != expected->xxh3 || (!near && points.positions.size() != expected->points)) {
    throw damaged("changed while it was read");
  }
  return points;
}

TilePoints TileStore::load(std::size_t tile) const {
  return impl_->folded(tile, impl_->read(tile));
}

SortedPoints TileStore::load_core(std::size_t tile, const std::function<bool(const LatticePoint&)>& keep,
                                  const std::function<bool(const LatticeBox&)>& near) const {
  SortedPoints points = impl_->read(tile, near);
  const LatticeBox core = impl_->tiles.at(tile).core;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < points.positions.size(); ++i) {
    if (!core.contains(points.positions[i]) || !keep(points.positions[i])) continue;
    points.positions[kept] = points.positions[i];
    points.ids[kept++] = points.ids[i];
  }
  const bool few = kept < points.ids.size() / 2;
  points.positions.resize(kept);
  points.ids.resize(kept);
  if (few) {  // Many tiles' points may be kept together.
    points.positions.shrink_to_fit();
    points.ids.shrink_to_fit();
  }
  return points;
}

std::uint64_t TileStore::points(std::size_t tile) const {
  const auto entry = impl_->entry(tile);
  return entry ? entry->points : 0;
}

std::uint64_t TileStore::bytes_on_disk() const {
  const std::lock_guard lock(impl_->mutex);
  std::uint64_t sum = 0;
  for (const auto& [tile, entry] : impl_->built) sum += entry.size_bytes;
  return sum;
}

void TileStore::remove(std::size_t tile) {
  const std::lock_guard lock(impl_->mutex);
  if (impl_->built.erase(tile) == 0) return;
  std::error_code error;
  std::filesystem::remove(impl_->tile_path(tile), error);
  if (error) throw_io_error(impl_->tile_path(tile), "remove", error.value());
}

std::uint64_t build_bytes(std::uint64_t points) {
  return static_cast<std::uint64_t>(kFixedBytes + kBuildBytesPerPoint * static_cast<double>(points));
}

std::uint64_t load_bytes(std::uint64_t points) {
  return static_cast<std::uint64_t>(kFixedBytes + kLoadBytesPerPoint * static_cast<double>(points));
}

}  // namespace arris::tiling
