#include "map/store/sql/sqlite.hpp"

#include <gtest/gtest.h>

#include "base/testing/temporary_folder.hpp"

namespace lapwing::map::sql {
namespace {

using base::testing::TemporaryFolder;

Table const things = {.name = "things",
                      .about = "For tests",
                      .columns = {{"fid", ColumnKind::key},
                                  {"id", ColumnKind::text, true},
                                  {"yes", ColumnKind::boolean},
                                  {"size", ColumnKind::integer},
                                  {"weight", ColumnKind::real},
                                  {"at", ColumnKind::time},
                                  {"data", ColumnKind::bytes}},
                      .key = {"id"}};
std::vector<std::string> const columns = {"id", "yes", "size", "weight", "at", "data"};

struct Sqlite : ::testing::Test {
  Sqlite() : database(open_sqlite(folder.path() / "a.gpkg", Access::write).value()) {
    EXPECT_TRUE(database->execute(create_statements(Dialect::geopackage, things)));
  }
  TemporaryFolder folder;
  std::unique_ptr<Database> database;
};

Row thing(std::string id, std::int64_t size) {
  return {
      std::move(id), true, size, 0.1, time_of_nanoseconds(1'700'000'000'123'456'789), Bytes{std::string("\0\xff", 2)}};
}

TEST_F(Sqlite, GivesBackWhatWasPut) {
  ASSERT_TRUE(database->put(things, columns, {thing("a", 1), thing("b", 2)}));
  auto const rows = rows_of(*database, "SELECT id, yes, size, weight, at, data FROM things ORDER BY fid");
  ASSERT_TRUE(rows);
  ASSERT_EQ(rows->size(), 2u);
  auto const& row = rows->front();
  EXPECT_EQ(as_text(row[0]), "a");
  EXPECT_EQ(as_bool(row[1]), true);
  EXPECT_EQ(as_integer(row[2]), 1);
  EXPECT_EQ(as_real(row[3]), 0.1);
  EXPECT_EQ(as_text(row[4]), "2023-11-14T22:13:20.123Z");
  EXPECT_EQ(as_time(row[4]), time_of_nanoseconds(1'700'000'000'123'000'000));
  EXPECT_EQ(as_bytes(row[5]), std::string("\0\xff", 2));
}

TEST_F(Sqlite, PutsOverARowOfTheSameKeyAndLeavesTheNumberThatItHas) {
  ASSERT_TRUE(database->put(things, columns, {thing("a", 1), thing("b", 2)}));
  ASSERT_TRUE(database->put(things, columns, {thing("a", 7)}));
  auto const rows = rows_of(*database, "SELECT fid, size FROM things WHERE id = $1", {std::string("a")});
  ASSERT_EQ(rows->size(), 1u);
  EXPECT_EQ(as_integer(rows->front()[0]), 1);
  EXPECT_EQ(as_integer(rows->front()[1]), 7);
}

TEST_F(Sqlite, TakesATransactionWholeOrNotAtAll) {
  {
    auto transaction = Transaction::begin(*database);
    ASSERT_TRUE(database->put(things, columns, {thing("a", 1)}));
  }
  EXPECT_EQ(as_integer(*value_of(*database, "SELECT count(*) FROM things")), 0);
  auto transaction = Transaction::begin(*database);
  ASSERT_TRUE(database->put(things, columns, {thing("a", 1)}));
  ASSERT_TRUE(transaction->commit());
  EXPECT_EQ(as_integer(*value_of(*database, "SELECT count(*) FROM things")), 1);
}

TEST_F(Sqlite, IsReadWhileItIsWritten) {
  auto reader = open_sqlite(folder.path() / "a.gpkg", Access::read).value();
  ASSERT_TRUE(database->put(things, columns, {thing("a", 1)}));
  auto transaction = Transaction::begin(*database);
  ASSERT_TRUE(database->put(things, columns, {thing("b", 2)}));
  EXPECT_EQ(as_integer(*value_of(*reader, "SELECT count(*) FROM things")), 1);
  ASSERT_TRUE(transaction->commit());
  EXPECT_EQ(as_integer(*value_of(*reader, "SELECT count(*) FROM things")), 2);
  EXPECT_EQ(reader->change("DELETE FROM things", {}).error().kind, base::ErrorKind::refused);
}

TEST_F(Sqlite, SaysWhatIsWrongAndWhere) {
  auto const missing = database->change("DELETE FROM nowhere", {});
  EXPECT_EQ(missing.error().kind, base::ErrorKind::invalid_input);
  EXPECT_EQ(missing.error().message, (folder.path() / "a.gpkg").string() + ": no such table: nowhere");
  auto const twice = database->change("INSERT INTO things (id) VALUES ('a'), ('a')", {});
  EXPECT_EQ(twice.error().kind, base::ErrorKind::refused);
  // As a full disk does, and the same for every program: no page more than there are.
  ASSERT_TRUE(database->execute("PRAGMA max_page_count = 1"));
  auto const full = database->put(
      things, columns, {{std::string("b"), true, std::int64_t{1}, 0.0, Value(), Bytes{std::string(100'000, 'x')}}});
  EXPECT_EQ(full.error().kind, base::ErrorKind::io);
  EXPECT_EQ(full.error().hint, "make room on its disk");
}

TEST(OpeningSqlite, RefusesWhatIsNoDatabase) {
  TemporaryFolder const folder;
  folder.write("a.gpkg", std::string(5000, 'x'));
  auto const opened = open_sqlite(folder.path() / "a.gpkg", Access::write);
  ASSERT_FALSE(opened);
  EXPECT_EQ(opened.error().kind, base::ErrorKind::invalid_input);
  EXPECT_FALSE(open_sqlite(folder.path() / "missing.gpkg", Access::read));
}

}  // namespace
}  // namespace lapwing::map::sql
