#include "io/attribute_reader.h"

#include <array>
#include <optional>
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

}  // namespace

struct AttributeReader::Impl {
  struct Field {
    std::size_t offset;
    ScalarType type;
  };
  /// A field of the point format, possibly a part of a byte, or an extra attribute.
  using LasValue = std::variant<LasField, Field>;
  std::vector<std::optional<LasValue>> las;               ///< Per name, LAS only.
  std::vector<std::unique_ptr<PlyRecordWalker>> walkers;  ///< Per name, PLY only; null if absent.

  void open_las(const InputFile& file, const std::vector<std::string>& names) {
    const LasFile structure = read_las_file(file);
    const ExtraBytes extra = read_extra_bytes(file, structure);
    for (const std::string& name : names) {
      std::optional<LasValue> field;
      for (const LasField& known : las_fields(structure.header.point_format)) {
        if (known.name == name) field = known;
      }
      for (const ExtraAttribute& attribute : extra.attributes) {
        if (attribute.name == name && is_scalar_type(attribute.type))
          field = Field{attribute.offset, attribute.part_type()};
      }
      las.push_back(field);
    }
  }

  void open_ply(const InputFile& file, const std::vector<std::string>& names) {
    const PlyHeader header = read_ply_header(file);
    for (const std::string& name : names) {
      int property = header.vertices().find(name);
      if (property < 0) property = header.vertices().find("scalar_" + name);
      if (property < 0) property = find_ply_field(header.vertices(), name);
      walkers.push_back(property < 0 ? nullptr
                                     : std::make_unique<PlyRecordWalker>(header.format, header.vertices(),
                                                                         std::vector<int>{property}));
    }
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
  return impl_->las.empty() ? impl_->walkers.at(index) != nullptr : impl_->las.at(index).has_value();
}

void AttributeReader::read(const PointBatch& batch, std::size_t index, std::vector<double>& values) {
  values.resize(batch.count);
  for (std::size_t i = 0; i < batch.count; ++i) {
    const std::span<const std::byte> record(batch.records.data() + batch.record_begin[i],
                                            batch.record_begin[i + 1] - batch.record_begin[i]);
    if (!impl_->las.empty()) {
      const Impl::LasValue& value = *impl_->las[index];
      if (const auto* field = std::get_if<LasField>(&value)) {
        values[i] = load_field(*field, record.data());
      } else {
        const auto& extra = std::get<Impl::Field>(value);
        values[i] = load_scalar(extra.type, record.data() + extra.offset);
      }
      continue;
    }
    PlyRecordWalker& walker = *impl_->walkers[index];
    if (walker.walk(record, true) != PlyRecordWalker::Result::kDone)
      throw InputError("a PLY record changed while it was read");
    values[i] = walker.value(0);
  }
}

}  // namespace arris::io
