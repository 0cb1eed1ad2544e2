#include "station/map/features/feature_feed.hpp"

#include <map>
#include <random>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "base/text/utc_text.hpp"
#include "station/testing/feed_viewer.hpp"
#include "station/testing/map_demo.hpp"

namespace lapwing::station {
namespace {

using map::LayerKind;
using nlohmann::json;
using namespace std::chrono_literals;
using testing::slot;

/// Keeps the features that it is told of, as a page would.
struct FeatureViewer {
  explicit FeatureViewer(Feed& feed)
      : viewer(feed, [this](json const& message, bool is_whole) { take(message, is_whole); }) {}

  void take(json const& message, bool is_whole) {
    EXPECT_EQ(message["type"], "features");
    EXPECT_EQ(message["full"], is_whole);
    if (is_whole) {
      features.clear();
      ++wholes;
    }
    for (auto const& feature : message["features"]) features[feature["id"]] = feature;
    for (auto const& id : message["removed"]) features.erase(id.get<std::string>());
  }

  std::map<std::string, json> features;
  int wholes = 0;
  testing::FeedViewer viewer;
};

struct FeatureFeedTest : ::testing::Test, testing::MapDemo {
  /// What a viewer should have by now.
  std::map<std::string, json> truth() const {
    std::map<std::string, json> all;
    for (auto const* record : live.within(LayerKind::slots, "yard", std::nullopt, 1'000'000))
      all[record->feature.id] = record->feature.account.at.time_since_epoch().count();
    return all;
  }
  static std::map<std::string, json> times(FeatureViewer const& watcher) {
    std::map<std::string, json> all;
    for (auto const& [id, feature] : watcher.features) {
      auto const at = base::utc_from_text(feature["properties"]["at"].get<std::string>());
      all[id] = at->time_since_epoch().count();
    }
    return all;
  }

  FeatureFeed feed{live, LayerKind::slots};
};

TEST_F(FeatureFeedTest, BeginsWithEverythingAlsoWhereThatIsNothing) {
  FeatureViewer watcher(feed);
  watcher.viewer.catch_up();
  EXPECT_EQ(feed.name(), "map.slots");
  EXPECT_EQ(watcher.wholes, 1);
  EXPECT_EQ(watcher.viewer.messages(), 1U);
  put(slot("a", 10, 20, now()));
  FeatureViewer another(feed);
  another.viewer.catch_up();
  ASSERT_EQ(another.features.size(), 1U);
  auto const& properties = another.features["a"]["properties"];
  EXPECT_EQ(properties["site"], "yard");
  EXPECT_EQ(properties["writer"], "drone 1");
  EXPECT_EQ(properties["state"], "free");
  EXPECT_EQ(another.features["a"]["geometry"]["type"], "Polygon");
}

TEST_F(FeatureFeedTest, TellsNewsAlone) {
  put(slot("a", 10, 20, now()));
  put(slot("b", 20, 20, now()));
  FeatureViewer watcher(feed);
  watcher.viewer.catch_up();
  put(slot("b", 20, 20, now() + 1s, map::SlotState::taken));
  ASSERT_TRUE(live.remove(LayerKind::slots, "a", {"drone 1", now() + 1s}));
  auto const before = watcher.viewer.bytes();
  watcher.viewer.catch_up();
  EXPECT_EQ(watcher.wholes, 1);
  ASSERT_EQ(watcher.features.size(), 1U);
  EXPECT_EQ(watcher.features["b"]["properties"]["state"], "taken");
  EXPECT_LT(watcher.viewer.bytes() - before, 700U);
}

TEST_F(FeatureFeedTest, IsNotWokenByOtherLayers) {
  put(slot("a", 10, 20, now()));
  FeatureViewer watcher(feed);
  watcher.viewer.catch_up();
  put(testing::door("d", 1, 2, now()));
  EXPECT_FALSE(watcher.viewer.take_one(1000));
}

TEST_F(FeatureFeedTest, TellsEverythingOfASiteThatMoves) {
  put(slot("a", 10, 20, now()));
  put(slot("b", 20, 20, now()));
  FeatureViewer watcher(feed);
  watcher.viewer.catch_up();
  auto const before = watcher.features;
  live.put_site(testing::yard(geo::Wgs84::from_degrees(48.0, 9.0, 400.0)));
  watcher.viewer.catch_up();
  for (auto const* id : {"a", "b"}) {
    auto const lat = [&](json const& feature) { return feature["geometry"]["coordinates"][0][0][1].get<double>(); };
    EXPECT_NEAR(lat(watcher.features[id]) - lat(before.at(id)), 1.0, 0.001);
  }
}

TEST_F(FeatureFeedTest, LeavesOffWhereThereIsNoRoomAndGoesOnFromThere) {
  std::vector<map::Feature> many;
  for (int i = 0; i < 2000; ++i) many.push_back(slot(fmt::format("{:04}", i), i, 0, now()));
  ASSERT_TRUE(live.put_all(std::move(many)));
  FeatureViewer watcher(feed);
  constexpr std::size_t room = 10'000;
  watcher.viewer.catch_up(room);
  EXPECT_EQ(watcher.features.size(), 2000U);
  EXPECT_EQ(watcher.wholes, 1);
  EXPECT_LT(watcher.viewer.most_bytes(), room + 1'000);
}

TEST_F(FeatureFeedTest, GivesASlowViewerTheNewestAlone) {
  for (int i = 0; i < 100; ++i) put(slot(fmt::format("{}", i), 3 * i, 0, now()));
  FeatureViewer watcher(feed);
  watcher.viewer.catch_up();
  auto const before = watcher.viewer.bytes();
  for (int round = 1; round <= 50; ++round)
    for (int i = 0; i < 100; ++i) {
      put(slot(fmt::format("{}", i), 3 * i, 0, now() + round * 1s));
      (void)feed.refresh({});
    }
  watcher.viewer.catch_up();
  EXPECT_LT(watcher.viewer.bytes() - before, 2 * before) << "50 changes of each, told once";
  EXPECT_EQ(times(watcher), truth());
}

/// Whatever happens while a viewer is in the middle of what it is told.
TEST_F(FeatureFeedTest, LeadsToTheTruthInAnyOrder) {
  std::mt19937 random(7);
  auto const draw = [&](int below) { return static_cast<int>(random() % static_cast<unsigned>(below)); };
  FeatureViewer slow(feed);
  FeatureViewer slower(feed);
  auto at = now() - 5min;
  for (int step = 0; step < 3000; ++step) {
    at += 10ms;
    auto const id = fmt::format("{}", draw(60));
    switch (draw(12)) {
      case 0:
      case 1: (void)live.remove(LayerKind::slots, id, {"drone 1", at}); break;
      case 2: live.put_site(testing::yard(geo::Wgs84::from_degrees(47.0 + draw(3), 8.0, 400.0))); break;
      case 3: (void)slow.viewer.take_one(3'000); break;
      case 4:
        if (draw(10) == 0) (void)slower.viewer.take_one(1'000);
        break;
      default: put(slot(id, draw(100), draw(100), at)); break;
    }
  }
  slow.viewer.catch_up(2'000);
  slower.viewer.catch_up(2'000);
  FeatureViewer fresh(feed);
  fresh.viewer.catch_up();
  EXPECT_EQ(times(fresh), truth());
  EXPECT_EQ(slow.features, fresh.features);
  EXPECT_EQ(slower.features, fresh.features);
}

TEST_F(FeatureFeedTest, BeginsAnewForWhoMissedMoreRemovalsThanAreRemembered) {
  auto const at = now() - 1min;
  for (std::size_t i = 0; i < map::most_removals + 10; ++i) put(slot(fmt::format("{}", i), 1, 0, at));
  FeatureViewer watcher(feed);
  watcher.viewer.catch_up();
  for (std::size_t i = 0; i < map::most_removals + 5; ++i)
    ASSERT_TRUE(live.remove(LayerKind::slots, fmt::format("{}", i), {"drone 1", at + 1s}));
  watcher.viewer.catch_up();
  EXPECT_EQ(watcher.wholes, 2);
  EXPECT_EQ(watcher.features.size(), 5U);
}

}  // namespace
}  // namespace lapwing::station
