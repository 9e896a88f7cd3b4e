#include "io/record_reader.h"

#include "io/record_readers.h"

namespace arris::io {

int RecordReader::find(std::string_view name) const {
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    if (columns_[i].name == name) return static_cast<int>(i);
  }
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    if (columns_[i].name_in_file == name) return static_cast<int>(i);
  }
  return -1;
}

std::unique_ptr<RecordReader> make_record_reader(const InputFile& file, const SourceInfo& info) {
  return info.format == Format::kLas ? make_las_record_reader(file, info) : make_ply_record_reader(file);
}

}  // namespace arris::io
