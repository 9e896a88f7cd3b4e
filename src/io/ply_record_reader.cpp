#include <fmt/format.h>

#include <algorithm>
#include <unordered_map>
#include <unordered_set>

#include "core/error.h"
#include "core/text.h"
#include "io/ply_field_names.h"
#include "io/ply_record.h"
#include "io/record_readers.h"

namespace arris::io {
namespace {

class PlyRecordReader final : public RecordReader {
 public:
  explicit PlyRecordReader(const InputFile& file) : header_(read_ply_header(file)) {
    find_aliases();
    const std::vector<PlyProperty>& properties = header_.vertices().properties;
    std::vector<int> wanted;
    std::string lists;
    for (std::size_t i = 0; i < properties.size(); ++i) {
      const PlyProperty& property = properties[i];
      if (property.is_list) {
        if (lists.size() < 200) lists += (lists.empty() ? "" : ", ") + printable(property.name, 40);
        continue;
      }
      columns_.push_back({common_name(property.name), property.name, property.type});
      wanted.push_back(static_cast<int>(i));
    }
    walker_ = std::make_unique<PlyRecordWalker>(header_.format, header_.vertices(), wanted);
    if (!lists.empty()) losses_.push_back("vertex lists " + lists);
  }

  void read(std::span<const std::byte> record, std::span<double> values) override {
    if (walker_->walk(record, true) != PlyRecordWalker::Result::kDone)
      throw InputError("a PLY record changed while it was read; start again when the file is complete");
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = walker_->value(i);
  }

 private:
  /// Which properties have a common name other than their own. Linear in the properties, of which there may be many.
  void find_aliases() {
    std::unordered_set<std::string_view> names;
    for (const PlyProperty& property : header_.vertices().properties) {
      if (!property.is_list) names.insert(property.name);
    }
    for (const PlyFieldAlias& alias : ply_field_aliases()) {
      if (names.contains(alias.field)) continue;
      const auto first = std::find_if(alias.names.begin(), alias.names.end(),
                                      [&](const char* other) { return other != nullptr && names.contains(other); });
      if (first != alias.names.end()) common_names_.emplace(*first, alias.field);
    }
  }

  std::string common_name(const std::string& name) const {
    const auto found = common_names_.find(name);
    return found == common_names_.end() ? name : found->second;
  }

  PlyHeader header_;
  std::unordered_map<std::string, std::string> common_names_;  ///< By the name in the file.
  std::unique_ptr<PlyRecordWalker> walker_;
};

}  // namespace

std::unique_ptr<RecordReader> make_ply_record_reader(const InputFile& file) {
  return std::make_unique<PlyRecordReader>(file);
}

}  // namespace arris::io
