#include "map/store/care/care.hpp"

#include <gtest/gtest.h>

#include <cstdlib>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/async/loop.hpp"
#include "base/testing/temporary_folder.hpp"
#include "map/store/sql/postgres.hpp"
#include "map/store/sql/sqlite.hpp"
#include "map/testing/random_features.hpp"

namespace lapwing::map::care {
namespace {

using namespace std::chrono_literals;

base::UtcTime const noon = std::chrono::sys_days(std::chrono::year(2027) / 1 / 1);

/// A store with something of everything.
struct Care : ::testing::Test {
  Care() : address((folder.path() / "store").string()) {
    LiveMap map([] { return noon; });
    map.put_site(geo::Site::make("car park", geo::Wgs84::from_degrees(47.4, 8.5, 420.0)).value());
    auto const store = Store::open(loop, {.address = address}).value();
    store->follow(map);
    map::testing::RandomFeatures random(1);
    for (auto const layer : all_layers)
      for (int i = 0; i < 150; ++i)
        EXPECT_TRUE(map.put(at_noon(random.feature(layer, fmt::format("{}", i), "car park"))));
    EXPECT_TRUE(map.remove(LayerKind::slots, "7", {"operator", noon}));
    OccupancyGrid grid(0.05);
    grid.set({5, -5}, Evidence::of_log_odds(2.0));
    EXPECT_TRUE(map.put_tiles({"car park", "0", "parking"}, grid, {tile_of({5, -5})}, {"robot", noon}));
    store->name_session("run 1", "Morning");
    store->record({.at = noon, .session = "run 1", .feed = "f", .is_whole = true, .content = "whole"});
    hash = loop.run_until_done(store->keep("picture", "image/png")).value();
    EXPECT_TRUE(loop.run_until_done(store->flush()));
  }
  static Feature at_noon(Feature feature) {
    feature.account.at = noon - 1h;
    return feature;
  }
  void break_it(std::string const& statement) const {
    auto const database = sql::open_sqlite(folder.path() / "store" / "map.gpkg", sql::Access::write);
    auto const done = (*database)->execute(statement);
    ASSERT_TRUE(done) << done.error().message;
  }
  [[nodiscard]] std::string faults() const {
    auto const verdict = verify(address);
    EXPECT_TRUE(verdict) << verdict.error().message;
    return verdict ? fmt::format("{}", fmt::join(verdict->faults, "\n")) : "";
  }
  [[nodiscard]] std::string picture() const { return "store/blobs/" + hash.substr(0, 2) + "/" + hash.substr(2); }

  base::Loop loop;
  base::testing::TemporaryFolder folder;
  std::string address;
  std::string hash;
};

void expect_all_features(Summary const& summary) {
  for (auto const layer : all_layers) EXPECT_EQ(summary.features.at(layer), layer == LayerKind::slots ? 149u : 150u);
  EXPECT_EQ(summary.removed, 1u);
  EXPECT_EQ(summary.sites, std::vector<std::string>{"car park"});
}

void expect_whole(Summary const& summary) {
  expect_all_features(summary);
  ASSERT_EQ(summary.grid_tiles.size(), 1u);
  EXPECT_EQ(summary.grid_tiles.begin()->second, 1u);
  EXPECT_EQ(summary.pictures, 1u);
  EXPECT_EQ(summary.picture_bytes, 7u);
  ASSERT_EQ(summary.sessions.size(), 1u);
  EXPECT_EQ(summary.sessions[0].name, "Morning");
  EXPECT_GT(summary.bytes, 0u);
}

TEST_F(Care, TellsWhatIsInAStore) {
  auto const told = summary(address);
  ASSERT_TRUE(told) << told.error().message;
  expect_whole(*told);
  EXPECT_EQ(summary((folder.path() / "nothing").string()).error().kind, base::ErrorKind::not_found);
}

TEST_F(Care, FindsNothingWrongWithASoundStore) {
  EXPECT_EQ(faults(), "");
  EXPECT_EQ(verify(address)->looked_at, 6u * 150u - 1u + 3u);
  EXPECT_EQ(verify(address)->stray_pictures, 0u);
}

TEST_F(Care, FindsWhatIsWrong) {
  break_it("UPDATE slots SET state = 'on fire' WHERE id = '3'");
  EXPECT_EQ(faults(), "slots \"3\" in the store: state takes one of the words unknown, free, taken");
  break_it("UPDATE slots SET state = 'free' WHERE id = '3'");
  break_it("DELETE FROM rtree_walls_geom WHERE id = 5");
  EXPECT_EQ(faults(), "1 of walls are not where the index has them");
  break_it(
      "INSERT INTO rtree_walls_geom SELECT fid, ST_MinX(geom), ST_MaxX(geom), ST_MinY(geom), ST_MaxY(geom) FROM walls "
      "WHERE fid = 5");
  EXPECT_EQ(faults(), "");
  break_it("UPDATE grid_tiles SET cells = x'00'");
  EXPECT_EQ(faults(), "the cells of tile (0, -1) of grid \"parking\" cannot be read");
  break_it("UPDATE grid_tiles SET cells = NULL; UPDATE shown_chunks SET content = x'00'");
  EXPECT_EQ(faults(), "session \"run 1\": a piece of what \"f\" showed cannot be read");
  break_it("DELETE FROM shown_chunks; PRAGMA foreign_keys = OFF; DELETE FROM grids");
  EXPECT_EQ(faults(), "a row of grid_tiles belongs to one of grids that is not there");
  break_it("DELETE FROM grid_tiles");
  folder.write(picture(), "another");
  EXPECT_EQ(faults(), "pictures: the bytes kept as " + hash + " are damaged");
}

TEST_F(Care, FindsADamagedFile) {
  auto bytes = folder.read("store/map.gpkg");
  std::fill(bytes.begin() + 8192, bytes.begin() + 20000, 'x');
  folder.write("store/map.gpkg", bytes);
  auto const verdict = verify(address);
  EXPECT_TRUE(!verdict || !verdict->faults.empty());
}

TEST_F(Care, GivesSpaceBack) {
  break_it("DELETE FROM pictures");
  folder.write("store/blobs/" + hash.substr(0, 2) + "/" + std::string(62, '0'), "stray");
  EXPECT_EQ(verify(address)->stray_pictures, 1u);
  auto const compacted = compact(address, {.longest = 24h * 365 * 100});
  ASSERT_TRUE(compacted) << compacted.error().message;
  EXPECT_EQ(compacted->stray_pictures, 1u);
  EXPECT_LT(std::filesystem::file_size(folder.path() / "store" / "map.gpkg"), compacted->bytes_before);
  EXPECT_EQ(faults(), "");
}

TEST_F(Care, LeavesAStoreAloneThatIsWritten) {
  auto const store = Store::open(loop, {.address = address}).value();
  EXPECT_EQ(compact(address, {}).error().kind, base::ErrorKind::refused);
  EXPECT_TRUE(summary(address)) << "reading is no matter";
}

TEST_F(Care, CopiesAllThatIsKept) {
  auto const other = (folder.path() / "other").string();
  auto const copied = copy(address, other);
  ASSERT_TRUE(copied) << copied.error().message;
  EXPECT_EQ(copied->pictures, 1u);
  EXPECT_EQ(copied->faults, std::vector<std::string>());
  expect_whole(*summary(other));
  auto const verdict = verify(other);
  EXPECT_EQ(verdict->faults, std::vector<std::string>());
  EXPECT_EQ(copy(address, other).error().message, other + ": there is something in this store");
}

TEST_F(Care, CopiesWhatItCanReadOfThePictures) {
  folder.write(picture(), "another");
  auto const other = (folder.path() / "other").string();
  auto const copied = copy(address, other);
  ASSERT_TRUE(copied) << copied.error().message;
  EXPECT_EQ(copied->faults.size(), 1u);
  EXPECT_EQ(verify(other)->faults, std::vector<std::string>());
}

/// See `server_test.cpp`.
TEST_F(Care, CopiesToAServerAndBack) {
  auto const* const server = std::getenv("LAPWING_TEST_POSTGRES");
  if (!server) GTEST_SKIP() << "LAPWING_TEST_POSTGRES names no server";
  ASSERT_TRUE(sql::open_postgres(server, "the server", sql::Access::write)
                  .value()
                  ->execute("DROP SCHEMA IF EXISTS lapwing CASCADE"));
  EXPECT_EQ(summary(server).error().kind, base::ErrorKind::invalid_input);
  auto const there = copy(address, server);
  ASSERT_TRUE(there) << there.error().message;
  expect_whole(*summary(server));
  EXPECT_EQ(verify(server)->faults, std::vector<std::string>());
  auto const compacted = compact(server, {});
  EXPECT_TRUE(compacted) << compacted.error().message;
  auto const other = (folder.path() / "other").string();
  auto const back = copy(server, other);
  ASSERT_TRUE(back) << back.error().message;
  expect_whole(*summary(other));
  EXPECT_EQ(verify(other)->faults, std::vector<std::string>());
  // Column by column, but for the numbers that the databases give.
  auto const rows = [](std::string const& folder_name) {
    auto const database = sql::open_sqlite(folder_name + "/map.gpkg", sql::Access::read);
    auto found = sql::rows_of(**database,
                              "SELECT hex(geom), id, site, floor, writer, at, at_ns, held_over, state, "
                              "taken_probability, seen_at, seen_at_ns, name FROM slots ORDER BY id");
    return found.value();
  };
  EXPECT_EQ(rows(other), rows(address));
}

}  // namespace
}  // namespace lapwing::map::care
