#include "io/geopackage_writer.h"

#include <algorithm>
#include <optional>
#include <string>

#include "io/geopackage_geometry.h"
#include "io/geopackage_schema.h"
#include "io/output_file.h"
#include "io/sqlite_database.h"

namespace arris::io {
namespace {

constexpr std::int32_t kUndefinedCartesian = -1;
/// Numbers that the register of EPSG does not use.
constexpr std::int32_t kFirstOwn = 100000;
constexpr std::int32_t kWgs84 = 4326;

/// False if the text is a mere name, or was cut.
bool is_whole_wkt(const std::string& text) {
  int open = 0;
  bool any = false, quoted = false;
  for (const char c : text) {
    if (c == '"') quoted = !quoted;
    if (quoted) continue;
    any = any || c == '[' || c == '(';
    open += c == '[' || c == '(';
    open -= c == ']' || c == ')';
  }
  return any && open == 0 && !quoted;
}

std::int32_t add_reference_system(SqliteDatabase& database, const CrsSummary& crs) {
  const bool wkt = is_whole_wkt(crs.text);
  if (crs.epsg == kWgs84) return kWgs84;
  if (crs.epsg <= 0 && !wkt) return kUndefinedCartesian;
  const std::int32_t id = crs.epsg > 0 ? crs.epsg : kFirstOwn;
  SqliteStatement add(database, kAddReferenceSystem);
  add.bind(1, std::string_view(crs.name.empty() ? "unnamed" : crs.name));
  add.bind(2, std::int64_t{id});
  add.bind(3, std::string_view(crs.epsg > 0 ? "EPSG" : "NONE"));
  add.bind(4, std::string_view(wkt ? crs.text : "undefined"));
  add.run();
  return id;
}

}  // namespace

struct GeoPackageWriter::Impl {
  OutputFile file;
  SqliteDatabase database;
  std::int32_t srs_id = kUndefinedCartesian;
  std::optional<SqliteStatement> add_segment;
  std::optional<PolygonEnvelope> extent;

  Impl(const std::filesystem::path& path, bool overwrite, const CrsSummary& crs)
      : file(path, overwrite), database(file.partial_path()) {
    database.run("BEGIN");
    database.run(kGeoPackageSchema);
    srs_id = add_reference_system(database, crs);
    add_segment.emplace(database, kAddSegment);
  }

  void add_contents() {
    SqliteStatement contents(database, kAddContents);
    if (extent) {
      contents.bind(1, extent->min[0]);
      contents.bind(2, extent->min[1]);
      contents.bind(3, extent->max[0]);
      contents.bind(4, extent->max[1]);
    }
    contents.bind(5, std::int64_t{srs_id});
    contents.run();
    SqliteStatement column(database, kAddGeometryColumn);
    column.bind(1, std::int64_t{srs_id});
    column.run();
  }
};

GeoPackageWriter::GeoPackageWriter(const std::filesystem::path& path, bool overwrite, const CrsSummary& crs)
    : impl_(std::make_unique<Impl>(path, overwrite, crs)) {}

GeoPackageWriter::~GeoPackageWriter() = default;

void GeoPackageWriter::add(const PolygonFeature& feature) {
  SqliteStatement& row = *impl_->add_segment;
  const std::vector<std::byte> geometry = geopackage_polygon(feature, impl_->srs_id);
  row.bind(1, std::span<const std::byte>(geometry));
  row.bind(2, static_cast<std::int64_t>(feature.segment_id));
  row.bind(3, static_cast<std::int64_t>(feature.points));
  row.bind(4, feature.area);
  row.bind(5, feature.rms);
  row.bind(6, feature.inclination_deg);
  if (feature.azimuth_deg) row.bind(7, *feature.azimuth_deg);
  row.run();
  const PolygonEnvelope envelope = envelope_of(feature);
  if (!impl_->extent) impl_->extent = envelope;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    impl_->extent->min[axis] = std::min(impl_->extent->min[axis], envelope.min[axis]);
    impl_->extent->max[axis] = std::max(impl_->extent->max[axis], envelope.max[axis]);
  }
}

void GeoPackageWriter::commit() {
  impl_->add_contents();
  impl_->add_segment.reset();
  impl_->database.run("COMMIT");
  impl_->database.close();
  impl_->file.commit();
}

}  // namespace arris::io
