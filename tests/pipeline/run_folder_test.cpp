#include "pipeline/run_folder.h"

#include <gtest/gtest.h>

#include <fstream>

#include "core/error.h"
#include "support/temp_folder.h"

namespace arris::pipeline {
namespace {

TEST(RunFolder, LeavesNothingBehind) {
  const test::TempFolder parent;
  {
    const RunFolder a(parent.path());
    const RunFolder b(parent.path());
    EXPECT_NE(a.path(), b.path());
    std::ofstream(a.path() / "file") << "x";
    EXPECT_EQ(std::filesystem::status(a.path()).permissions(), std::filesystem::perms::owner_all);
  }
  EXPECT_TRUE(std::filesystem::is_empty(parent.path()));
}

TEST(RunFolder, MissingParent_IsAnIoError) {
  EXPECT_THROW(RunFolder("/no/such/folder"), IoError);
}

TEST(TempSpace, OfTheTempFolder_IsPositive) {
  EXPECT_GT(temp_space(std::filesystem::temp_directory_path()).free_bytes, 0U);
  EXPECT_THROW(temp_space("/no/such/folder"), IoError);
}

}  // namespace
}  // namespace arris::pipeline
