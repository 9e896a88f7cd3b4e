#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <unordered_map>
#include <unordered_set>

#include "core/error.h"
#include "core/text.h"
#include "io/ply_record.h"
#include "io/record_readers.h"

namespace arris::io {
namespace {

struct Alias {
  const char* common;
  std::array<const char*, 5> others;
};

/// Names under which programs export the fields of LAS points to PLY; the first that is there is taken.
constexpr std::array<Alias, 16> kAliases{{
    {"intensity", {"Intensity", "scalar_Intensity", "scalar_intensity", "reflectance", "scalar_reflectance"}},
    {"return_number", {"scalar_Return_Number", "scalar_ReturnNumber", "return_num"}},
    {"number_of_returns", {"scalar_Number_Of_Returns", "scalar_NumberOfReturns"}},
    {"classification", {"Classification", "scalar_Classification", "scalar_classification"}},
    {"classification_flags", {"scalar_ClassFlags", "ClassFlags"}},
    {"scanner_channel", {"scalar_ScannerChannel", "scalar_Scanner_Channel", "ScanChannel"}},
    {"scan_direction_flag", {"scalar_ScanDirectionFlag", "scalar_Scan_Direction", "ScanDirectionFlag"}},
    {"edge_of_flight_line", {"scalar_EdgeOfFlightLine", "EdgeOfFlightLine"}},
    {"scan_angle", {"scalar_ScanAngle", "scalar_Scan_Angle", "scalar_ScanAngleRank", "ScanAngleRank"}},
    {"user_data", {"scalar_User_Data", "scalar_UserData", "UserData"}},
    {"point_source_id", {"scalar_Point_Source_ID", "scalar_PointSourceId", "pt_src_id", "PointSourceId"}},
    {"gps_time", {"scalar_Gps_Time", "scalar_GpsTime", "GpsTime"}},
    {"red", {"diffuse_red", "r", "Red"}},
    {"green", {"diffuse_green", "g", "Green"}},
    {"blue", {"diffuse_blue", "b", "Blue"}},
    {"nir", {"infrared", "scalar_Near_Infrared", "Infrared"}},
}};

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
    for (const Alias& alias : kAliases) {
      if (names.contains(alias.common)) continue;
      const auto first = std::find_if(alias.others.begin(), alias.others.end(),
                                      [&](const char* other) { return other != nullptr && names.contains(other); });
      if (first != alias.others.end()) common_names_.emplace(*first, alias.common);
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
