#include "evaluate/edge_kind.h"

#include <gtest/gtest.h>

#include "core/error.h"

namespace arris::evaluate {
namespace {

TEST(EdgeKind_Names, EveryKind_IsFoundByItsName) {
  for (const EdgeKind kind : kAllEdgeKinds) {
    EXPECT_EQ(edge_kind(name(kind)), kind);
    EXPECT_EQ(parse_kinds(name(kind)), mask(kind));
  }
  EXPECT_EQ(edge_kind("ridge"), std::nullopt);
}

TEST(EdgeKind_ParseKinds, GroupsAndLists_Combine) {
  EXPECT_EQ(parse_kinds("all"), kEveryKind);
  EXPECT_EQ(parse_kinds("folds,boundaries"), kEveryKind);
  EXPECT_EQ(parse_kinds("folds,rim_boundary"), kFoldKinds | mask(EdgeKind::kRimBoundary));
}

TEST(EdgeKind_ParseKinds, UnknownOrEmptyWords_AreRefusedByName) {
  EXPECT_THROW(parse_kinds(""), ConfigError);
  EXPECT_THROW(parse_kinds("folds,"), ConfigError);
  try {
    parse_kinds("folds,rigde");
    FAIL();
  } catch (const ConfigError& error) {
    EXPECT_NE(std::string(error.what()).find("rigde"), std::string::npos);
  }
}

}  // namespace
}  // namespace arris::evaluate
