#include "host/files/files.hpp"

#include <fstream>
#include <thread>

#include <gtest/gtest.h>
#include <sys/stat.h>

#include "base/testing/temporary_folder.hpp"

namespace lapwing::host {
namespace {

namespace fs = std::filesystem;
using base::testing::TemporaryFolder;

TEST(Files, ReadsAScriptAsItIs) {
  TemporaryFolder const folder;
  EXPECT_EQ(read_script(folder.write("a.dolphin", "line\r\n\0x")).value(), "line\r\n");
  EXPECT_EQ(read_script(folder.write("empty.dolphin", "")).value(), "");
}

TEST(Files, SaysWhyAScriptCannotBeRead) {
  TemporaryFolder const folder;
  auto const absent = read_script((folder.path() / "absent.dolphin").string());
  EXPECT_EQ(absent.error().kind, base::ErrorKind::not_found);
  EXPECT_NE(absent.error().message.find("absent.dolphin: no such file"), std::string::npos);
  EXPECT_EQ(read_script(folder.path().string()).error().kind, base::ErrorKind::invalid_input);
}

/// `check <(make_script)`
TEST(Files, ReadsAPipeToItsEnd) {
  TemporaryFolder const folder;
  auto const path = (folder.path() / "pipe").string();
  ASSERT_EQ(mkfifo(path.c_str(), 0600), 0);
  std::jthread const writer([&] { std::ofstream(path) << "message 'hello'\n"; });
  EXPECT_EQ(read_script(path).value(), "message 'hello'\n");
}

TEST(Files, RefusesAScriptBeyondTheLimitBeforeReadingIt) {
  TemporaryFolder const folder;
  auto const path = folder.write("large.dolphin", "");
  fs::resize_file(path, max_script_bytes + 1);  // sparse: takes no space
  auto const read = read_script(path);
  ASSERT_FALSE(read);
  EXPECT_NE(read.error().message.find("too large"), std::string::npos);
}

TEST(Files, FindsTheHomeOfTheProgram) {
  EXPECT_TRUE(fs::exists(home_directory() / "examples/survey.dolphin"));
}

}  // namespace
}  // namespace lapwing::host
