#include "pipeline/contour_row.h"

namespace arris::pipeline {

std::vector<ColumnSpec> contour_columns(bool refined) {
  std::vector<ColumnSpec> columns{{"EdgeClass", ColumnType::kUint8, "1 boundary 2 weak 4 fold 8 16 32"},
                                  {"EdgeScore", ColumnType::kFloat32, "0..1"},
                                  {"FoldAngle", ColumnType::kFloat32, "interior angle, degrees"}};
  if (refined) {
    columns.push_back({"EdgeX", ColumnType::kFloat32, "from point to refined edge"});
    columns.push_back({"EdgeY", ColumnType::kFloat32, "from point to refined edge"});
    columns.push_back({"EdgeZ", ColumnType::kFloat32, "from point to refined edge"});
  }
  return columns;
}

void append_contour_row(std::vector<std::byte>& rows, const ContourRecord& record, bool refined) {
  append_value(rows, record.classes);
  append_value(rows, record.score);
  append_value(rows, record.fold_angle_deg);
  if (!refined) return;
  for (const float offset : record.to_edge) append_value(rows, offset);
}

}  // namespace arris::pipeline
