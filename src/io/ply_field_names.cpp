#include "io/ply_field_names.h"

namespace arris::io {
namespace {

constexpr std::array<PlyFieldAlias, 16> kAliases{{
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

}  // namespace

std::span<const PlyFieldAlias> ply_field_aliases() {
  return kAliases;
}

int find_ply_field(const PlyElement& vertices, std::string_view field) {
  if (const int own = vertices.find(field); own >= 0) return own;
  for (const PlyFieldAlias& alias : kAliases) {
    if (alias.field != field) continue;
    for (const char* name : alias.names) {
      const int other = name != nullptr ? vertices.find(name) : -1;
      if (other >= 0) return other;
    }
  }
  return -1;
}

}  // namespace arris::io
