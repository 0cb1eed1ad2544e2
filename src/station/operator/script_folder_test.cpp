#include "station/operator/script_folder.hpp"

#include <gtest/gtest.h>
#include <unistd.h>
#include <fstream>

#include "base/testing/temporary_folder.hpp"

namespace lapwing::station {
namespace {

namespace fs = std::filesystem;

struct ScriptFolder : ::testing::Test {
  void SetUp() override { fs::create_directory(folder); }
  static void write(fs::path const& file, std::string_view text) { std::ofstream(file) << text; }

  base::testing::TemporaryFolder temporary;
  fs::path const parent = temporary.path();
  fs::path const folder = parent / "scripts";
};

TEST_F(ScriptFolder, ListsItsScriptsInOrder) {
  write(folder / "b.dolphin", "");
  write(folder / "a.dolphin", "");
  write(folder / "notes.txt", "");
  write(folder / ".hidden.dolphin", "");
  fs::create_directory(folder / "folder.dolphin");
  EXPECT_EQ(list_scripts(folder), (std::vector<std::string>{"a.dolphin", "b.dolphin"}));
}

TEST_F(ScriptFolder, IsEmptyWhereThereIsNone) {
  EXPECT_TRUE(list_scripts(parent / "absent").empty());
  EXPECT_TRUE(list_scripts({}).empty());
}

TEST_F(ScriptFolder, ReadsAScript) {
  write(folder / "a.dolphin", "message 'hello'\n");
  EXPECT_EQ(read_script(folder, "a.dolphin").value(), "message 'hello'\n");
}

TEST_F(ScriptFolder, NeverLeavesTheFolder) {
  write(parent / "outside.dolphin", "secret");
  fs::create_symlink(parent / "outside.dolphin", folder / "link.dolphin");
  for (auto const* name : {"../outside.dolphin", "/etc/passwd", ".hidden.dolphin", "a\\b.dolphin", "notes.txt", ""}) {
    EXPECT_EQ(read_script(folder, name).error().kind, base::ErrorKind::invalid_input) << name;
  }
  EXPECT_EQ(read_script(folder, "link.dolphin").error().kind, base::ErrorKind::not_found);
}

TEST_F(ScriptFolder, SaysWhatIsWrong) {
  EXPECT_EQ(read_script(folder, "absent.dolphin").error().kind, base::ErrorKind::not_found);
  EXPECT_EQ(read_script({}, "a.dolphin").error().kind, base::ErrorKind::not_found);
  write(folder / "large.dolphin", std::string((1u << 20) + 1, ' '));
  EXPECT_EQ(read_script(folder, "large.dolphin").error().kind, base::ErrorKind::invalid_input);
}

}  // namespace
}  // namespace lapwing::station
