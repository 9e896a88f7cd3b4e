#include "core/text.h"

#include <gtest/gtest.h>

namespace arris {
namespace {

TEST(Printable, TerminalEscapesAndNonAscii_BecomeQuestionMarks) {
  EXPECT_EQ(printable("a\033[31m\n\xff"), "a?[31m??");
}

TEST(Printable, LongText_IsCut) {
  EXPECT_EQ(printable("abcdef", 3), "abc...");
}

TEST(Grouped, Digits_AreInThrees) {
  EXPECT_EQ(grouped(0), "0");
  EXPECT_EQ(grouped(999), "999");
  EXPECT_EQ(grouped(1000), "1 000");
  EXPECT_EQ(grouped(18446744073709551615ULL), "18 446 744 073 709 551 615");
}

TEST(BudgetText, Sizes_AreRoundedUp) {
  EXPECT_EQ(budget_text(0), "0MiB");
  EXPECT_EQ(budget_text(1), "1MiB");
  EXPECT_EQ(budget_text(256ULL << 20), "256MiB");
  EXPECT_EQ(budget_text((256ULL << 20) + 1), "257MiB");
}

TEST(HumanBytes, Sizes_UseBinaryUnits) {
  EXPECT_EQ(human_bytes(300), "300 B");
  EXPECT_EQ(human_bytes(1536), "1.5 KiB");
  EXPECT_EQ(human_bytes(512ULL << 20), "512.0 MiB");
}

}  // namespace
}  // namespace arris
