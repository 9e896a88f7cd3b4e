#pragma once
/// @file The readers behind make_record_reader().

#include "io/record_reader.h"

namespace arris::io {

std::unique_ptr<RecordReader> make_las_record_reader(const InputFile& file, const SourceInfo& info);
std::unique_ptr<RecordReader> make_ply_record_reader(const InputFile& file);

}  // namespace arris::io
