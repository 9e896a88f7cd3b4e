#include "evaluate/edge_kind.h"

#include "core/error.h"
#include "core/text.h"

namespace arris::evaluate {

namespace {

constexpr std::array<std::string_view, kEdgeKinds> kNames{"boundary",     "convex",     "concave",
                                                          "rim_boundary", "rim_convex", "rim_concave"};

KindMask parse_word(std::string_view word) {
  if (word == "all") return kEveryKind;
  if (word == "folds") return kFoldKinds;
  if (word == "boundaries") return kBoundaryKinds;
  if (const auto kind = edge_kind(word)) return mask(*kind);
  throw ConfigError(
      "unknown kind of truth edge \"" + printable(word) +
      "\"; use all, folds, boundaries, boundary, convex, concave, rim_boundary, rim_convex or rim_concave");
}

}  // namespace

std::string_view name(EdgeKind kind) {
  return kNames[static_cast<std::size_t>(kind)];
}

std::optional<EdgeKind> edge_kind(std::string_view word) {
  for (const EdgeKind kind : kAllEdgeKinds) {
    if (name(kind) == word) return kind;
  }
  return std::nullopt;
}

KindMask parse_kinds(std::string_view text) {
  KindMask result = 0;
  while (true) {
    const std::size_t comma = text.find(',');
    result = static_cast<KindMask>(result | parse_word(text.substr(0, comma)));
    if (comma == std::string_view::npos) return result;
    text.remove_prefix(comma + 1);
  }
}

}  // namespace arris::evaluate
