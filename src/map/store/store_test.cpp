#include "map/store/store.hpp"

#include <gtest/gtest.h>

#include <unistd.h>

#include <fmt/format.h>

#include "base/testing/temporary_folder.hpp"
#include "map/store/place/address.hpp"
#include "map/store/sql/sqlite.hpp"
#include "map/testing/random_features.hpp"

namespace lapwing::map {
namespace {

using namespace std::chrono_literals;

base::UtcTime const noon = std::chrono::sys_days(std::chrono::year(2027) / 1 / 1);

/// What is kept in one folder, opened anew as often as a test likes.
struct Stores : ::testing::Test {
  Stores() { options.address = folder.path().string(); }

  std::unique_ptr<Store> open() {
    auto opened = Store::open(loop, options);
    EXPECT_TRUE(opened) << opened.error().message;
    return std::move(*opened);
  }
  static std::unique_ptr<LiveMap> empty_map() {
    return std::make_unique<LiveMap>([] { return noon; });
  }
  static std::unique_ptr<LiveMap> map_with_site() {
    auto map = empty_map();
    map->put_site(geo::Site::make("car park", geo::Wgs84::from_degrees(47.4, 8.5, 420.0)).value());
    return map;
  }
  /// As a station does at its start.
  std::unique_ptr<LiveMap> loaded() {
    auto const store = open();
    auto map = empty_map();
    auto const done = loop.run_until_done(store->load(*map));
    EXPECT_TRUE(done) << done.error().message;
    trouble_of_loading = store->health().trouble;
    return map;
  }
  base::Result<> flush(Store& store) { return loop.run_until_done(store.flush()); }
  void put(LiveMap& map, LayerKind layer, std::string id, base::UtcTime at = noon - 1h) {
    auto feature = random.feature(layer, std::move(id), "car park");
    feature.account.at = at;
    auto const done = map.put(std::move(feature));
    EXPECT_TRUE(done) << done.error().message;
  }
  std::int64_t number(std::string const& query) {
    auto const database = sql::open_sqlite(folder.path() / "map.gpkg", sql::Access::read);
    return sql::as_integer(sql::value_of(**database, query).value()).value();
  }

  base::Loop loop;
  base::testing::TemporaryFolder folder;
  map::testing::RandomFeatures random{1};
  Store::Options options;
  std::string trouble_of_loading;
};

TEST_F(Stores, GiveBackTheWholeMap) {
  auto const map = map_with_site();
  {
    auto const store = open();
    store->follow(*map);
    for (auto const layer : all_layers)
      for (int i = 0; i < 20; ++i) put(*map, layer, fmt::format("{}", i));
    ASSERT_TRUE(flush(*store));
    EXPECT_EQ(store->health().waiting, 0u);
    EXPECT_TRUE(store->health().is_writing);
  }
  auto const found = loaded();
  EXPECT_EQ(trouble_of_loading, "");
  EXPECT_EQ(found->sites().size(), 1u);
  for (auto const layer : all_layers) {
    EXPECT_EQ(found->size(layer), 20u) << name_of(layer);
    for (auto const* record : map->within(layer, "car park", std::nullopt, 1000)) {
      auto const* kept = found->find(layer, record->feature.id);
      ASSERT_TRUE(kept);
      EXPECT_EQ(kept->feature.account, record->feature.account);
    }
  }
}

TEST_F(Stores, WriteWhatIsLeftWhenTheyEnd) {
  auto const map = map_with_site();
  {
    auto const store = open();
    store->follow(*map);
    for (int i = 0; i < 5000; ++i) put(*map, LayerKind::walls, fmt::format("{}", i));
  }
  EXPECT_EQ(number("SELECT count(*) FROM walls"), 5000);
}

TEST_F(Stores, WriteByThemselvesWhenNobodyAsks) {
  auto const map = map_with_site();
  auto const store = open();
  store->follow(*map);
  put(*map, LayerKind::walls, "a");
  auto const wait = [&]() -> base::Task<bool> {
    for (int i = 0; i < 6000 && store->health().waiting > 0; ++i) co_await loop.sleep(10ms);
    co_return store->health().waiting == 0;
  };
  EXPECT_TRUE(loop.run_until_done(wait()));
  EXPECT_EQ(number("SELECT count(*) FROM walls"), 1);
}

TEST_F(Stores, RememberWhenSomethingWasTakenAway) {
  auto const map = map_with_site();
  {
    auto const store = open();
    store->follow(*map);
    put(*map, LayerKind::slots, "gone", noon - 3h);
    put(*map, LayerKind::slots, "back", noon - 3h);
    ASSERT_TRUE(flush(*store));
    for (auto const* const id : {"gone", "back"})
      ASSERT_TRUE(map->remove(LayerKind::slots, id, {"operator", noon - 2h}));
    put(*map, LayerKind::slots, "back", noon - 1h);
    ASSERT_TRUE(flush(*store));
  }
  auto const found = loaded();
  EXPECT_EQ(trouble_of_loading, "");
  EXPECT_EQ(found->size(LayerKind::slots), 1u);
  auto late = random.feature(LayerKind::slots, "gone", "car park");
  late.account.at = noon - 150min;
  EXPECT_EQ(found->put(late), LiveMap::Outcome::outdated) << "it is from before the removal";
  ASSERT_TRUE(found->find(LayerKind::slots, "back"));
  EXPECT_EQ(found->find(LayerKind::slots, "back")->removal, (Account{"operator", noon - 2h}));
}

TEST_F(Stores, GiveBackGridsWithTheTimesOfTheirTiles) {
  auto const map = map_with_site();
  GridKey const key{"car park", "0", "parking"};
  OccupancyGrid grid(0.05, {geo::Point<geo::SiteFrame>(3.0, 4.0), 0.1});
  for (int i = 0; i < 1000; ++i) grid.set({7 * i - 2000, i}, Evidence::of_log_odds(0.01 * i));
  {
    auto const store = open();
    store->follow(*map);
    std::vector<TileKey> tiles;
    for (auto const& [where, tile] : grid.tiles()) tiles.push_back(where);
    ASSERT_TRUE(map->put_tiles(key, grid, tiles, {"robot", noon - 2h}));
    ASSERT_TRUE(map->put_tiles(key, grid, {tiles.front()}, {"robot", noon - 1h}));
    ASSERT_TRUE(flush(*store));
  }
  auto const found = loaded();
  EXPECT_EQ(trouble_of_loading, "");
  ASSERT_TRUE(found->grids().contains(key));
  auto const& record = found->grids().at(key);
  EXPECT_EQ(record.tile_times, map->grids().at(key).tile_times);
  EXPECT_EQ(record.account, map->grids().at(key).account);
  for (int i = 0; i < 1000; ++i) {
    Cell const cell{7 * i - 2000, i};
    EXPECT_EQ(record.grid.at(cell), grid.at(cell));
  }
}

TEST_F(Stores, MoveWhatLiesInASiteWithIt) {
  auto const map = map_with_site();
  auto const store = open();
  store->follow(*map);
  for (int i = 0; i < 10; ++i) put(*map, LayerKind::slots, fmt::format("{}", i));
  ASSERT_TRUE(flush(*store));
  map->put_site(geo::Site::make("car park", geo::Wgs84::from_degrees(48.4, 8.5, 420.0)).value());
  ASSERT_TRUE(flush(*store));
  EXPECT_EQ(number("SELECT count(*) FROM rtree_slots_geom WHERE miny > 48"), 10);
}

TEST_F(Stores, KeepWhatCannotBeWrittenAndGoOnByThemselves) {
  auto const map = map_with_site();
  auto const store = open();
  store->follow(*map);
  ASSERT_TRUE(flush(*store));
  auto const saboteur = sql::open_sqlite(folder.path() / "map.gpkg", sql::Access::write);
  ASSERT_TRUE((*saboteur)->execute(
      "CREATE TRIGGER broken BEFORE INSERT ON walls BEGIN SELECT RAISE(ABORT, 'the disk is on fire'); END"));
  put(*map, LayerKind::walls, "a");
  store->record({.at = noon, .session = "s", .feed = "f", .content = "x"});
  auto const failed = flush(*store);
  ASSERT_FALSE(failed);
  EXPECT_TRUE(failed.error().message.starts_with("1 changes are not written: ")) << failed.error().message;
  EXPECT_TRUE(failed.error().message.ends_with("the disk is on fire")) << failed.error().message;
  EXPECT_FALSE(store->health().is_writing);
  EXPECT_EQ(store->health().waiting, 1u);
  EXPECT_NE(store->health().trouble, "");
  EXPECT_EQ(number("SELECT count(*) FROM shown_chunks"), 0) << "nothing of the batch";
  // Frames find room up to a bound, and then are counted.
  for (int i = 0; i < 40; ++i)
    store->record({.at = noon, .session = "s", .feed = "f", .content = std::string(1024 * 1024, 'x')});
  EXPECT_GE(store->health().lost_frames, 8u);
  EXPECT_LE(store->health().lost_frames, 9u);
  ASSERT_TRUE((*saboteur)->execute("DROP TRIGGER broken"));
  auto const wait = [&]() -> base::Task<bool> {
    for (int i = 0; i < 6000 && !store->health().is_writing; ++i) co_await loop.sleep(10ms);
    co_return store->health().is_writing;
  };
  EXPECT_TRUE(loop.run_until_done(wait()));
  ASSERT_TRUE(flush(*store));
  EXPECT_EQ(number("SELECT count(*) FROM walls"), 1);
  EXPECT_EQ(number("SELECT sum(frames) FROM shown_chunks"), 41 - static_cast<int>(store->health().lost_frames));
}

TEST_F(Stores, RefuseToWriteOnADiskThatIsNearlyFull) {
  options.least_free_bytes = std::uint64_t{1} << 60U;
  auto const map = map_with_site();
  auto const store = open();
  store->follow(*map);
  auto const refused = flush(*store);
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("shall stay free"), std::string::npos) << refused.error().message;
  EXPECT_NE(store->health().trouble.find("make room: it goes on by itself"), std::string::npos);
  EXPECT_FALSE(loop.run_until_done(store->keep("abc", "image/png")));
}

TEST_F(Stores, AreWrittenByOneProgram) {
  auto first = open();
  auto const second = Store::open(loop, options);
  ASSERT_FALSE(second);
  EXPECT_EQ(second.error().kind, base::ErrorKind::refused);
  EXPECT_EQ(second.error().message,
            fmt::format("{}: another program writes to this store (process {})", options.address, ::getpid()));
  first.reset();
  EXPECT_TRUE(Store::open(loop, options));
}

TEST_F(Stores, AreNotMadeWhereTheyCannotBe) {
  folder.write("file", "");
  options.address = (folder.path() / "file" / "store").string();
  auto const refused = Store::open(loop, options);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().kind, base::ErrorKind::io);
}

TEST_F(Stores, KeepPictures) {
  std::string hash;
  {
    auto const store = open();
    auto const kept = loop.run_until_done(store->keep("not really a picture", "image/png"));
    ASSERT_TRUE(kept);
    hash = *kept;
  }
  auto const store = open();
  auto const found = loop.run_until_done(store->blob(hash));
  ASSERT_TRUE(found);
  EXPECT_EQ(found->bytes, "not really a picture");
  EXPECT_EQ(found->media_type, "image/png");
}

TEST_F(Stores, TellWhatCannotBeReadAndGiveTheRest) {
  auto const map = map_with_site();
  {
    auto const store = open();
    store->follow(*map);
    put(*map, LayerKind::slots, "good");
    put(*map, LayerKind::slots, "bad");
    ASSERT_TRUE(flush(*store));
  }
  auto const saboteur = sql::open_sqlite(folder.path() / "map.gpkg", sql::Access::write);
  ASSERT_TRUE((*saboteur)->change("UPDATE slots SET taken_probability = 7 WHERE id = 'bad'", {}));
  auto const found = loaded();
  EXPECT_EQ(found->size(LayerKind::slots), 1u);
  EXPECT_EQ(trouble_of_loading, "slots \"bad\" in the store: taken_probability is 7, not from 0 to 1");
}

struct Past : Stores {
  static Store::Shown frame(double s, std::string content, bool is_whole = false) {
    return {.at = noon + base::from_seconds(s),
            .session = "run 1",
            .feed = "vehicles",
            .is_whole = is_whole,
            .content = std::move(content)};
  }
};

TEST_F(Past, IsThereForALaterRun) {
  {
    auto const store = open();
    store->name_session("run 1", "Morning survey");
    store->record(frame(0, "whole", true));
    store->record(frame(1, "news"));
    ASSERT_TRUE(flush(*store));
    store->record(frame(2, "later"));
  }
  auto const store = open();
  auto const sessions = loop.run_until_done(store->sessions());
  ASSERT_EQ(sessions->size(), 1u);
  EXPECT_EQ(sessions->front().name, "Morning survey");
  auto const state = loop.run_until_done(store->state_at("run 1", noon + 1500ms));
  ASSERT_EQ(state->size(), 2u);
  EXPECT_EQ((*state)[0].content, "whole");
  EXPECT_EQ((*state)[1].content, "news");
  EXPECT_EQ(loop.run_until_done(store->shown("run 1", noon, noon + 1h, 100))->size(), 3u);
}

TEST_F(Past, IncludesWhatHasJustBeenRecorded) {
  auto const store = open();
  store->record(frame(0, "whole", true));
  EXPECT_EQ(loop.run_until_done(store->state_at("run 1", noon))->size(), 1u);
}

TEST_F(Past, GoesWhenItIsTooOld) {
  auto const now = loop.utc_now();
  for (int day = 0; day < 5; ++day) {
    auto shown = frame(0, "x", true);
    shown.session = fmt::format("day {}", day);
    shown.at = now - day * 24h + 1h;
    open()->record(std::move(shown));
  }
  options.longest = 24h;
  auto const store = open();
  auto const wait = [&]() -> base::Task<std::size_t> {
    for (int i = 0; i < 1500; ++i) {
      auto const sessions = co_await store->sessions();
      if (sessions->size() == 2) break;
      co_await loop.sleep(10ms);
    }
    co_return (co_await store->sessions())->size();
  };
  EXPECT_EQ(loop.run_until_done(wait()), 2u);
}

}  // namespace
}  // namespace lapwing::map
