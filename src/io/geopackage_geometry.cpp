#include "io/geopackage_geometry.h"

#include <algorithm>

#include "io/bytes.h"

namespace arris::io {
namespace {

constexpr std::uint8_t kLittleEndian = 1;
constexpr std::uint8_t kEnvelopeXyz = 2;  ///< Bits 1 to 3 of the header's flags.
constexpr std::uint32_t kPolygonZ = 1003;

class Blob {
 public:
  template <typename T>
  void add(T value) {
    bytes_.resize(bytes_.size() + sizeof value);
    store(bytes_.data() + bytes_.size() - sizeof value, value);
  }
  void add(const PolygonRing& ring) {
    add(static_cast<std::uint32_t>(ring.size() + 1));
    for (const auto& position : ring) add(position);
    add(ring.front());
  }
  void add(const std::array<double, 3>& position) {
    for (const double c : position) add(c);
  }
  std::vector<std::byte> take() { return std::move(bytes_); }

 private:
  std::vector<std::byte> bytes_;
};

}  // namespace

PolygonEnvelope envelope_of(const PolygonFeature& feature) {
  PolygonEnvelope envelope{feature.outer.front(), feature.outer.front()};
  // Holes lie inside in the plane of the polygon, and so they do in its envelope.
  for (const auto& position : feature.outer) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      envelope.min[axis] = std::min(envelope.min[axis], position[axis]);
      envelope.max[axis] = std::max(envelope.max[axis], position[axis]);
    }
  }
  return envelope;
}

std::vector<std::byte> geopackage_polygon(const PolygonFeature& feature, std::int32_t srs_id) {
  Blob blob;
  blob.add(static_cast<std::uint8_t>('G'));
  blob.add(static_cast<std::uint8_t>('P'));
  blob.add(std::uint8_t{0});  // Version 1.
  blob.add(static_cast<std::uint8_t>(kEnvelopeXyz << 1 | kLittleEndian));
  blob.add(srs_id);
  const PolygonEnvelope envelope = envelope_of(feature);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    blob.add(envelope.min[axis]);
    blob.add(envelope.max[axis]);
  }
  blob.add(kLittleEndian);
  blob.add(kPolygonZ);
  blob.add(static_cast<std::uint32_t>(1 + feature.holes.size()));
  blob.add(feature.outer);
  for (const PolygonRing& hole : feature.holes) blob.add(hole);
  return blob.take();
}

}  // namespace arris::io
