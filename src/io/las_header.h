#pragma once
/// @file Reading the LAS header alone; see las_file.h for the whole structure.

#include <vector>

#include "io/input_file.h"
#include "io/las_file.h"

namespace arris::io {

/// Reads and checks the header. Throws InputError; lesser faults are added to `problems`.
LasHeader read_las_header(const InputFile& file, std::vector<Problem>& problems);

/// Throws the InputError that explains what to do with a LAZ file.
/// @param byte  what shows that it is one.
[[noreturn]] void refuse_compressed(const InputFile& file, std::uint64_t byte);

}  // namespace arris::io
