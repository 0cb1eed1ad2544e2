#include "scans/storage/sqlite_bag.hpp"

#include <unistd.h>

#include <fstream>

#include <gtest/gtest.h>
#include <sqlite3.h>

#include "scans/testing/written_bag.hpp"

namespace lapwing::scans {
namespace {

using namespace std::chrono_literals;
namespace fs = std::filesystem;

struct SqliteBagTest : ::testing::Test, BagListener {
  SqliteBagTest() { fs::create_directories(folder); }
  ~SqliteBagTest() override { fs::remove_all(folder); }

  bool wants(BagTopic const& topic) override { return topic.name == "/a"; }
  base::Result<> take(BagTopic const&, std::chrono::nanoseconds logged, std::string_view message) override {
    messages.push_back(std::to_string(logged.count()) + " " + std::string(message.substr(0, 10)));
    return {};
  }
  void run(std::string const& sql) const {
    sqlite3* database = nullptr;
    ASSERT_EQ(sqlite3_open(file.c_str(), &database), SQLITE_OK);
    sqlite3_exec(database, "PRAGMA synchronous=OFF", nullptr, nullptr, nullptr);
    ASSERT_EQ(sqlite3_exec(database, sql.c_str(), nullptr, nullptr, nullptr), SQLITE_OK) << sqlite3_errmsg(database);
    sqlite3_close(database);
  }

  fs::path const folder = fs::temp_directory_path() / ("lapwing-sqlite-bag-" + std::to_string(::getpid()));
  fs::path const file = folder / "bag.db3";
  std::vector<std::string> messages;
};

TEST_F(SqliteBagTest, IsReadInTheOrderOfRecording) {
  testing::WrittenBag bag;
  bag.add("/a", "std_msgs/msg/String", 7ns, "one");
  bag.add("/b", "std_msgs/msg/String", 8ns, "two");
  bag.add("/a", "std_msgs/msg/String", 3ns, "three");
  bag.write_sqlite(file);
  auto const remark = read_sqlite_bag(file, *this);
  ASSERT_TRUE(remark) << remark.error().message;
  EXPECT_EQ(*remark, "");
  EXPECT_EQ(messages, (std::vector<std::string>{"7 one", "3 three"}));
}

TEST_F(SqliteBagTest, ThatIsCutOffIsReadAsFarAsItGoes) {
  testing::WrittenBag bag;
  for (int i = 0; i < 500; ++i)
    bag.add("/a", "std_msgs/msg/String", std::chrono::nanoseconds(i), std::string(1000, 'a'));
  bag.write_sqlite(file);
  fs::resize_file(file, fs::file_size(file) / 2);
  auto const remark = read_sqlite_bag(file, *this);
  ASSERT_TRUE(remark) << remark.error().message;
  EXPECT_TRUE(remark->starts_with("the file is cut off or damaged")) << *remark;
  EXPECT_GT(messages.size(), 100U);
  EXPECT_LT(messages.size(), 500U);
}

TEST_F(SqliteBagTest, IsNoOtherDatabase) {
  run("CREATE TABLE tiles(a)");
  EXPECT_EQ(read_sqlite_bag(file, *this).error().message,
            "a database, but not one of rosbag2: it lacks the tables topics and messages");
}

TEST_F(SqliteBagTest, RunsNoViewOfAStranger) {
  run("CREATE TABLE topics(id,name,type,serialization_format);"
      "CREATE VIEW messages AS WITH RECURSIVE n(topic_id) AS (VALUES(1) UNION ALL SELECT topic_id+1 FROM n) "
      "SELECT topic_id, 0 AS timestamp, '' AS data FROM n");
  EXPECT_FALSE(read_sqlite_bag(file, *this));
}

TEST_F(SqliteBagTest, SaysWhatSqliteSays) {
  std::ofstream(file) << std::string("SQLite format 3\0", 16) << std::string(2000, 'x');
  auto const read = read_sqlite_bag(file, *this);
  ASSERT_FALSE(read);
  EXPECT_TRUE(read.error().message.starts_with("SQLite cannot read it: ")) << read.error().message;
}

}  // namespace
}  // namespace lapwing::scans
