#include "map/store/blobs/blobs.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "base/testing/temporary_folder.hpp"
#include "map/store/blobs/sha256.hpp"
#include "map/store/schema/migrate.hpp"
#include "map/store/sql/sqlite.hpp"

namespace lapwing::map::blobs {
namespace {

// printf abc | sha256sum
constexpr auto hash_of_abc = "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad";
base::UtcTime const now = sql::time_of_nanoseconds(1'700'000'000'000'000'000);

struct Blobs : ::testing::Test {
  Blobs() : database(sql::open_sqlite(folder.path() / "map.gpkg", sql::Access::write).value()) {
    EXPECT_TRUE(schema::prepare(*database, "map.gpkg"));
  }
  base::testing::TemporaryFolder folder;
  std::unique_ptr<sql::Database> database;
  std::unique_ptr<Bytes> bytes = in_folder(folder.path() / "blobs");
};

TEST(Sha256, IsThatOfOtherPrograms) {
  EXPECT_EQ(sha256("abc"), hash_of_abc);
}

TEST_F(Blobs, AreGivenBackByTheirHash) {
  EXPECT_EQ(keep(*database, *bytes, {"abc", "image/png"}, now), hash_of_abc);
  EXPECT_EQ(folder.read("blobs/ba/7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad"), "abc");
  auto const found = read(*database, *bytes, hash_of_abc);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->bytes, "abc");
  EXPECT_EQ(found->media_type, "image/png");
}

TEST_F(Blobs, AreKeptOnce) {
  EXPECT_EQ(keep(*database, *bytes, {"abc", "image/png"}, now), hash_of_abc);
  EXPECT_EQ(keep(*database, *bytes, {"abc", "image/png"}, now), hash_of_abc);
  EXPECT_EQ(bytes->all_hashes()->size(), 1u);
}

TEST_F(Blobs, ThatAreDamagedAreAnError) {
  ASSERT_TRUE(keep(*database, *bytes, {"abc", "image/png"}, now));
  folder.write("blobs/ba/7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad", "abd");
  EXPECT_EQ(read(*database, *bytes, hash_of_abc).error().kind, base::ErrorKind::io);
  bytes->remove(hash_of_abc);
  EXPECT_EQ(read(*database, *bytes, hash_of_abc).error().kind, base::ErrorKind::io) << "a row tells of it";
}

TEST_F(Blobs, ThatNobodyKeptAreNotFound) {
  EXPECT_EQ(read(*database, *bytes, sha256("never")).error().kind, base::ErrorKind::not_found);
  EXPECT_EQ(read(*database, *bytes, "../../etc/passwd").error().kind, base::ErrorKind::not_found);
}

TEST_F(Blobs, LeaveNothingHalf) {
  ASSERT_TRUE(keep(*database, *bytes, {"abc", "image/png"}, now));
  folder.write("blobs/ba/0000.part", "half of a");
  EXPECT_EQ(bytes->all_hashes()->size(), 1u);
  EXPECT_EQ(bytes->remove_leftovers(), 1u);
  EXPECT_EQ(bytes->remove_leftovers(), 0u);
}

TEST_F(Blobs, AreRefusedWhereTheyCannotBeWritten) {
  folder.write("file", "");
  auto const nowhere = in_folder(folder.path() / "file");
  EXPECT_EQ(keep(*database, *nowhere, {"abc", "image/png"}, now).error().kind, base::ErrorKind::io);
  EXPECT_EQ(read(*database, *nowhere, hash_of_abc).error().kind, base::ErrorKind::not_found) << "no row without bytes";
}

TEST_F(Blobs, LieInTheDatabaseWhereSeveralShareIt) {
  auto const table = in_table(*database);
  ASSERT_TRUE(keep(*database, *bytes, {"abc", "image/png"}, now));
  ASSERT_TRUE(table->write(hash_of_abc, "abc"));
  EXPECT_EQ(read(*database, *table, hash_of_abc)->bytes, "abc");
  EXPECT_EQ(table->all_hashes()->size(), 1u);
}

}  // namespace
}  // namespace lapwing::map::blobs
