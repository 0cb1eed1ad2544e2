#include <gtest/gtest.h>

#include <cstdlib>

#include <fmt/format.h>

#include "map/store/care/retention.hpp"
#include "map/store/place/address.hpp"
#include "map/store/rows/shown_rows.hpp"
#include "map/store/schema/migrate.hpp"
#include "map/store/sql/postgres.hpp"
#include "map/store/store.hpp"
#include "map/testing/random_features.hpp"

/// The store on a server, whose address is in LAPWING_TEST_POSTGRES; tests/system/faults starts one and runs these.
namespace lapwing::map {
namespace {

using namespace std::chrono_literals;

base::UtcTime const noon = std::chrono::sys_days(std::chrono::year(2027) / 1 / 1);

struct Server : ::testing::Test {
  void SetUp() override {
    auto const* const address = std::getenv("LAPWING_TEST_POSTGRES");
    if (!address) GTEST_SKIP() << "LAPWING_TEST_POSTGRES names no server";
    options.address = address;
    database = connect();
    ASSERT_TRUE(database->execute("DROP SCHEMA IF EXISTS lapwing CASCADE"));
  }
  [[nodiscard]] std::unique_ptr<sql::Database> connect() const {
    return sql::open_postgres(options.address, "the server", sql::Access::write).value();
  }
  std::unique_ptr<Store> open() {
    auto opened = Store::open(loop, options);
    EXPECT_TRUE(opened) << opened.error().message;
    return std::move(*opened);
  }
  static std::unique_ptr<LiveMap> empty_map() {
    return std::make_unique<LiveMap>([] { return noon; });
  }
  static geo::Site car_park() {
    return geo::Site::make("car park", geo::Wgs84::from_degrees(47.4, 8.5, 420.0)).value();
  }
  std::int64_t number(std::string const& query) const {
    auto const value = sql::value_of(*database, query);
    EXPECT_TRUE(value) << value.error().message;
    return sql::as_integer(*value).value_or(-1);
  }
  base::Result<> flush(Store& store) { return loop.run_until_done(store.flush()); }
  bool comes(std::function<bool()> condition) {
    auto const wait = [&]() -> base::Task<bool> {
      for (int i = 0; i < 1000 && !condition(); ++i) co_await loop.sleep(10ms);
      co_return condition();
    };
    return loop.run_until_done(wait());
  }
  Feature feature(LayerKind layer, std::string id, base::UtcTime at) {
    auto made = random.feature(layer, std::move(id), "car park");
    made.account.at = at;
    return made;
  }

  base::Loop loop;
  map::testing::RandomFeatures random{1};
  Store::Options options;
  std::unique_ptr<sql::Database> database;
};

sql::Table const things = {.name = "things",
                           .about = "For tests",
                           .columns = {{"id", sql::ColumnKind::text, true},
                                       {"yes", sql::ColumnKind::boolean},
                                       {"size", sql::ColumnKind::integer},
                                       {"weight", sql::ColumnKind::real},
                                       {"at", sql::ColumnKind::time},
                                       {"data", sql::ColumnKind::bytes}},
                           .key = {"id"}};

TEST_F(Server, GivesBackWhatWasPut) {
  ASSERT_TRUE(database->execute("CREATE SCHEMA lapwing"));
  ASSERT_TRUE(database->execute(sql::create_statements(sql::Dialect::postgis, things)));
  auto const time = sql::time_of_nanoseconds(1'700'000'000'123'456'000);
  std::vector<sql::Row> rows;
  for (std::int64_t i = 0; i < 2000; ++i)
    rows.push_back({fmt::format("{}", i), true, i, 0.1, time, sql::Bytes{std::string("\0\xff", 2)}});
  rows.push_back({std::string("nothing"), {}, {}, {}, {}, {}});
  std::vector<std::string> const columns = {"id", "yes", "size", "weight", "at", "data"};
  ASSERT_TRUE(database->put(things, columns, rows));
  rows[7][2] = std::int64_t{-7};
  ASSERT_TRUE(database->put(things, columns, rows));
  EXPECT_EQ(number("SELECT count(*) FROM things"), 2001);
  auto const found =
      sql::rows_of(*database, "SELECT yes, size, weight, at, data FROM things WHERE id = $1", {std::string("7")});
  ASSERT_TRUE(found);
  EXPECT_EQ(found->front(), (sql::Row{true, std::int64_t{-7}, 0.1, time, sql::Bytes{std::string("\0\xff", 2)}}));
  auto const nothing = sql::rows_of(*database, "SELECT size FROM things WHERE id = 'nothing'");
  EXPECT_TRUE(sql::is_null(nothing->front().front()));
}

TEST_F(Server, SaysWhatIsWrongAndGoesOn) {
  ASSERT_TRUE(database->execute("CREATE SCHEMA lapwing"));
  ASSERT_TRUE(database->execute(sql::create_statements(sql::Dialect::postgis, things)));
  std::vector<sql::Row> rows(1000, {std::string("a"), std::string("no number")});
  auto const wrong = database->put(things, {"id", "size"}, rows);
  ASSERT_FALSE(wrong);
  EXPECT_EQ(
      wrong.error().message,
      "the server: ERROR:  invalid input syntax for type bigint: \"no number\" CONTEXT:  unnamed portal parameter "
      "$2 = '...'");
  auto const zero = database->put(things, {"id"}, {{std::string("a\0b", 3)}});
  EXPECT_EQ(zero.error().kind, base::ErrorKind::invalid_input);
  EXPECT_EQ(database->change("INSERT INTO things (id) VALUES ('a'), ('a')", {}).error().kind, base::ErrorKind::refused);
  EXPECT_EQ(number("SELECT count(*) FROM things"), 0);
}

TEST_F(Server, ThatIsNotThereIsAnError) {
  auto const refused = sql::open_postgres("postgresql://nobody:secret@/none?host=/nowhere", "postgresql://nobody@/none",
                                          sql::Access::write);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().kind, base::ErrorKind::lost);
  EXPECT_EQ(refused.error().message.find("secret"), std::string::npos);
}

TEST_F(Server, KeepsTheWholeMap) {
  auto const map = empty_map();
  GridKey const key{"car park", "0", "parking"};
  std::string hash;
  {
    auto const store = open();
    store->follow(*map);
    map->put_site(car_park());
    for (auto const layer : all_layers)
      for (int i = 0; i < 50; ++i) ASSERT_TRUE(map->put(feature(layer, fmt::format("{}", i), noon - 1h)));
    ASSERT_TRUE(map->remove(LayerKind::slots, "3", {"operator", noon}));
    OccupancyGrid grid(0.05);
    grid.set({5, -5}, Evidence::of_log_odds(2.0));
    ASSERT_TRUE(map->put_tiles(key, grid, {tile_of({5, -5})}, {"robot", noon}));
    store->name_session("run 1", "Morning");
    store->record({.at = noon, .session = "run 1", .feed = "f", .is_whole = true, .content = "whole"});
    auto const flushed = flush(*store);
    ASSERT_TRUE(flushed) << flushed.error().message;
    hash = loop.run_until_done(store->keep("picture", "image/png")).value();
  }
  auto const store = open();
  auto const found = empty_map();
  auto const loaded = loop.run_until_done(store->load(*found));
  ASSERT_TRUE(loaded) << loaded.error().message;
  EXPECT_EQ(store->health().trouble, "");
  for (auto const layer : all_layers) {
    EXPECT_EQ(found->size(layer), layer == LayerKind::slots ? 49u : 50u);
    for (auto const* record : map->within(layer, "car park", std::nullopt, 1000))
      EXPECT_EQ(found->find(layer, record->feature.id)->feature.account, record->feature.account);
  }
  EXPECT_TRUE(found->find(LayerKind::slots, "3")->is_removed);
  EXPECT_EQ(found->grids().at(key).grid.at({5, -5}).log_odds(), 2.0);
  EXPECT_EQ(loop.run_until_done(store->blob(hash))->bytes, "picture");
  EXPECT_EQ(loop.run_until_done(store->state_at("run 1", noon))->size(), 1u);
  EXPECT_EQ(loop.run_until_done(store->sessions())->front().name, "Morning");
  EXPECT_EQ(number("SELECT count(*) FROM lapwing.slots WHERE ST_IsValid(geom) AND ST_SRID(geom) = 4326"), 49);
}

TEST_F(Server, IsSharedByStationsThatSeeWhatTheOthersWrite) {
  auto const ours = empty_map(), theirs = empty_map();
  auto const our_store = open(), their_store = open();
  our_store->follow(*ours);
  their_store->follow(*theirs);
  ours->put_site(car_park());
  ASSERT_TRUE(comes([&] { return theirs->site("car park") != nullptr; }));
  auto const slot = feature(LayerKind::slots, "a", noon - 2h);
  ASSERT_TRUE(ours->put(slot));
  ASSERT_TRUE(comes([&] { return theirs->find(LayerKind::slots, "a") != nullptr; }));
  // Back, and newer.
  auto newer = slot;
  newer.account = {"another", noon - 1h};
  std::get<Slot>(newer.content).name = "B 7";
  ASSERT_TRUE(theirs->put(newer));
  ASSERT_TRUE(comes([&] { return ours->find(LayerKind::slots, "a")->feature.account == newer.account; }));
  ASSERT_TRUE(ours->remove(LayerKind::slots, "a", {"operator", noon}));
  ASSERT_TRUE(comes([&] { return theirs->find(LayerKind::slots, "a")->is_removed; }));
  GridKey const key{"car park", "0", "parking"};
  OccupancyGrid grid(0.05);
  grid.set({5, -5}, Evidence::of_log_odds(2.0));
  ASSERT_TRUE(ours->put_tiles(key, grid, {tile_of({5, -5})}, {"robot", noon}));
  ASSERT_TRUE(comes([&] { return theirs->grids().contains(key); }));
  EXPECT_EQ(theirs->grids().at(key).grid.at({5, -5}).log_odds(), 2.0);
}

TEST_F(Server, LetsNoOlderAccountCoverANewerOne) {
  auto const ours = empty_map(), theirs = empty_map();
  auto const our_store = open(), their_store = open();
  our_store->follow(*ours);
  their_store->follow(*theirs);
  ours->put_site(car_park());
  ASSERT_TRUE(flush(*our_store));
  ASSERT_TRUE(comes([&] { return theirs->site("car park") != nullptr; }));
  // Both tell of the same things at once, each of half of them later than the other, and neither has heard of the
  // other.
  for (int i = 0; i < 500; ++i) {
    auto const id = fmt::format("{}", i);
    auto told = feature(LayerKind::areas, id, noon - 2h + std::chrono::seconds(i % 2));
    told.account.writer = "ours";
    ASSERT_TRUE(ours->put(told));
    told.account = {"theirs", noon - 2h + std::chrono::seconds((i + 1) % 2)};
    ASSERT_TRUE(theirs->put(told));
  }
  ASSERT_TRUE(flush(*our_store));
  ASSERT_TRUE(flush(*their_store));
  EXPECT_EQ(
      number(
          "SELECT count(*) FROM lapwing.areas WHERE writer = CASE WHEN id::int % 2 = 1 THEN 'ours' ELSE 'theirs' END"),
      500);
  auto const agree = [&] {
    for (int i = 0; i < 500; ++i) {
      auto const* const winner = i % 2 == 1 ? "ours" : "theirs";
      for (auto* map : {ours.get(), theirs.get()})
        if (map->find(LayerKind::areas, fmt::format("{}", i))->feature.account.writer != winner) return false;
    }
    return our_store->health().waiting == 0 && their_store->health().waiting == 0;
  };
  ASSERT_TRUE(comes(agree));
  // And then it is quiet: nobody writes what the other has.
  auto const revision = number("SELECT revision FROM lapwing.lapwing_revision");
  auto const pause = [&]() -> base::Task<bool> {
    co_await loop.sleep(1500ms);
    co_return true;
  };
  loop.run_until_done(pause());
  EXPECT_EQ(number("SELECT revision FROM lapwing.lapwing_revision"), revision);
}

TEST_F(Server, HasWhatWasFlushedWhateverTheOthersWrote) {
  auto const ours = empty_map(), theirs = empty_map();
  auto const our_store = open(), their_store = open();
  our_store->follow(*ours);
  their_store->follow(*theirs);
  ours->put_site(car_park());
  ASSERT_TRUE(flush(*our_store));
  ASSERT_TRUE(comes([&] { return theirs->site("car park") != nullptr; }));
  GridKey const key{"car park", "0", "parking"};
  OccupancyGrid grid(0.05);
  grid.set({5, -5}, Evidence::of_log_odds(2.0));
  for (int i = 0; i < 10; ++i) {
    auto const at = noon - 1h + std::chrono::seconds(2 * i);
    // They move the site and write the same tile just before: what we have is written once it has been merged.
    theirs->put_site(geo::Site::make("car park", geo::Wgs84::from_degrees(47.5 + 0.1 * i, 8.5, 420.0)).value());
    ASSERT_TRUE(theirs->put_tiles(key, grid, {tile_of({5, -5})}, {"their robot", at + 1s}));
    ASSERT_TRUE(flush(*their_store));
    ASSERT_TRUE(ours->put(feature(LayerKind::walls, fmt::format("{}", i), noon - 1h)));
    ASSERT_TRUE(ours->put_tiles(key, grid, {tile_of({5, -5})}, {"our robot", at}));
    ASSERT_TRUE(flush(*our_store));
    EXPECT_EQ(number("SELECT count(*) FROM lapwing.walls"), i + 1);
    EXPECT_EQ(number("SELECT at_ns FROM lapwing.grid_tiles"), sql::nanoseconds(at + 1s)) << "theirs is newer";
    EXPECT_EQ(ours->grids().at(key).tile_times.begin()->second, at + 1s);
    ASSERT_TRUE(comes([&] { return theirs->size(LayerKind::walls) == static_cast<std::size_t>(i + 1); }));
  }
}

TEST_F(Server, IsReachedAgainAfterTheConnectionWasLost) {
  auto const map = empty_map();
  auto const store = open();
  store->follow(*map);
  map->put_site(car_park());
  ASSERT_TRUE(flush(*store));
  ASSERT_GT(number("SELECT count(pg_terminate_backend(pid)) FROM pg_stat_activity WHERE pid <> pg_backend_pid() AND "
                   "application_name = 'lapwing'"),
            0);
  ASSERT_TRUE(map->put(feature(LayerKind::walls, "a", noon - 1h)));
  ASSERT_TRUE(comes([&] { return store->health().waiting == 0; }));
  EXPECT_EQ(number("SELECT count(*) FROM lapwing.walls"), 1);
  auto const hash = loop.run_until_done(store->keep("picture", "image/png"));
  ASSERT_TRUE(hash);
  // The first to notice on the other connection may be told; the next is served.
  (void)loop.run_until_done(store->blob(*hash));
  EXPECT_TRUE(loop.run_until_done(store->blob(*hash)));
}

TEST_F(Server, LosesThePastThatIsTooOld) {
  auto const now = loop.utc_now();
  {
    auto const store = open();
    for (int day = 0; day < 5; ++day)
      store->record({.at = now - day * 24h + 1h, .session = fmt::format("day {}", day), .feed = "f", .content = "x"});
    ASSERT_TRUE(flush(*store));
  }
  options.longest = 24h;
  options.most_bytes = 1024 * 1024 * 1024;
  auto const store = open();
  EXPECT_TRUE(comes([&] { return number("SELECT count(*) FROM lapwing.sessions") == 2; }));
  EXPECT_TRUE(comes([&] { return store->health().bytes > 0; }));
}

TEST_F(Server, KeepsHowGridsLooked) {
  auto map = empty_map();
  map->put_site(car_park());
  auto store = open();
  store->follow(*map);
  GridKey const key{"car park", "", "ground"};
  OccupancyGrid grid(0.05);
  std::vector<TileShades> looked;
  for (int second = 0; second < 20; ++second) {
    for (int i = 0; i < 256; ++i) grid.set({i, (second * 7 + i * i) % 256}, Evidence::of_probability(0.9));
    ASSERT_TRUE(map->put_tiles(key, grid, {{0, 0}}, {"robot", noon - 1h + 1s * second}));
    loop.run_until_done(store->record_grids("today", noon - 1h + 1s * second));
    looked.push_back(shades_of(*map->grids().at(key).grid.tiles().at({0, 0})));
  }
  ASSERT_TRUE(flush(*store));
  EXPECT_GT(number("SELECT count(*) FROM tile_shades WHERE base <> ''"), 5);
  for (int second = 0; second < 20; ++second) {
    auto const grids = loop.run_until_done(store->grids_at("today", noon - 1h + 1s * second));
    ASSERT_TRUE(grids) << grids.error().message;
    auto const name = grids->at(key).tiles.at({0, 0});
    auto const shades = loop.run_until_done(store->shades({name}));
    ASSERT_TRUE(shades) << shades.error().message;
    EXPECT_EQ(*shades->at(name) == looked[static_cast<std::size_t>(second)], true) << second;
  }
  store.reset();
  auto const bytes = place::open_bytes(place::Address(options.address), *database);
  while (care::retain(*database, *bytes, {.longest = 1h}, noon + 2h).value_or(false)) {
  }
  EXPECT_EQ(number("SELECT count(*) FROM tile_shades"), 0);
}

}  // namespace
}  // namespace lapwing::map
