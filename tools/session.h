#pragma once
/// @file What the verbs of the command line share.

#include <functional>

#include "core/cancel.h"

namespace arris::tools {

/// Filled while the command line is parsed; the chosen verb sets run().
struct Session {
  CancelToken cancel;
  std::function<int()> run;  ///< Does the work and returns the exit code; throws the errors of core/error.h.
};

}  // namespace arris::tools
