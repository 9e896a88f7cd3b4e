#include "pipeline/point_selection.h"

#include <fmt/format.h>

#include <string>

#include "core/error.h"
#include "core/text.h"

namespace arris::pipeline {
namespace {

std::string list(const std::bitset<256>& classes) {
  std::string text;
  for (std::size_t i = 0; i < classes.size(); ++i) {
    if (classes[i]) text += fmt::format("{}{}", text.empty() ? "" : ",", i);
  }
  return text;
}

}  // namespace

void refuse_missing_classes(const RunRequest& request, const tiling::Survey& survey) {
  if (request.exclusion.only_classes.none() || survey.points() > 0 || survey.dropped_excluded == 0) return;
  throw InputError(
      fmt::format("none of the {} points is of class {} and takes part; see the classes that there are with arris info",
                  grouped(survey.points_in), list(request.exclusion.only_classes)));
}

}  // namespace arris::pipeline
