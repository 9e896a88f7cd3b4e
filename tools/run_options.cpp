#include "run_options.h"

#include <CLI/CLI.hpp>
#include <charconv>

#include "core/error.h"
#include "core/text.h"
#include "core/units.h"

namespace arris::tools {
namespace {

std::uint64_t parse_tile_points(const std::string& text) {
  if (text == "none") return 0;
  std::uint64_t points = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), points);
  if (error != std::errc{} || end != text.data() + text.size() || points == 0) {
    throw ConfigError("--tile-points '" + printable(text, 40) + "' is neither a positive number nor 'none'");
  }
  return points;
}

io::PointExclusion parse_exclusion(const RunOptions& o) {
  io::PointExclusion exclusion;
  for (const std::string& name : o.exclude) {
    const unsigned bit = name == "synthetic" ? 1U : name == "key-point" ? 2U : name == "withheld" ? 4U : 8U;
    exclusion.flags = static_cast<std::uint8_t>(exclusion.flags | bit);
  }
  for (const int label : o.exclude_classes) exclusion.classes.set(static_cast<std::size_t>(label));
  for (const int label : o.only_classes) exclusion.only_classes.set(static_cast<std::size_t>(label));
  if (exclusion.only_classes.any() && exclusion.excluded_classes().all())
    throw ConfigError("--exclude-class takes away all that --only-class leaves");
  return exclusion;
}

}  // namespace

double length_or(const std::string& text, double otherwise) {
  return text.empty() ? otherwise : parse_length(text);
}

void add_run_options(CLI::App& verb, RunOptions& o) {
  verb.add_option("inputs", o.inputs, "LAS and PLY files, or folders of them; one input, in this order")->required();
  add_tolerance_options(verb, o.tolerance);
  verb.add_option("--exclude", o.exclude,
                  "LAS points with these flags take no part: withheld, overlap, synthetic, key-point")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->check(CLI::IsMember({"withheld", "overlap", "synthetic", "key-point"}));
  verb.add_option("--exclude-class", o.exclude_classes, "LAS points of these classes take no part (7,18 is noise)")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->check(CLI::Range(0, 255));
  verb.add_option("--only-class", o.only_classes,
                  "Only points of these classes take part (6 is buildings, 2 is ground); PLY by its classification")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->check(CLI::Range(0, 255));
  verb.add_option("--memory", o.memory,
                  "Bound on the memory of the whole process: 8GiB, 512MiB, 60% (default 75% of what there is)");
  verb.add_option("--threads", o.threads, "Threads; 0 for all")->capture_default_str();
  verb.add_option("--temp-dir", o.temp_dir, "Folder for temporary files (default $TMPDIR or /tmp)");
  verb.add_option("--max-temp", o.max_temp, "Bound on temporary files: 100GiB, 50% of what is free");
  verb.add_option("--tile-points", o.tile_points, "For tests and tuning: most points per tile, or none")
      ->capture_default_str();
  verb.add_option("--lattice", o.lattice, "Step of the analysis lattice (length; default: the LAS scale, else 0.0001)");
  verb.add_option("--config",
                  "Read options from a TOML or INI file; those on the command line win");  // See config_file.h.
  add_display_options(verb, o.display);
}

void fill_run_request(RunOptions& o, pipeline::RunRequest& request) {
  request.inputs = o.inputs;
  request.tolerance = o.tolerance.tolerance();
  request.exclusion = parse_exclusion(o);
  request.memory_bytes = resolve_memory(o.memory, o.memory_why);
  request.threads = resolve_threads(o.threads);
  request.temp_dir = o.temp_dir.empty() ? std::filesystem::temp_directory_path() : std::filesystem::path(o.temp_dir);
  if (!o.max_temp.empty()) {
    request.max_temp_bytes = parse_size_bytes(o.max_temp, std::filesystem::space(request.temp_dir).available);
  }
  request.tile_points_cap = parse_tile_points(o.tile_points);
  request.lattice_step = length_or(o.lattice, 0.0);
}

}  // namespace arris::tools
