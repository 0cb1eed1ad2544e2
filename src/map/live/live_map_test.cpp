#include "map/live/live_map.hpp"

#include <set>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "map/testing/random_features.hpp"

namespace lapwing::map {
namespace {

using namespace std::chrono_literals;
using base::ErrorKind;
using Outcome = LiveMap::Outcome;

constexpr auto now = base::UtcTime(1'795'255'972s);

geo::Site yard(double lat_deg = 41.0) {
  return *geo::Site::make("yard", geo::Wgs84::from_degrees(lat_deg, -8.0), {{.id = "0"}, {.id = "1", .up_m = 3.0}});
}

Account account(int seconds, std::string writer = "drone 1") {
  return {.writer = std::move(writer), .at = now + std::chrono::seconds(seconds)};
}

Feature poi(std::string id, SitePoint const& position, int seconds = 0) {
  return {.id = std::move(id),
          .site = "yard",
          .account = account(seconds),
          .content = PointOfInterest{.position = position}};
}

constexpr auto layer = LayerKind::points_of_interest;

struct LiveMapTest : ::testing::Test {
  LiveMapTest() { map.put_site(yard()); }

  std::vector<std::string> ids_within(std::optional<SiteBox> const& box, std::size_t most = 100) const {
    std::vector<std::string> ids;
    for (auto const* record : map.within(layer, "yard", box, most)) ids.push_back(record->feature.id);
    return ids;
  }

  LiveMap map{[] { return now; }};
};

TEST_F(LiveMapTest, TakesAFeatureAndFindsIt) {
  EXPECT_EQ(map.put(poi("door", {1.0, 2.0})), Outcome::changed);
  auto const* record = map.find(layer, "door");
  ASSERT_TRUE(record);
  EXPECT_EQ(record->revision, map.revision());
  EXPECT_FALSE(record->is_removed);
  EXPECT_EQ(map.size(layer), 1U);
  EXPECT_EQ(map.find(LayerKind::walls, "door"), nullptr) << "ids are unique in a layer";
  EXPECT_EQ(map.put(poi("door", {1.0, 2.0})), Outcome::outdated);
  EXPECT_EQ(map.put(poi("door", {5.0, 2.0}, -1)), Outcome::outdated);
  EXPECT_EQ(record->revision, map.revision()) << "what changes nothing has no revision";
}

TEST_F(LiveMapTest, RefusesWithTheReason) {
  auto const error_of = [&](Feature feature) {
    auto const outcome = map.put(std::move(feature));
    return outcome ? base::Error{ErrorKind::io, "taken"} : outcome.error();
  };
  auto feature = poi("door", {});
  feature.site = "moon";
  EXPECT_EQ(error_of(feature).kind, ErrorKind::not_found);
  EXPECT_EQ(error_of(feature).message, "\"door\" of the layer points_of_interest: there is no site \"moon\"");
  feature.site = "yard";
  feature.floor = "9";
  EXPECT_EQ(error_of(feature).kind, ErrorKind::not_found);
  EXPECT_EQ(error_of(feature).message, "\"door\" of the layer points_of_interest: the site yard has no floor \"9\"");
  feature.floor = "1";
  feature.id = "a\nb";
  EXPECT_EQ(error_of(feature).kind, ErrorKind::invalid_input);
  EXPECT_EQ(error_of(feature).message,
            "a feature of the layer points_of_interest: id has the control character U+000A");
  EXPECT_EQ(map.revision(), 1U) << "of the site";
}

TEST_F(LiveMapTest, RefusesClocksThatAreFarAhead) {
  EXPECT_TRUE(map.put(poi("door", {}, 599)));
  auto const ahead = map.put(poi("door", {1.0, 0.0}, 601));
  ASSERT_FALSE(ahead);
  EXPECT_EQ(ahead.error().kind, ErrorKind::refused);
  EXPECT_EQ(ahead.error().message,
            "\"door\" of the layer points_of_interest: drone 1 tells of 2026-11-21T10:22:53.000Z, and here it is "
            "2026-11-21T10:12:52.000Z");
  EXPECT_EQ(ahead.error().hint, "one of the two clocks is wrong: set it");
  EXPECT_EQ(map.remove(layer, "door", account(601)).error().kind, ErrorKind::refused);
  EXPECT_EQ(map.put_tiles({"yard", "", "floor"}, OccupancyGrid(0.1), {{0, 0}}, account(601)).error().kind,
            ErrorKind::refused);
  EXPECT_TRUE(map.restore({.feature = poi("gate", {}, 86'400)}))
      << "what was taken once is not lost by a clock set back";
}

TEST_F(LiveMapTest, TakesAllOrNone) {
  int told = 0;
  auto const following = map.follow([&](MapChange const&) { ++told; });
  auto const before = map.revision();
  std::vector<Feature> features = {poi("a", {}), poi("b", {}), poi("c", {200'000.0, 0.0})};
  auto const refused = map.put_all(features);
  ASSERT_FALSE(refused);
  EXPECT_TRUE(refused.error().message.starts_with("\"c\" of the layer points_of_interest: "))
      << refused.error().message;
  EXPECT_EQ(map.size(layer), 0U);
  EXPECT_EQ(map.revision(), before);
  EXPECT_EQ(told, 0);
  features.back() = poi("a", {9.0, 0.0}, 5);
  EXPECT_EQ(map.put_all(features), 2U) << "one of them twice";
  EXPECT_EQ(told, 1);
  EXPECT_EQ(std::get<PointOfInterest>(map.find(layer, "a")->feature.content).position, SitePoint(9.0, 0.0));
}

TEST_F(LiveMapTest, RefusesAnotherPictureUnderAKnownId) {
  auto const picture = [](char digit) {
    return Feature{.id = "p",
                   .site = "yard",
                   .account = account(0),
                   .content = Picture{.image = std::string(64, digit), .taken_at = now}};
  };
  EXPECT_TRUE(map.put(picture('a')));
  EXPECT_EQ(map.put(picture('b')).error().kind, ErrorKind::refused);
  EXPECT_EQ(map.put_all({picture('a'), picture('a')}), 0U);
}

TEST_F(LiveMapTest, FindsWhatLiesWithinABox) {
  for (int i = 0; i < 10; ++i) EXPECT_TRUE(map.put(poi(fmt::format("p{}", i), {10.0 * i, 0.0})));
  EXPECT_EQ(ids_within(SiteBox{{15.0, -1.0}, {40.0, 1.0}}), (std::vector<std::string>{"p2", "p3", "p4"}));
  EXPECT_EQ(ids_within(SiteBox{{15.0, -1.0}, {40.0, 1.0}}, 2), (std::vector<std::string>{"p2", "p3"}));
  EXPECT_EQ(ids_within(std::nullopt).size(), 10U);
  EXPECT_EQ(ids_within(std::nullopt, 3), (std::vector<std::string>{"p0", "p1", "p2"}));
  EXPECT_TRUE(map.put(poi("p3", {500.0, 0.0}, 1)));
  EXPECT_TRUE(map.remove(layer, "p4", account(1)));
  EXPECT_EQ(ids_within(SiteBox{{15.0, -1.0}, {40.0, 1.0}}), (std::vector<std::string>{"p2"}));
  EXPECT_EQ(ids_within(SiteBox{{499.0, -1.0}, {501.0, 1.0}}), (std::vector<std::string>{"p3"}));
  EXPECT_TRUE(map.within(layer, "office", std::nullopt, 10).empty());
  EXPECT_TRUE(map.within(layer, "office", SiteBox{}, 10).empty());
}

TEST_F(LiveMapTest, FollowsAFeatureIntoAnotherSite) {
  map.put_site(*geo::Site::make("office", geo::Wgs84::from_degrees(41.0, -8.0)));
  EXPECT_TRUE(map.put(poi("door", {1.0, 1.0})));
  auto moved = poi("door", {1.0, 1.0}, 1);
  moved.site = "office";
  EXPECT_TRUE(map.put(moved));
  EXPECT_TRUE(ids_within(SiteBox{{}, {2.0, 2.0}}).empty());
  EXPECT_EQ(map.within(layer, "office", SiteBox{{}, {2.0, 2.0}}, 9).size(), 1U);
}

TEST_F(LiveMapTest, RemembersRemovals) {
  EXPECT_TRUE(map.put(poi("door", {})));
  auto const before = map.revision();
  EXPECT_EQ(map.remove(layer, "door", account(5, "operator")), Outcome::changed);
  auto const* record = map.find(layer, "door");
  ASSERT_TRUE(record);
  EXPECT_TRUE(record->is_removed);
  EXPECT_EQ(record->feature.account, account(5, "operator"));
  EXPECT_EQ(record->feature.site, "yard");
  EXPECT_EQ(layer_of(record->feature.content), layer);
  EXPECT_EQ(map.changed_since(layer, before), std::vector{record});
  EXPECT_EQ(map.size(layer), 0U);
  EXPECT_EQ(map.put(poi("door", {}, 4)), Outcome::outdated);
  EXPECT_EQ(map.remove(layer, "door", account(7)), Outcome::outdated) << "it is gone already";
  EXPECT_EQ(map.put(poi("door", {}, 6)), Outcome::outdated) << "and was gone later";
  EXPECT_EQ(map.put(poi("door", {}, 8)), Outcome::changed);
  EXPECT_EQ(map.size(layer), 1U);
  EXPECT_EQ(map.remove(layer, "door", account(6)), Outcome::outdated);
  EXPECT_EQ(map.remove(layer, "window", account(6)).error().kind, ErrorKind::not_found);
}

TEST_F(LiveMapTest, ForgetsTheOldestRemovals) {
  std::vector<Feature> features;
  for (std::size_t i = 0; i < most_removals + 10; ++i) features.push_back(poi(fmt::format("p{:06}", i), {}));
  EXPECT_TRUE(map.put_all(features));
  EXPECT_EQ(map.oldest_remembered(layer), 0U);
  Revision tenth = 0;
  for (std::size_t i = 0; i < features.size(); ++i) {
    EXPECT_TRUE(map.remove(layer, features[i].id, account(1)));
    if (i == 9) tenth = map.revision();
  }
  EXPECT_EQ(map.oldest_remembered(layer), tenth);
  EXPECT_EQ(map.find(layer, "p000009"), nullptr);
  EXPECT_TRUE(map.find(layer, "p000010"));
  EXPECT_EQ(map.changed_since(layer, tenth).size(), most_removals);
  EXPECT_EQ(map.size(layer), 0U);
}

TEST_F(LiveMapTest, TellsWhatChangedSinceARevision) {
  EXPECT_TRUE(map.put_all({poi("a", {}), poi("b", {}), poi("c", {})}));
  auto const before = map.revision();
  EXPECT_TRUE(map.put(poi("c", {1.0, 0.0}, 1)));
  EXPECT_TRUE(map.put(poi("a", {1.0, 0.0}, 1)));
  std::vector<std::string> ids;
  for (auto const* record : map.changed_since(layer, before)) ids.push_back(record->feature.id);
  EXPECT_EQ(ids, (std::vector<std::string>{"c", "a"}));
  std::set<Revision> revisions;
  for (auto const* record : map.changed_since(layer, 0)) revisions.insert(record->revision);
  EXPECT_EQ(revisions.size(), 3U) << "each has its own, also those of one call";
  EXPECT_TRUE(map.changed_since(layer, map.revision()).empty());
  EXPECT_EQ(map.changed_since(layer, before, 1), std::vector{map.changed_since(layer, before).front()});
}

TEST_F(LiveMapTest, TellsFollowersUntilTheyEnd) {
  std::vector<std::string> told;
  auto following = map.follow([&](MapChange const& change) {
    for (auto const* record : change.features) told.push_back(record->feature.id);
    EXPECT_EQ(change.revision, map.revision());
  });
  std::shared_ptr<void> other;
  other = map.follow([&](MapChange const&) { other.reset(); });
  EXPECT_TRUE(map.put_all({poi("a", {}), poi("b", {})}));
  EXPECT_TRUE(map.put(poi("a", {}, -1)));
  EXPECT_EQ(told, (std::vector<std::string>{"a", "b"}));
  following.reset();
  EXPECT_TRUE(map.put(poi("c", {})));
  EXPECT_EQ(told.size(), 2U);
}

TEST_F(LiveMapTest, MovesWithItsSite) {
  EXPECT_TRUE(map.put(poi("a", {1.0, 2.0})));
  EXPECT_TRUE(map.put_tiles({"yard", "", "floor"}, OccupancyGrid(0.1), {{0, 0}}, account(0)));
  auto const before = map.revision();
  std::vector<std::size_t> told;
  auto const following = map.follow([&](MapChange const& change) {
    EXPECT_EQ(change.site, "yard");
    told.push_back(change.features.size());
  });
  map.put_site(yard());
  EXPECT_TRUE(told.empty()) << "nothing is new";
  map.put_site(yard(42.0));
  map.put_site(*geo::Site::make("yard", geo::Wgs84::from_degrees(42.0, -8.0), {{.id = "0", .name = "Ground"}}));
  EXPECT_EQ(told, (std::vector<std::size_t>{1, 0}))
      << "what lies in it moves on the globe, and stays with other floors";
  EXPECT_GT(map.find(layer, "a")->revision, before);
  EXPECT_GT(map.grids().begin()->second.tile_revisions.at({0, 0}), before);
  EXPECT_EQ(std::get<PointOfInterest>(map.find(layer, "a")->feature.content).position, SitePoint(1.0, 2.0));
}

TEST_F(LiveMapTest, RestoresWhatWasKept) {
  auto feature = poi("door", {}, -5);
  feature.floor = "9";  // the site had it then
  EXPECT_TRUE(map.restore({.feature = feature, .removal = account(-10)}));
  EXPECT_EQ(map.find(layer, "door")->feature, feature);
  EXPECT_EQ(map.find(layer, "door")->removal, account(-10));
  EXPECT_TRUE(map.restore({.is_removed = true, .feature = poi("gate", {}, -3)}));
  EXPECT_TRUE(map.find(layer, "gate")->is_removed);
  EXPECT_EQ(map.find(layer, "gate")->feature.site, "yard");
  EXPECT_EQ(map.put(poi("gate", {}, -4)), Outcome::outdated);
  feature.site = "moon";
  EXPECT_EQ(map.restore({.feature = feature}).error().kind, ErrorKind::not_found);
  feature.id = "";
  EXPECT_EQ(map.restore({.feature = feature}).error().kind, ErrorKind::invalid_input);
}

struct GridOfLiveMap : LiveMapTest {
  GridOfLiveMap() {
    grid.set({1, 1}, Evidence::of_log_odds(1.0));
    grid.set({300, 1}, Evidence::of_log_odds(1.0));
  }
  GridKey const key{"yard", "1", "robot 1"};
  OccupancyGrid grid{0.05};
};

TEST_F(GridOfLiveMap, TakesTilesAndTellsThem) {
  std::vector<TileKey> told;
  auto const following = map.follow([&](MapChange const& change) {
    ASSERT_TRUE(change.grid);
    EXPECT_EQ(change.grid_key, key);
    told = change.tiles;
  });
  EXPECT_EQ(map.put_tiles(key, grid, {{1, 0}, {0, 0}, {1, 0}}, account(0)), Outcome::changed);
  EXPECT_EQ(told, (std::vector<TileKey>{{0, 0}, {1, 0}}));
  auto const& record = map.grids().at(key);
  EXPECT_EQ(record.grid.at({300, 1}), Evidence::of_log_odds(1.0));
  EXPECT_EQ(record.made, record.revision);
  auto const first = record.revision;
  grid.set_tile({1, 0}, nullptr);
  EXPECT_EQ(map.put_tiles(key, grid, {{1, 0}}, account(1)), Outcome::changed);
  EXPECT_EQ(record.grid.tiles().size(), 1U);
  EXPECT_EQ(record.tile_revisions.at({1, 0}), map.revision()) << "a tile that is gone is news";
  EXPECT_EQ(record.tile_revisions.at({0, 0}), first);
  EXPECT_EQ(record.made, first);
}

TEST_F(GridOfLiveMap, IsNotCoveredByOlderTiles) {
  EXPECT_TRUE(map.put_tiles(key, grid, {{0, 0}}, account(5)));
  OccupancyGrid older(0.05);
  older.set({1, 1}, Evidence::of_log_odds(-1.0));
  older.set({300, 1}, Evidence::of_log_odds(-1.0));
  EXPECT_EQ(map.put_tiles(key, older, {{0, 0}}, account(4)), Outcome::outdated);
  EXPECT_EQ(map.put_tiles(key, older, {{0, 0}, {1, 0}}, account(4)), Outcome::changed);
  auto const& record = map.grids().at(key);
  EXPECT_EQ(record.grid.at({1, 1}), Evidence::of_log_odds(1.0));
  EXPECT_EQ(record.grid.at({300, 1}), Evidence::of_log_odds(-1.0));
  EXPECT_EQ(record.account, account(5));
}

TEST_F(GridOfLiveMap, IsMadeAnewElsewhere) {
  EXPECT_TRUE(map.put_tiles(key, grid, {{0, 0}, {1, 0}}, account(5)));
  OccupancyGrid turned(0.05, {{}, 0.1});
  EXPECT_EQ(map.put_tiles(key, turned, {{0, 0}}, account(4)), Outcome::outdated);
  turned.set({1, 1}, Evidence::of_log_odds(3.0));
  EXPECT_EQ(map.put_tiles(key, turned, {{0, 0}}, account(6)), Outcome::changed);
  auto const& record = map.grids().at(key);
  EXPECT_EQ(record.made, map.revision());
  EXPECT_EQ(record.grid.tiles().size(), 1U);
  EXPECT_EQ(record.grid.site_from_grid().yaw_rad(), turned.site_from_grid().yaw_rad());
}

TEST_F(GridOfLiveMap, IsRefusedWithTheReason) {
  auto const error_of = [&](GridKey const& where, OccupancyGrid const& from, std::vector<TileKey> const& tiles) {
    auto const outcome = map.put_tiles(where, from, tiles, account(0));
    return outcome ? base::Error{ErrorKind::io, "taken"} : outcome.error();
  };
  EXPECT_EQ(error_of({"moon", "", "g"}, grid, {{0, 0}}).message, "the grid \"g\": there is no site \"moon\"");
  EXPECT_EQ(error_of({"yard", "8", "g"}, grid, {{0, 0}}).kind, ErrorKind::not_found);
  EXPECT_EQ(error_of({"yard", "", ""}, grid, {{0, 0}}).message, "the grid \"\": its name is empty");
  EXPECT_EQ(error_of(key, grid, {{0, 0}, {INT32_MAX, 0}}).message,
            "the grid \"robot 1\": its tile 2147483647, 0 lies more than 100 km from the site's anchor");
  double const nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(error_of(key, OccupancyGrid(0.05, {{nan, 0.0}, 0.0}), {{0, 0}}).kind, ErrorKind::invalid_input);
  std::vector<TileKey> many;
  for (int i = 0; i <= static_cast<int>(most_grid_tiles); ++i) many.push_back({i, 0});
  EXPECT_EQ(error_of(key, grid, many).message,
            "the grid \"robot 1\": it would have 2049 tiles of 256 by 256 cells; at most 2048 are taken");
  EXPECT_TRUE(map.grids().empty());
}

}  // namespace
}  // namespace lapwing::map
