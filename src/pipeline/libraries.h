#pragma once
/// @file Versions of the heavy libraries, for --version and reports.

#include <string>

namespace arris::pipeline {

/// "OpenVDB 10.0.1, TBB 2021.8, Eigen 3.4.0, xxHash 0.8.1".
std::string library_versions();

}  // namespace arris::pipeline
