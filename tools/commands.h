#pragma once
/// @file One function per verb: declares its options and what it runs.

#include "session.h"

namespace CLI {
class App;
}

namespace arris::tools {

void add_info(CLI::App& app, Session& session);
void add_plan(CLI::App& app, Session& session);
void add_extract(CLI::App& app, Session& session);
void add_segment(CLI::App& app, Session& session);
void add_supervoxel(CLI::App& app, Session& session);
void add_synth(CLI::App& app, Session& session);
void add_evaluate(CLI::App& app, Session& session);

}  // namespace arris::tools
