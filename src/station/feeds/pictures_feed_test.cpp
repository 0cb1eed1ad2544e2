#include "station/feeds/pictures_feed.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace lapwing::station {
namespace {

using nlohmann::json;

struct PicturesFeedTest : ::testing::Test {
  /// The camera takes the next picture; the vehicle keeps the last three.
  void take(std::string const& id) {
    vehicle::VehicleId const name{id};
    auto pictures = registry.edit(name).payload.pictures.value.value_or(vehicle::Pictures{});
    pictures.recent.push_back(
        {.number = ++pictures.taken, .position = geo::Wgs84::from_degrees(1, 2, 3), .relative_alt_m = 20});
    if (pictures.recent.size() > 3) pictures.recent.erase(pictures.recent.begin());
    registry.edit(name).payload.pictures.set(pictures, {});
    registry.touch(name);
  }
  std::vector<json> since(std::uint64_t revision) {
    std::vector<json> messages;
    for (auto const& frame : feed.since(revision, {}, 0).frames) messages.push_back(json::parse(frame.content));
    return messages;
  }
  static std::vector<int> numbers(json const& message) {
    std::vector<int> all;
    for (auto const& picture : message["pictures"]) all.push_back(picture["number"]);
    return all;
  }

  base::Loop loop{{.unpaced = true}};
  vehicle::Registry registry{loop};
  PicturesFeed feed{registry};
};

TEST_F(PicturesFeedTest, TellsOfEachPictureOnce) {
  take("1");
  auto const first = feed.refresh({});
  take("1");
  auto const second = feed.refresh({});
  EXPECT_GT(second, first);
  ASSERT_EQ(since(first).size(), 1U);
  EXPECT_EQ(since(first)[0]["full"], false);
  EXPECT_EQ(
      since(first)[0]["pictures"],
      json::array({{{"number", 2}, {"lat_deg", 1.0}, {"lon_deg", 2.0}, {"alt_m", 3.0}, {"relative_alt_m", 20.0}}}));
  EXPECT_TRUE(since(second).empty());
  EXPECT_EQ(feed.refresh({}), second) << "nothing is new";
}

TEST_F(PicturesFeedTest, GivesNewcomersAllThatAreKept) {
  for (int i = 0; i < 5; ++i) {
    take("1");
    (void)feed.refresh({});
  }
  take("2");
  auto const last = feed.refresh({});
  auto const all = feed.since(0, {}, 0);
  EXPECT_TRUE(all.is_whole);
  ASSERT_EQ(all.frames.size(), 2U);
  EXPECT_EQ(all.frames[1].revision, last);
  EXPECT_EQ(numbers(since(0)[0]), (std::vector{3, 4, 5}));
  EXPECT_EQ(since(0)[0]["full"], true);
  EXPECT_EQ(numbers(since(0)[1]), std::vector{1});
}

TEST_F(PicturesFeedTest, TellsOneWhoMissedSomeOfThoseThatAreLeft) {
  take("1");
  auto const had = feed.refresh({});
  for (int i = 0; i < 9; ++i) {
    take("1");
    (void)feed.refresh({});
  }
  ASSERT_EQ(since(had).size(), 1U);
  EXPECT_EQ(numbers(since(had)[0]), (std::vector{8, 9, 10}));
}

TEST_F(PicturesFeedTest, TellsOfNoneTakenSinceItLooked) {
  take("1");
  auto const had = feed.refresh({});
  take("1");
  EXPECT_TRUE(since(had).empty()) << "they come with the revision that counts them";
  EXPECT_EQ(numbers(since(0)[0]), std::vector{1});
}

}  // namespace
}  // namespace lapwing::station
