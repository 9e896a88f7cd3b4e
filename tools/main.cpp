#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <exception>
#include <new>

#include "commands.h"
#include "config_file.h"
#include "core/error.h"
#include "core/process_memory.h"
#include "core/text.h"
#include "interrupt.h"
#include "libraries.h"

namespace {

constexpr const char* kFooter =
    "Exit codes: 0 done, 1 bad input or I/O error, 2 usage or configuration, 3 memory or disk budget cannot be met,\n"
    "130 interrupted. Run 'arris VERB --help' for the options of a verb.";

int fail(const char* what, int code) {
  std::fprintf(stderr, "arris: %s\n", arris::printable(what, 1000).c_str());
  return code;
}

}  // namespace

int main(int argc, char** argv) {
  arris::configure_allocator_for_budget();
  arris::tools::Session session;
  arris::tools::install_interrupt_handler(session.cancel);

  CLI::App app("arris: contours of laser scans of any size", "arris");
  app.require_subcommand(1);
  app.footer(kFooter);
  app.set_version_flag("--version", arris::tools::version_text());
  arris::tools::add_info(app, session);
  arris::tools::add_plan(app, session);
  arris::tools::add_extract(app, session);
  arris::tools::add_segment(app, session);
  arris::tools::add_supervoxel(app, session);
  arris::tools::add_synth(app, session);
  arris::tools::add_evaluate(app, session);
  try {
    std::vector<std::string> arguments = arris::tools::expand_config({argv + 1, argv + argc});
    std::reverse(arguments.begin(), arguments.end());  // As CLI11 takes them.
    app.parse(std::move(arguments));
    return session.run();
  } catch (const CLI::Success& success) {
    return app.exit(success);  // --help and --version.
  } catch (const CLI::ParseError& error) {
    return fail((std::string(error.what()) + "; see arris --help").c_str(), 2);
  } catch (const arris::Error& error) {
    return fail(error.what(), error.exit_code());
  } catch (const std::bad_alloc&) {
    return fail("the system gave no more memory; run with a smaller --memory", 3);
  } catch (const std::exception& error) {
    return fail(error.what(), 1);
  }
}
