#pragma once
/// @file Ctrl-C.

#include "core/cancel.h"

namespace arris::tools {

/// SIGINT and SIGTERM ask `cancel` to stop; a second one ends the process at once with code 130. SIGXFSZ and SIGPIPE
/// are ignored: the failing write reports the error. Call once.
void install_interrupt_handler(CancelToken& cancel);

}  // namespace arris::tools
