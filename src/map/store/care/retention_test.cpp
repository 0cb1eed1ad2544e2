#include "map/store/care/retention.hpp"

#include <gtest/gtest.h>

#include <random>

#include <fmt/format.h>

#include "base/testing/temporary_folder.hpp"
#include "map/store/rows/shown_rows.hpp"
#include "map/store/schema/migrate.hpp"
#include "map/store/sql/sqlite.hpp"

namespace lapwing::map::care {
namespace {

using namespace std::chrono_literals;

base::UtcTime const now = std::chrono::sys_days(std::chrono::year(2027) / 1 / 1);

struct Retention : ::testing::Test {
  Retention() { EXPECT_TRUE(schema::prepare(*database, "a store")); }
  /// Of some kilobytes that do not become smaller.
  std::string noise(std::size_t size) {
    std::string made(size, '\0');
    for (auto& byte : made) byte = static_cast<char>(random());
    return made;
  }
  void record(std::string session, base::UtcTime at) {
    ASSERT_TRUE(rows::write_shown(
        *database,
        {{.at = at, .session = std::move(session), .feed = "f", .is_whole = true, .content = noise(10'000)}}));
  }
  void retain_all(Limits const& limits) const {
    for (int turns = 0; turns < 1000; ++turns) {
      auto const more = retain(*database, *bytes, limits, now);
      ASSERT_TRUE(more) << more.error().message;
      if (!*more) return;
    }
    FAIL() << "it does not end";
  }
  std::int64_t count(std::string const& table) const {
    return sql::as_integer(sql::value_of(*database, "SELECT count(*) FROM " + table).value()).value();
  }

  std::mt19937 random{1};
  base::testing::TemporaryFolder folder;
  std::unique_ptr<sql::Database> database = sql::open_sqlite(folder.path() / "map.gpkg", sql::Access::write).value();
  std::unique_ptr<blobs::Bytes> bytes = blobs::in_folder(folder.path() / "blobs");
};

TEST_F(Retention, WithoutLimitsTakesNothingAway) {
  record("a", now - 24h * 365);
  retain_all({});
  EXPECT_EQ(count("shown_chunks"), 1);
}

TEST_F(Retention, TakesAwayWhatIsTooOldAndSessionsOfWhichNothingIsLeft) {
  for (int day = 0; day < 500; ++day) record(fmt::format("day {}", day), now - day * 24h);
  retain_all({.longest = std::chrono::hours(24 * 7)});
  EXPECT_EQ(count("shown_chunks"), 8);
  EXPECT_EQ(count("sessions"), 8);
}

TEST_F(Retention, StaysWithinASizeAndGivesTheDiskItsSpaceBack) {
  for (int hour = 1000; hour > 0; --hour) record("a", now - hour * 1h);
  auto const before = *bytes_in_use(*database);
  ASSERT_GT(before, 10'000'000u);
  retain_all({.most_bytes = 5'000'000});
  EXPECT_LE(*bytes_in_use(*database), 5'000'000u);
  EXPECT_GT(*bytes_in_use(*database), 3'000'000u) << "no more than it must";
  auto const oldest = sql::value_of(*database, "SELECT min(first_ns) FROM shown_chunks");
  EXPECT_GT(sql::time_of_nanoseconds(sql::as_integer(*oldest).value()), now - 500h) << "the oldest went";
  ASSERT_TRUE(database->execute("PRAGMA wal_checkpoint(TRUNCATE)"));
  EXPECT_LT(std::filesystem::file_size(folder.path() / "map.gpkg"), 6'000'000u);
}

TEST_F(Retention, TakesPicturesWithThePastWhicheverIsOlder) {
  for (int hour = 100; hour > 0; --hour) {
    record("a", now - hour * 1h);
    ASSERT_TRUE(blobs::keep(*database, *bytes, {noise(10'000), "image/png"}, now - hour * 1h));
  }
  retain_all({.most_bytes = 1'000'000});
  EXPECT_NEAR(static_cast<double>(count("blobs")), static_cast<double>(count("shown_chunks")), 1.0);
  EXPECT_EQ(static_cast<std::int64_t>(bytes->all_hashes()->size()), count("blobs"));
  EXPECT_GT(count("blobs"), 10);
}

TEST_F(Retention, RemembersAsManyRemovalsAsTheLiveMap) {
  ASSERT_TRUE(database->execute(
      "WITH RECURSIVE n(i) AS (SELECT 1 UNION ALL SELECT i + 1 FROM n WHERE i < 10100) INSERT INTO removed SELECT "
      "'slots', i, 's', '', 'w', 0, i FROM n"));
  retain_all({});
  EXPECT_EQ(count("removed"), 10'000);
}

}  // namespace
}  // namespace lapwing::map::care
