#pragma once
/// @file --config FILE: options from a TOML or INI file.

#include <string>
#include <vector>

namespace arris::tools {

/// Replaces `--config FILE` (or --config=FILE) among the arguments by the options of the file: `k-min = 25` becomes
/// `--k-min=25`, `overwrite = true` becomes `--overwrite`. Keys in a section named like the verb count as well, other
/// sections do not. An option that the command line gives itself is not taken from the file. Unknown keys fail later,
/// like unknown options. Throws ConfigError.
std::vector<std::string> expand_config(const std::vector<std::string>& arguments);

}  // namespace arris::tools
