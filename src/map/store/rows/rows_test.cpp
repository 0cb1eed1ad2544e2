#include <gtest/gtest.h>

#include "base/testing/temporary_folder.hpp"
#include "map/features/properties.hpp"
#include "map/store/rows/feature_rows.hpp"
#include "map/store/rows/grid_rows.hpp"
#include "map/store/rows/shapes.hpp"
#include "map/store/rows/shown_rows.hpp"
#include "map/store/rows/site_rows.hpp"
#include "map/store/rows/zlib.hpp"
#include "map/store/schema/migrate.hpp"
#include "map/store/sql/sqlite.hpp"
#include "map/testing/random_features.hpp"

namespace lapwing::map::rows {
namespace {

using namespace std::chrono_literals;

geo::Site car_park(double lon_deg = 8.5) {
  geo::Floor const ground{.id = "0", .name = "Ground floor"};
  geo::Floor const upper{
      .id = "1", .name = "Upper floor", .up_m = 3.5, .site_from_floor = {geo::Point<geo::SiteFrame>(12.0, -7.5), 0.3}};
  return geo::Site::make("car park", geo::Wgs84::from_degrees(47.4, lon_deg, 420.0), {ground, upper}).value();
}

struct Rows : ::testing::Test {
  Rows() : database(sql::open_sqlite(folder.path() / "map.gpkg", sql::Access::write).value()) {
    EXPECT_TRUE(schema::prepare(*database, "map.gpkg"));
    sites.emplace("car park", car_park());
    EXPECT_TRUE(write_site(*database, car_park(), 1));
  }
  std::int64_t count(std::string const& of) const {
    return sql::as_integer(sql::value_of(*database, "SELECT count(*) FROM " + of).value()).value();
  }
  base::testing::TemporaryFolder folder;
  std::unique_ptr<sql::Database> database;
  Sites sites;
};

void expect_same_place(Geometry const& a, Geometry const& b) {
  auto const [first, second] = std::pair(bounds(a), bounds(b));
  EXPECT_LT(geo::distance_m(first.least, second.least), 1e-6);
  EXPECT_LT(geo::distance_m(first.most, second.most), 1e-6);
  EXPECT_EQ(point_count(a), point_count(b));
}

TEST_F(Rows, GiveBackEveryKindOfFeatureAsItWas) {
  map::testing::RandomFeatures random(1);
  for (auto const layer : all_layers) {
    std::vector<FeatureRecord> records;
    for (int i = 0; i < 50; ++i) {
      records.push_back({.feature = random.feature(layer, fmt::format("{} {}", name_of(layer), i), "car park")});
      auto& feature = records.back().feature;
      if (random.chance()) feature.floor = "1";
      if (random.chance())
        feature.held_over = {{std::string(properties_of(layer).front().name), {"robot \"1\"", random.time()}}};
    }
    ASSERT_TRUE(write_features(*database, records, sites, 2));
    auto const page = read_page(*database, layer, sites, 0, 1000);
    ASSERT_TRUE(page);
    EXPECT_EQ(page->faults, std::vector<std::string>());
    EXPECT_TRUE(page->is_last);
    ASSERT_EQ(page->features.size(), records.size());
    for (std::size_t i = 0; i < records.size(); ++i) {
      auto const& [wanted, found] = std::pair(records[i].feature, page->features[i]);
      EXPECT_EQ(found.id, wanted.id);
      EXPECT_EQ(found.site, wanted.site);
      EXPECT_EQ(found.floor, wanted.floor);
      EXPECT_EQ(found.account, wanted.account) << "to the nanosecond";
      EXPECT_EQ(found.held_over, wanted.held_over);
      expect_same_place(geometry_of(found.content), geometry_of(wanted.content));
      for (auto const& property : properties_of(layer))
        EXPECT_EQ(property.get(found.content), property.get(wanted.content)) << wanted.id << ' ' << property.name;
    }
  }
}

TEST_F(Rows, ComeInPages) {
  map::testing::RandomFeatures random(2);
  std::vector<FeatureRecord> records;
  for (int i = 0; i < 25; ++i)
    records.push_back({.feature = random.feature(LayerKind::walls, fmt::format("{}", i), "car park")});
  ASSERT_TRUE(write_features(*database, records, sites, 2));
  std::size_t seen = 0;
  std::int64_t last = 0;
  for (bool is_last = false; !is_last;) {
    auto const page = read_page(*database, LayerKind::walls, sites, last, 10);
    ASSERT_TRUE(page);
    seen += page->features.size();
    last = page->last_fid;
    is_last = page->is_last;
  }
  EXPECT_EQ(seen, 25u);
}

TEST_F(Rows, StayInOnePieceAcrossTheAntimeridian) {
  auto const island = geo::Site::make("island", geo::Wgs84::from_degrees(-17.0, 179.9999, 0.0)).value();
  sites.emplace("island", island);
  ASSERT_TRUE(write_site(*database, island, 1));
  Feature const wall{.id = "w",
                     .site = "island",
                     .account = {"a", base::UtcTime(1'700'000'000s)},
                     .content = Wall{.line = {{SitePoint(-50.0, 0.0), SitePoint(50.0, 0.0)}}}};
  ASSERT_TRUE(write_features(*database, {{.feature = wall}}, sites, 2));
  auto const page = read_page(*database, LayerKind::walls, sites, 0, 10);
  ASSERT_EQ(page->features.size(), 1u);
  expect_same_place(geometry_of(page->features[0].content), geometry_of(wall.content));
  auto const row = row_of(wall, island, 1);
  auto const& shape = std::get<sql::Shape>(row[0]);
  EXPECT_LT(shape.most_lon - shape.least_lon, 0.01);
}

TEST_F(Rows, ThatHoldNoFeatureAreNamedAndTheOthersRead) {
  map::testing::RandomFeatures random(3);
  ASSERT_TRUE(write_features(*database,
                             {{.feature = random.feature(LayerKind::slots, "a", "car park")},
                              {.feature = random.feature(LayerKind::slots, "b", "car park")}},
                             sites, 2));
  ASSERT_TRUE(database->change("UPDATE slots SET state = 'on fire' WHERE id = 'a'", {}));
  auto const page = read_page(*database, LayerKind::slots, sites, 0, 10);
  ASSERT_TRUE(page);
  ASSERT_EQ(page->features.size(), 1u);
  EXPECT_EQ(page->faults,
            std::vector<std::string>{"slots \"a\" in the store: state takes one of the words unknown, free, taken"});
}

TEST_F(Rows, TakeATimeThatAPersonHasSetAndElseTheExactOne) {
  map::testing::RandomFeatures random(4);
  auto feature = random.feature(LayerKind::areas, "a", "car park");
  feature.account.at = sql::time_of_nanoseconds(1'700'000'000'123'456'789);
  ASSERT_TRUE(write_features(*database, {{.feature = feature}}, sites, 2));
  auto const read = [&] { return read_page(*database, LayerKind::areas, sites, 0, 1)->features.at(0).account.at; };
  EXPECT_EQ(read(), feature.account.at);
  ASSERT_TRUE(database->change("UPDATE areas SET at = '2026-01-02T03:04:05.000Z'", {}));
  EXPECT_EQ(read(), sql::time_of_nanoseconds(1'767'323'045'000'000'000));
}

TEST_F(Rows, OfWhatIsRemovedAreRemembered) {
  map::testing::RandomFeatures random(5);
  auto const feature = random.feature(LayerKind::slots, "a", "car park");
  ASSERT_TRUE(write_features(*database, {{.feature = feature}}, sites, 2));
  auto gone = feature;
  gone.account.at += 1s;
  ASSERT_TRUE(write_features(*database, {{.is_removed = true, .feature = gone, .removal = gone.account}}, sites, 3));
  EXPECT_EQ(count("slots"), 0);
  EXPECT_EQ(count("rtree_slots_geom"), 0);
  auto const changes = changes_since(*database, sites, 2);
  ASSERT_TRUE(changes);
  ASSERT_EQ(changes->removals.size(), 1u);
  EXPECT_EQ(changes->removals[0].account, gone.account);
  EXPECT_EQ(changes->removals[0].id, "a");
  auto again = feature;
  again.account.at += 2s;
  ASSERT_TRUE(write_features(*database, {{.feature = again, .removal = gone.account}}, sites, 4));
  EXPECT_EQ(count("slots"), 1);
  EXPECT_EQ(count("removed"), 1) << "news from before its removal may still come";
  ASSERT_TRUE(write_features(*database, {{.feature = again}}, sites, 5));
  EXPECT_EQ(count("removed"), 0);
}

TEST_F(Rows, AreFoundByWhereTheyLie) {
  std::vector<FeatureRecord> records;
  for (int i = 0; i < 100; ++i)
    records.push_back({.feature = {.id = fmt::format("{}", i),
                                   .site = "car park",
                                   .account = {"a", base::UtcTime(1'700'000'000s)},
                                   .content = PointOfInterest{.position = SitePoint(10.0 * i, 0.0)}}});
  ASSERT_TRUE(write_features(*database, records, sites, 2));
  // One that moves: its old place must not be found any more.
  std::get<PointOfInterest>(records[5].feature.content).position = SitePoint(0.0, 5000.0);
  ASSERT_TRUE(write_features(*database, {records[5]}, sites, 3));
  auto const ring =
      on_globe(SitePolygon{{{{35.0, -1.0}, {75.0, -1.0}, {75.0, 1.0}, {35.0, 1.0}}}}, sites.at("car park"));
  auto const shape = sql::shape_of(ring);
  auto const found = features_within(*database, LayerKind::points_of_interest, sites,
                                     {shape.least_lon, shape.most_lon, shape.least_lat, shape.most_lat}, 10);
  ASSERT_TRUE(found);
  std::vector<std::string> ids;
  for (auto const& feature : *found) ids.push_back(feature.id);
  EXPECT_EQ(ids, (std::vector<std::string>{"4", "6", "7"}));
}

TEST_F(Rows, GiveBackSitesWithTheirFloors) {
  auto const read = read_sites(*database);
  ASSERT_TRUE(read);
  auto const& site = read->at("car park");
  EXPECT_NEAR(site.anchor().lat_deg(), 47.4, 1e-13);
  ASSERT_EQ(site.floors().size(), 2u);
  EXPECT_EQ(site.floors()[1].name, "Upper floor");
  EXPECT_EQ(site.floors()[1].up_m, 3.5);
  EXPECT_NEAR(site.floors()[1].site_from_floor.yaw_rad(), 0.3, 1e-15);
  auto const smaller = geo::Site::make("car park", car_park().anchor()).value();
  ASSERT_TRUE(write_site(*database, smaller, 2));
  EXPECT_EQ(read_sites(*database)->at("car park").floors().size(), 1u);
}

GridPart grid_part(double resolution_m = 0.05) {
  return {.resolution_m = resolution_m,
          .site_from_grid = {geo::Point<geo::SiteFrame>(1.0, 2.0), 0.5},
          .account = {"robot 1", base::UtcTime(1'700'000'000s)}};
}

std::shared_ptr<GridTile const> tile(double log_odds) {
  auto made = std::make_shared<GridTile>();
  for (std::size_t i = 0; i < made->cells.size(); i += 3) made->cells[i] = Evidence::of_log_odds(log_odds);
  return made;
}

TEST_F(Rows, GiveBackTilesCellByCell) {
  GridKey const key{"car park", "0", "floor"};
  auto part = grid_part();
  part.tiles = {{{0, 0}, {tile(1.5), part.account.at}}, {{-1, 3}, {tile(-20.0), part.account.at + 1ns}}};
  ASSERT_TRUE(write_grid(*database, key, part, 2));
  auto const grids = read_grids(*database);
  ASSERT_EQ(grids->size(), 1u);
  EXPECT_EQ(grids->at(key).resolution_m, 0.05);
  EXPECT_EQ(grids->at(key).account, part.account);
  EXPECT_EQ(grids->at(key).site_from_grid.origin(), part.site_from_grid.origin());
  auto const tiles = read_tiles(*database, key);
  ASSERT_TRUE(tiles);
  ASSERT_EQ(tiles->size(), 2u);
  for (auto const& [where, wanted] : part.tiles) {
    EXPECT_EQ(tiles->at(where).tile->cells, wanted.tile->cells);
    EXPECT_EQ(tiles->at(where).at, wanted.at);
  }
}

TEST_F(Rows, ForgetTilesOfAGridThatIsMadeAnew) {
  GridKey const key{"car park", "0", "floor"};
  auto part = grid_part();
  part.tiles = {{{0, 0}, {tile(1.5)}}, {{1, 0}, {tile(1.5)}}};
  ASSERT_TRUE(write_grid(*database, key, part, 2));
  part.tiles = {{{1, 0}, {}}};
  ASSERT_TRUE(write_grid(*database, key, part, 3));
  EXPECT_EQ(read_tiles(*database, key)->at({1, 0}).tile, nullptr);
  EXPECT_EQ(read_tiles(*database, key)->size(), 2u);
  auto coarser = grid_part(0.1);
  coarser.tiles = {{{5, 5}, {tile(1.0)}}};
  ASSERT_TRUE(write_grid(*database, key, coarser, 4));
  auto const tiles = read_tiles(*database, key);
  ASSERT_EQ(tiles->size(), 1u);
  EXPECT_TRUE(tiles->contains({5, 5}));
}

TEST(Tiles, ThatAreDamagedAreNone) {
  auto const cells = packed(*tile(1.0));
  ASSERT_TRUE(unpacked(cells));
  EXPECT_FALSE(unpacked(cells.substr(0, cells.size() / 2)));
  EXPECT_FALSE(unpacked("no zlib stream"));
  EXPECT_FALSE(unpacked(deflated(std::string(1000, 'x')))) << "another number of bytes";
  EXPECT_FALSE(unpacked(deflated(std::string(131072, '\x7f')))) << "beyond what evidence may be";
}

struct ShownRows : Rows {
  static base::UtcTime second(double s) { return base::UtcTime(1'700'000'000s) + base::from_seconds(s); }
  static Store::Shown frame(std::string feed, double s, std::string content, bool is_whole = false) {
    return {.at = second(s),
            .session = "run 1",
            .feed = std::move(feed),
            .is_whole = is_whole,
            .content = std::move(content)};
  }
  static std::string contents(std::vector<Store::Shown> const& frames) {
    std::string all;
    for (auto const& one : frames) all += one.content + " ";
    return all;
  }
};

TEST_F(ShownRows, LeadToTheStateOfEachFeed) {
  ASSERT_TRUE(write_shown(
      *database, {frame("vehicles", 0, "V0", true), frame("slots", 0.5, "S0", true), frame("vehicles", 1, "v1")}));
  ASSERT_TRUE(write_shown(*database, {frame("vehicles", 2, "v2"), frame("vehicles", 3, "V3", true),
                                      frame("vehicles", 4, "v4"), frame("slots", 4.5, "s4")}));
  ASSERT_TRUE(write_shown(*database, {frame("vehicles", 5, "v5"), frame("vehicles", 6, "V6", true)}));
  auto const at = [&](double s) { return contents(state_at(*database, "run 1", second(s)).value()); };
  EXPECT_EQ(at(-1), "");
  EXPECT_EQ(at(0), "V0 ");
  EXPECT_EQ(at(1.5), "V0 S0 v1 ");
  EXPECT_EQ(at(2.5), "V0 S0 v1 v2 ");
  EXPECT_EQ(at(4.2), "S0 V3 v4 ");
  EXPECT_EQ(at(5.5), "S0 V3 v4 s4 v5 ");
  EXPECT_EQ(at(100), "S0 s4 V6 ");
  EXPECT_EQ(contents(state_at(*database, "another", second(1)).value()), "");
}

TEST_F(ShownRows, ComeInTheOrderOfTimeAndNoMoreThanAskedFor) {
  for (int batch = 0; batch < 10; ++batch)
    ASSERT_TRUE(write_shown(
        *database, {frame("a", batch, fmt::format("a{}", batch)), frame("b", batch + 0.5, fmt::format("b{}", batch)),
                    frame("a", batch + 0.75, fmt::format("A{}", batch))}));
  auto const between = [&](double from, double to, std::size_t most) {
    return contents(shown_between(*database, "run 1", second(from), second(to), most).value());
  };
  EXPECT_EQ(between(1, 2.5, 100), "a1 b1 A1 a2 ");
  EXPECT_EQ(between(1.25, 100, 4), "b1 A1 a2 b2 ");
  EXPECT_EQ(between(9.5, 9.75, 100), "b9 ");
  EXPECT_EQ(between(20, 30, 100), "");
}

TEST_F(ShownRows, TellOfTheirSessions) {
  ASSERT_TRUE(write_shown(*database, {frame("a", 5, "x"), frame("a", 6, "y")}));
  ASSERT_TRUE(write_shown(*database, {frame("a", 9, "z")}));
  auto const sessions = read_sessions(*database);
  ASSERT_EQ(sessions->size(), 1u);
  EXPECT_EQ(sessions->front().id, "run 1");
  EXPECT_EQ(sessions->front().began, second(5));
  EXPECT_EQ(sessions->front().ended, second(9));
}

TEST_F(ShownRows, KeepBytesAndFlags) {
  Store::Shown wanted = frame("grid", 1, std::string("\0\x01\xff", 3), true);
  wanted.is_binary = true;
  ASSERT_TRUE(write_shown(*database, {wanted}));
  auto const found = shown_between(*database, "run 1", second(0), second(2), 10);
  ASSERT_EQ(found->size(), 1u);
  EXPECT_EQ(found->front().content, wanted.content);
  EXPECT_TRUE(found->front().is_binary);
  EXPECT_TRUE(found->front().is_whole);
  EXPECT_EQ(found->front().feed, "grid");
}

}  // namespace
}  // namespace lapwing::map::rows
