#pragma once
/// @file The kinds of truth edges, and sets of kinds.

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

namespace arris::evaluate {

/// Straight or curved ("rim"); a free border of a surface, or a fold towards (convex) or away from (concave) the
/// viewer.
enum class EdgeKind : std::uint8_t { kBoundary, kConvex, kConcave, kRimBoundary, kRimConvex, kRimConcave };

constexpr std::size_t kEdgeKinds = 6;
constexpr std::array<EdgeKind, kEdgeKinds> kAllEdgeKinds{EdgeKind::kBoundary,  EdgeKind::kConvex,
                                                         EdgeKind::kConcave,   EdgeKind::kRimBoundary,
                                                         EdgeKind::kRimConvex, EdgeKind::kRimConcave};

/// "boundary", "convex", "concave", "rim_boundary", "rim_convex", "rim_concave": the words of the truth file.
std::string_view name(EdgeKind kind);
std::optional<EdgeKind> edge_kind(std::string_view name);

/// A set of kinds: bit i is EdgeKind i.
using KindMask = std::uint8_t;
constexpr KindMask mask(EdgeKind kind) {
  return static_cast<KindMask>(1U << static_cast<unsigned>(kind));
}
constexpr KindMask kBoundaryKinds = mask(EdgeKind::kBoundary) | mask(EdgeKind::kRimBoundary);
constexpr KindMask kFoldKinds =
    mask(EdgeKind::kConvex) | mask(EdgeKind::kConcave) | mask(EdgeKind::kRimConvex) | mask(EdgeKind::kRimConcave);
constexpr KindMask kEveryKind = kBoundaryKinds | kFoldKinds;

/// "all", "folds", "boundaries" or names of kinds, joined by commas: "folds,rim_boundary". Throws ConfigError.
KindMask parse_kinds(std::string_view text);

}  // namespace arris::evaluate
