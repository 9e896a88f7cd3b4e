#include "config_file.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <optional>

#include "core/error.h"
#include "core/text.h"

namespace arris::tools {
namespace {

/// Long options that users write short.
bool given(const std::vector<std::string>& arguments, const std::string& key) {
  const std::string option = "--" + key;
  const std::string brief = key == "output" ? "-o" : key == "quiet" ? "-q" : key == "verbose" ? "-v" : option;
  return std::any_of(arguments.begin(), arguments.end(), [&](const std::string& argument) {
    return argument == option || argument.starts_with(option + "=") || argument == brief;
  });
}

std::vector<CLI::ConfigItem> read_items(const std::string& path) {
  try {
    return CLI::ConfigTOML().from_file(path);
  } catch (const CLI::Error& error) {
    throw ConfigError(fmt::format("--config {}: {}", printable(path), printable(error.what())));
  }
}

}  // namespace

std::vector<std::string> expand_config(const std::vector<std::string>& arguments) {
  std::vector<std::string> expanded;
  std::optional<std::string> path;
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    if (arguments[i] == "--config") {
      if (i + 1 == arguments.size()) throw ConfigError("--config needs a file");
      path = arguments[++i];
    } else if (arguments[i].starts_with("--config=")) {
      path = arguments[i].substr(9);
    } else {
      expanded.push_back(arguments[i]);
    }
  }
  if (!path) return arguments;
  const std::vector<std::string> typed = expanded;
  for (const CLI::ConfigItem& item : read_items(*path)) {
    const bool of_verb = item.parents.size() == 1 && !typed.empty() && item.parents[0] == typed[0];
    if (item.name == "++" || item.name == "--" || !(item.parents.empty() || of_verb) || given(typed, item.name))
      continue;
    if (item.inputs.size() == 1 && item.inputs[0] == "true") {
      expanded.push_back("--" + item.name);
    } else if (item.inputs.size() != 1 || item.inputs[0] != "false") {
      for (const std::string& value : item.inputs) expanded.push_back("--" + item.name + "=" + value);
    }
  }
  return expanded;
}

}  // namespace arris::tools
