#include "station/past/feature_changes.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "station/map/features/feature_feed.hpp"
#include "station/testing/map_demo.hpp"

namespace lapwing::station {
namespace {

using nlohmann::json;
using namespace std::chrono_literals;

struct FeatureChangesTest : ::testing::Test, testing::MapDemo {
  /// What leads to now.
  std::vector<map::Store::Shown> state() {
    std::vector<map::Store::Shown> frames;
    for (auto const layer : map::all_layers) {
      FeatureFeed feed(live, layer);
      (void)feed.refresh(loop.now());
      for (auto& frame : feed.since(0, loop.now(), 1'000'000).frames)
        frames.push_back({.at = now(),
                          .session = "s1",
                          .feed = std::string(feed.name()),
                          .is_whole = true,
                          .content = std::move(frame.content)});
    }
    return frames;
  }
  static json layers(std::vector<map::Store::Shown> const& before, std::vector<map::Store::Shown> const& after) {
    return json::parse(feature_changes(before, after, 100).layers);
  }
};

TEST_F(FeatureChangesTest, TellsWhatCameChangedAndWent) {
  put(testing::slot("a", 0, 0, now()));
  put(testing::slot("b", 4, 0, now()));
  put(testing::door("d", 1, 1, now()));
  auto const before = state();
  put(testing::slot("b", 4, 0, now() + 1s, map::SlotState::taken));
  put(testing::slot("c", 8, 0, now()));
  ASSERT_TRUE(live.remove(map::LayerKind::slots, "a", {"drone 1", now() + 1s}));
  auto const found = layers(before, state());
  ASSERT_EQ(found.size(), 1U) << "nothing has become of doors";
  EXPECT_EQ(found[0]["layer"], "slots");
  EXPECT_EQ(found[0]["added"][0]["id"], "c");
  EXPECT_EQ(found[0]["removed"][0]["id"], "a");
  EXPECT_EQ(found[0]["changed"][0]["properties"], json({"state"}));
  EXPECT_EQ(found[0]["changed"][0]["before"]["properties"]["state"], "free");
  EXPECT_EQ(found[0]["changed"][0]["after"]["properties"]["state"], "taken");
}

TEST_F(FeatureChangesTest, WhatIsToldAgainLaterByAnotherOneAHandsBreadthAwayIsTheSame) {
  put(testing::slot("a", 0, 0, now()));
  put(testing::door("d", 1, 1, now()));
  auto const before = state();
  auto again = testing::slot("a", 0.002, 0, now() + 1s);
  again.account.writer = "drone 2";
  put(again);
  EXPECT_EQ(layers(before, state()), json::array());
  put(testing::door("d", 1.5, 1, now() + 1s));
  EXPECT_EQ(layers(before, state())[0]["changed"][0]["properties"], json({"geometry"}));
}

TEST_F(FeatureChangesTest, PutsNewsTogether) {
  auto const before = state();
  put(testing::slot("a", 0, 0, now()));
  auto after = state();
  after.push_back({.at = now(),
                   .session = "s1",
                   .feed = "map.slots",
                   .content = R"({"type":"features","layer":"slots","full":false,"features":[],"removed":["a"]})"});
  EXPECT_EQ(layers(before, after), json::array());
}

TEST_F(FeatureChangesTest, TellsSoMany) {
  auto const before = state();
  for (int i = 0; i < 10; ++i) put(testing::slot(std::to_string(i), 4.0 * i, 0, now()));
  auto const found = feature_changes(before, state(), 4);
  EXPECT_EQ(json::parse(found.layers)[0]["added"].size(), 4U);
  EXPECT_EQ(found.left_out, 6U);
}

}  // namespace
}  // namespace lapwing::station
