#include "io/attribute_reader.h"

#include <array>
#include <variant>

#include "core/error.h"
#include "io/bytes.h"
#include "io/input_file.h"
#include "io/las_extra_bytes.h"
#include "io/las_fields.h"
#include "io/las_file.h"
#include "io/ply_field_names.h"
#include "io/ply_header.h"
#include "io/ply_record.h"

namespace arris::io {
namespace {

constexpr bool is_scalar_type(std::uint8_t type) {
  return type >= 1 && type <= 10;
}

/// A value at the same place of every record.
struct Fixed {
  LasField field;  ///< Its name is not used.
  bool big_endian = false;
};
/// Where a value is: nowhere, there, or to be found in each record.
using Place = std::variant<std::monostate, Fixed, std::unique_ptr<PlyRecordWalker>>;

template <typename T, std::endian kOrder>
void load_column(const PointBatch& batch, const LasField& field, double* values) {
  const std::byte* const at = batch.records.data() + field.offset;
  for (std::size_t i = 0; i < batch.count; ++i)
    values[i] = static_cast<double>(load<T, kOrder>(at + batch.record_begin[i])) * field.unit;
}

void load_bits(const PointBatch& batch, const LasField& field, double* values) {
  const std::byte* const at = batch.records.data() + field.offset;
  for (std::size_t i = 0; i < batch.count; ++i)
    values[i] = (load<std::uint8_t>(at + batch.record_begin[i]) >> field.shift) & field.mask;
}

void load_column(const PointBatch& batch, const Fixed& fixed, double* values) {
  if (fixed.field.mask != 0) return load_bits(batch, fixed.field, values);
  with_scalar_type(fixed.field.stored, [&](auto zero) {
    if (fixed.big_endian) return load_column<decltype(zero), std::endian::big>(batch, fixed.field, values);
    load_column<decltype(zero), std::endian::little>(batch, fixed.field, values);
  });
}

void walk_column(const PointBatch& batch, PlyRecordWalker& walker, double* values) {
  for (std::size_t i = 0; i < batch.count; ++i) {
    const std::span<const std::byte> record(batch.records.data() + batch.record_begin[i],
                                            batch.record_begin[i + 1] - batch.record_begin[i]);
    if (walker.walk(record, true) != PlyRecordWalker::Result::kDone)
      throw InputError("a PLY record changed while it was read");
    values[i] = walker.value(0);
  }
}

}  // namespace

struct AttributeReader::Impl {
  std::vector<Place> places;  ///< Per name.

  void open_las(const InputFile& file, const std::vector<std::string>& names) {
    const LasFile structure = read_las_file(file);
    const ExtraBytes extra = read_extra_bytes(file, structure);
    for (const std::string& name : names) {
      Place place;
      for (const LasField& known : las_fields(structure.header.point_format)) {
        if (known.name == name) place = Fixed{known};
      }
      for (const ExtraAttribute& attribute : extra.attributes) {
        if (attribute.name == name && is_scalar_type(attribute.type))
          place = Fixed{{"", attribute.part_type(), attribute.part_type(), attribute.offset}};
      }
      places.push_back(std::move(place));
    }
  }

  void open_ply(const InputFile& file, const std::vector<std::string>& names) {
    const PlyHeader header = read_ply_header(file);
    for (const std::string& name : names) {
      int property = header.vertices().find(name);
      if (property < 0) property = header.vertices().find("scalar_" + name);
      if (property < 0) property = find_ply_field(header.vertices(), name);
      places.push_back(property < 0 ? Place() : ply_place(header, property));
    }
  }

  static Place ply_place(const PlyHeader& header, int property) {
    const PlyElement& vertices = header.vertices();
    if (header.format == PlyFormat::kAscii || vertices.has_list())
      return std::make_unique<PlyRecordWalker>(header.format, vertices, std::vector<int>{property});
    const auto index = static_cast<std::size_t>(property);
    std::size_t offset = 0;
    for (std::size_t i = 0; i < index; ++i) offset += size_bytes(vertices.properties[i].type);
    const ScalarType type = vertices.properties[index].type;
    return Fixed{{"", type, type, offset}, header.format == PlyFormat::kBigEndian};
  }
};

AttributeReader::AttributeReader(const std::filesystem::path& path, const std::vector<std::string>& names)
    : impl_(std::make_unique<Impl>()) {
  const InputFile file(path);
  std::array<std::byte, 4> magic{};
  file.read_some(0, magic);
  const std::string_view text(reinterpret_cast<const char*>(magic.data()), magic.size());
  if (text == "LASF") {
    impl_->open_las(file, names);
  } else {
    impl_->open_ply(file, names);
  }
}

AttributeReader::~AttributeReader() = default;

bool AttributeReader::has(std::size_t index) const {
  return !std::holds_alternative<std::monostate>(impl_->places.at(index));
}

void AttributeReader::read(const PointBatch& batch, std::size_t index, std::vector<double>& values) {
  values.resize(batch.count);
  Place& place = impl_->places.at(index);
  if (const auto* fixed = std::get_if<Fixed>(&place)) {
    load_column(batch, *fixed, values.data());
  } else {
    walk_column(batch, *std::get<std::unique_ptr<PlyRecordWalker>>(place), values.data());
  }
}

}  // namespace arris::io
