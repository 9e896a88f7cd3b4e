#pragma once
#include <string>

namespace arris::tools {

/// "arris 0.1.0 (OpenVDB 10.0.1, TBB 2021.8, ...)".
std::string version_text();

}  // namespace arris::tools
