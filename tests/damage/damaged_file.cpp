#include "damaged_file.h"

namespace arris::test {

const DamagedFiles& damaged_files() {
  static const DamagedFiles kAll = [] {
    DamagedFiles all;
    for (const auto family :
         {las_count_cases, las_size_cases, las_offset_cases, las_record_cases, las_extra_bytes_cases, las_crs_cases,
          las_coordinate_cases, las_identity_cases, las_truncation_cases, ply_header_cases, ply_header_bomb_cases,
          ply_count_cases, ply_list_cases, ply_ascii_cases, ply_truncation_cases, mutated_cases}) {
      for (DamagedFile& file : family()) all.push_back(std::move(file));
    }
    return all;
  }();
  return kAll;
}

}  // namespace arris::test
