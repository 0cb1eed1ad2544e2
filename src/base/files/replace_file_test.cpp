#include "base/files/replace_file.hpp"

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include <gtest/gtest.h>

#include "base/testing/temporary_folder.hpp"

namespace lapwing::base {
namespace {

namespace fs = std::filesystem;
using testing::TemporaryFolder;

std::string content_of(fs::path const& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

std::size_t files_in(fs::path const& folder) {
  return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

TEST(ReplaceFile, PutsTheNewContentInPlaceOfTheOld) {
  TemporaryFolder const folder;
  fs::path const path = folder.write("f", "old and longer");
  ASSERT_TRUE(replace_file(path, "new"));
  EXPECT_EQ(content_of(path), "new");
  EXPECT_EQ(files_in(path.parent_path()), 1U);
}

TEST(ReplaceFile, MakesAFileThatIsNotThere) {
  TemporaryFolder const folder;
  auto const path = fs::path(folder.write("other", "")).parent_path() / "f";
  ASSERT_TRUE(replace_file(path, std::string(100'000, 'x')));
  EXPECT_EQ(content_of(path), std::string(100'000, 'x'));
}

TEST(ReplaceFile, KeepsASecretToItsOwner) {
  TemporaryFolder const folder;
  fs::path const path = folder.write("f", "open to all");
  ASSERT_TRUE(replace_file(path, "secret", Readers::owner));
  EXPECT_EQ(fs::status(path).permissions(), fs::perms::owner_read | fs::perms::owner_write);
}

TEST(ReplaceFile, TakesNoFileThatAnEarlierProcessHasLeftOpenToOthers) {
  TemporaryFolder const folder;
  fs::path const path = folder.write("f", "old");
  auto const left = folder.write("f.part", "left");
  fs::permissions(left, fs::perms::all);
  ASSERT_TRUE(replace_file(path, "secret", Readers::owner));
  EXPECT_EQ(content_of(path), "secret");
  EXPECT_EQ(fs::status(path).permissions(), fs::perms::owner_read | fs::perms::owner_write);
}

TEST(ReplaceFile, SaysWhyItCannotAndLeavesWhatWasThere) {
  TemporaryFolder const folder;
  auto const inside = fs::path(folder.write("inside", "kept"));
  auto const replaced = replace_file(inside.parent_path(), "new");
  ASSERT_FALSE(replaced);
  EXPECT_EQ(replaced.error().kind, ErrorKind::io);
  EXPECT_NE(replaced.error().message.find(inside.parent_path().string() + ": cannot write: "), std::string::npos);
  EXPECT_EQ(content_of(inside), "kept");
  EXPECT_FALSE(fs::exists(inside.parent_path().string() + ".part"));
}

TEST(ReplaceFile, NeedsItsFolder) {
  TemporaryFolder const folder;
  auto const path = fs::path(folder.write("f", "")).parent_path() / "nowhere/f";
  auto const replaced = replace_file(path, "new");
  ASSERT_FALSE(replaced);
  EXPECT_EQ(replaced.error().message, path.string() + ": cannot write: No such file or directory");
}

}  // namespace
}  // namespace lapwing::base
