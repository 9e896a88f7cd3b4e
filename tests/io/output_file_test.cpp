#include "io/output_file.h"

#include <sys/resource.h>

#include <csignal>

#include "io_helpers.h"

namespace arris::test {
namespace {

namespace fs = std::filesystem;

std::size_t entries(const fs::path& folder) {
  return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

TEST(OutputFile, Commit_MakesExactBytesAppear) {
  const TempFolder folder;
  std::string expected;
  io::OutputFile file(folder / "a", false);
  for (std::size_t size : {std::size_t{0}, std::size_t{1}, std::size_t{1000}, std::size_t{1} << 20,
                           (std::size_t{1} << 20) + 1, std::size_t{3} << 20, std::size_t{9} << 20, std::size_t{17}}) {
    const std::string part(size, static_cast<char>('a' + size % 26));
    file.write(std::string_view(part));
    expected += part;
    EXPECT_EQ(file.size_bytes(), expected.size());
  }
  const std::string patch = "PATCH";
  for (const std::size_t at : {std::size_t{0}, std::size_t{1} << 20, expected.size() - 5}) {
    file.patch(at, std::as_bytes(std::span(patch)));
    expected.replace(at, 5, patch);
  }
  EXPECT_FALSE(fs::exists(folder / "a"));
  file.commit();
  EXPECT_EQ(file_bytes(folder / "a"), expected);
  EXPECT_EQ(entries(folder.path()), 1U);
}

TEST(OutputFile, Extensions_AreWrittenInTurn) {
  const TempFolder folder;
  std::string expected;
  io::OutputFile file(folder / "a", false);
  for (const std::size_t size : {std::size_t{5}, io::OutputFile::kMostExtension, std::size_t{0},
                                 io::OutputFile::kMostExtension - 3, std::size_t{4}}) {
    const std::string part(size, static_cast<char>('a' + size % 26));
    const std::span<std::byte> place = file.extend(size);
    ASSERT_EQ(place.size(), size);
    std::ranges::copy(std::as_bytes(std::span(part)), place.begin());
    file.write(std::string_view("|"));
    expected += part + "|";
    EXPECT_EQ(file.size_bytes(), expected.size());
  }
  file.commit();
  EXPECT_EQ(file_bytes(folder / "a"), expected);
}

TEST(OutputFile, DestroyedWithoutCommit_LeavesNothing) {
  const TempFolder folder;
  {
    io::OutputFile file(folder / "a", false);
    file.write(std::string_view("text"));
    EXPECT_EQ(entries(folder.path()), 1U);
    EXPECT_FALSE(fs::exists(folder / "a"));
  }
  EXPECT_EQ(entries(folder.path()), 0U);
}

TEST(OutputFile, ExistingFile_IsRefusedUnlessOverwriteIsSet) {
  const TempFolder folder;
  write_bytes(folder / "a", "old");
  EXPECT_HAS(message_of<ConfigError>([&] { io::OutputFile(folder / "a", false); }), "--overwrite");
  io::OutputFile file(folder / "a", true);
  file.write(std::string_view("new"));
  EXPECT_EQ(file_bytes(folder / "a"), "old");
  file.commit();
  EXPECT_EQ(file_bytes(folder / "a"), "new");
}

TEST(OutputFile, FileThatAppearedMeanwhile_IsNotReplaced) {
  const TempFolder folder;
  {
    io::OutputFile file(folder / "a", false);
    write_bytes(folder / "a", "other");
    EXPECT_HAS(message_of<ConfigError>([&] { file.commit(); }), "exists already");
  }
  EXPECT_EQ(file_bytes(folder / "a"), "other");
  EXPECT_EQ(entries(folder.path()), 1U);
}

TEST(OutputFile, SameNameTwice_IsRefused) {
  const TempFolder folder;
  io::OutputFile first(folder / "a", false);
  first.write(std::string_view("first"));
  EXPECT_HAS(message_of<IoError>([&] { io::OutputFile(folder / "a", false); }), "another output");
  first.commit();
  EXPECT_EQ(file_bytes(folder / "a"), "first");
}

TEST(OutputFile, PartialFileOfADeadProcess_IsTakenOver) {
  const TempFolder folder;
  const fs::path partial = (folder / "a").string() + ".partial-" + std::to_string(::getpid());
  write_bytes(partial, std::string(1000, 'x'));
  io::OutputFile file(folder / "a", false);
  file.write(std::string_view("new"));
  file.commit();
  EXPECT_EQ(file_bytes(folder / "a"), "new");
  EXPECT_FALSE(fs::exists(partial));
}

TEST(OutputFile, UnusableTargets_AreRefused) {
  const TempFolder folder;
  EXPECT_HAS(message_of<IoError>([&] { io::OutputFile(folder / "absent/a", false); }), "No such file");
  EXPECT_HAS(message_of<ConfigError>([&] { io::OutputFile(folder.path(), true); }), "not a regular file");
  EXPECT_HAS(message_of<ConfigError>([&] { io::OutputFile("/dev/null", true); }), "not a regular file");
  io::OutputFile file(folder / "a", false);
  EXPECT_HAS(message_of<IoError>([&] { file.patch(1, {}); }), "behind the end");
}

TEST(OutputFile, FailingWrite_IsAnErrorAndLeavesNothing) {
  const TempFolder folder;
  rlimit before{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  rlimit small = before;
  small.rlim_cur = 3 << 20;
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
  const std::string block(100000, 'x');
  const std::string text = message_of<IoError>([&] {
    io::OutputFile file(folder / "a", false);
    for (int i = 0; i < 100; ++i) file.write(std::string_view(block));
    file.commit();
  });
  // A failure of the last, buffered bytes must surface as well.
  const std::string late = message_of<IoError>([&] {
    io::OutputFile file(folder / "a", false);
    const std::string most((3 << 20) - 10, 'x');
    file.write(std::string_view(most));
    file.write(std::string_view("more than ten bytes"));
    file.commit();
  });
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  EXPECT_HAS(text, "File too large");
  EXPECT_HAS(late, "File too large");
  EXPECT_HAS(text, "after");
  EXPECT_EQ(entries(folder.path()), 0U);
}

}  // namespace
}  // namespace arris::test
