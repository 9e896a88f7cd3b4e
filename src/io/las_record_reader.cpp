#include <fmt/format.h>

#include <unordered_map>
#include <unordered_set>

#include "core/text.h"
#include "io/bytes.h"
#include "io/las_extra_bytes.h"
#include "io/las_fields.h"
#include "io/las_file.h"
#include "io/las_layout.h"
#include "io/record_readers.h"

namespace arris::io {
namespace {

class LasRecordReader final : public RecordReader {
 public:
  LasRecordReader(const InputFile& file, const SourceInfo& info) : scale_(info.scale), offset_(info.offset) {
    const LasFile las = read_las_file(file, info.tolerance);
    for (const char* axis : {"x", "y", "z"}) columns_.push_back({axis, axis, ScalarType::kFloat64});
    fields_ = las_fields(las.header.point_format);
    for (const LasField& field : fields_)
      columns_.push_back({std::string(field.name), std::string(field.name), field.type});
    for (const RecordColumn& column : columns_) taken_.insert(column.name);
    const ExtraBytes extra = read_extra_bytes(file, las);
    for (const ExtraAttribute& attribute : extra.attributes) add_extra(attribute);
    if (kLasPointLayouts[las.header.point_format].waveform != 0) losses_.emplace_back("waveforms");
    if (undocumented_ > 0 || extra.present_bytes > extra.described_bytes) {
      losses_.push_back(fmt::format("{} undocumented extra bytes per point",
                                    undocumented_ + extra.present_bytes - extra.described_bytes));
    }
  }

  void read(std::span<const std::byte> record, std::span<double> values) override {
    std::size_t at = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      values[at++] = las_world(scale_[axis], offset_[axis], load<std::int32_t>(record.data() + 4 * axis));
    }
    for (const LasField& field : fields_) values[at++] = load_field(field, record.data());
    for (const Extra& extra : extras_) {
      const double stored = load_scalar(extra.stored, record.data() + extra.offset);
      values[at++] = extra.scaled ? stored * extra.scale + extra.shift : stored;
    }
  }

 private:
  struct Extra {
    ScalarType stored;
    std::size_t offset;
    bool scaled;
    double scale;
    double shift;
  };

  void add_extra(const ExtraAttribute& attribute) {
    if (attribute.type == 0) {
      undocumented_ += attribute.size_bytes;
      return;
    }
    const ScalarType stored = attribute.part_type();
    // Doubles stand for 64-bit integers too: PLY has none.
    const ScalarType plain = size_bytes(stored) == 8 ? ScalarType::kFloat64 : stored;
    for (std::size_t i = 0; i < attribute.parts(); ++i) {
      const bool scaled = attribute.scale[i] != 1.0 || attribute.shift[i] != 0.0;
      extras_.push_back(
          {stored, attribute.offset + i * size_bytes(stored), scaled, attribute.scale[i], attribute.shift[i]});
      std::string name = attribute.parts() == 1 ? attribute.name : fmt::format("{}_{}", attribute.name, i);
      columns_.push_back({unique_name(name), name, scaled ? ScalarType::kFloat64 : plain});
    }
  }

  /// Extra bytes may be named like a field of the format, or like each other, thousands of times.
  std::string unique_name(const std::string& name) {
    if (taken_.insert(name).second) return name;
    for (int& n = last_number_.try_emplace(name, 1).first->second;;) {
      std::string unique = fmt::format("{}_{}", name, ++n);
      if (taken_.insert(unique).second) return unique;
    }
  }

  std::unordered_set<std::string> taken_;
  std::unordered_map<std::string, int> last_number_;  ///< By the name that it was appended to.
  std::array<double, 3> scale_;
  std::array<double, 3> offset_;
  std::vector<LasField> fields_;
  std::vector<Extra> extras_;
  std::size_t undocumented_ = 0;
};

}  // namespace

std::unique_ptr<RecordReader> make_las_record_reader(const InputFile& file, const SourceInfo& info) {
  return std::make_unique<LasRecordReader>(file, info);
}

}  // namespace arris::io
