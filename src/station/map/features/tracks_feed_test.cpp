#include "station/map/features/tracks_feed.hpp"

#include <map>
#include <random>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "station/testing/feed_viewer.hpp"
#include "station/testing/map_demo.hpp"

namespace lapwing::station {
namespace {

using map::LayerKind;
using nlohmann::json;
using namespace std::chrono_literals;

struct TrackViewer {
  explicit TrackViewer(Feed& feed)
      : viewer(feed, [this](json const& message, bool is_whole) { take(message, is_whole); }) {}

  void take(json const& message, bool is_whole) {
    EXPECT_EQ(message["type"], "tracks");
    if (is_whole) tracks.clear();
    for (auto const& id : message["removed"]) tracks.erase(id.get<std::string>());
    for (auto const& track : message["tracks"]) {
      auto& points = tracks[track["id"]];
      std::size_t const from = track["from"];
      EXPECT_LE(from, points.size()) << "it is told to keep what it has not got";
      points.resize(std::min(from, points.size()));
      for (auto const& point : track["points"]) points.push_back(point);
      told += track["points"].size();
    }
  }

  std::map<std::string, std::vector<json>> tracks;
  std::size_t told = 0;
  testing::FeedViewer viewer;
};

struct TracksFeedTest : ::testing::Test, testing::MapDemo {
  void put_track(std::string id, double x_m, std::vector<int> seconds) {
    map::Track track{.vehicle = "1"};
    for (int const second : seconds) track.samples.push_back({{x_m + second, 0.0}, 10.0, begin + second * 1s});
    auto const at = track.samples.back().at;
    put({.id = std::move(id), .site = "yard", .account = {"1", at}, .content = std::move(track)});
  }
  base::UtcTime begin = now() - 1h;
  TracksFeed feed{live};
};

TEST_F(TracksFeedTest, TellsOfATrackThatHasGrownItsNewPointsAlone) {
  put_track("a", 0, {0, 1, 2});
  TrackViewer watcher(feed);
  watcher.viewer.catch_up();
  EXPECT_EQ(watcher.told, 3U);
  put_track("a", 0, {2, 3, 4});
  watcher.viewer.catch_up();
  EXPECT_EQ(watcher.told, 5U);
  ASSERT_EQ(watcher.tracks["a"].size(), 5U);
  EXPECT_EQ(watcher.tracks["a"].back()[2], 10.0);
  EXPECT_EQ(watcher.tracks["a"].back()[3], 4.0);
}

TEST_F(TracksFeedTest, TellsAllOfWhatCameLate) {
  put_track("a", 0, {0, 5, 6});
  TrackViewer watcher(feed);
  watcher.viewer.catch_up();
  put_track("a", 0, {2, 3});
  watcher.viewer.catch_up();
  ASSERT_EQ(watcher.tracks["a"].size(), 5U);
  EXPECT_EQ(watcher.tracks["a"][1][3], 2.0);
}

TEST_F(TracksFeedTest, TellsAllOfWhatMovedOrIsGone) {
  put_track("a", 0, {0, 1});
  put_track("b", 0, {0, 1});
  TrackViewer watcher(feed);
  watcher.viewer.catch_up();
  auto const before = watcher.tracks["a"][0][1].get<double>();
  live.put_site(testing::yard(geo::Wgs84::from_degrees(48.0, 8.0)));
  ASSERT_TRUE(live.remove(LayerKind::tracks, "b", {"1", now()}));
  watcher.viewer.catch_up();
  EXPECT_NEAR(watcher.tracks["a"][0][1].get<double>() - before, 1.0, 0.001);
  EXPECT_FALSE(watcher.tracks.contains("b"));
}

/// A viewer in the middle of what it is told lacks tracks that have changed meanwhile.
TEST_F(TracksFeedTest, LeadsToTheTruthInAnyOrder) {
  std::mt19937 random(3);
  auto const draw = [&](int below) { return static_cast<int>(random() % static_cast<unsigned>(below)); };
  TrackViewer quick(feed);
  TrackViewer slow(feed);
  std::map<std::string, int> reached;
  for (int step = 0; step < 3000; ++step) {
    auto const id = fmt::format("{}", draw(20));
    switch (draw(8)) {
      case 0: quick.viewer.catch_up(); break;
      case 1: (void)slow.viewer.take_one(200); break;
      case 2:
        if (draw(20) == 0 && reached.contains(id)) {
          (void)live.remove(LayerKind::tracks, id, {"1", begin + (reached[id]) * 1s});
        }
        break;
      default: {
        auto& last = reached[id];
        put_track(id, 0, {last, last + 1 + draw(3), last + 5});
        last += 5;
        break;
      }
    }
  }
  quick.viewer.catch_up();
  slow.viewer.catch_up(500);
  TrackViewer fresh(feed);
  fresh.viewer.catch_up();
  EXPECT_FALSE(fresh.tracks.empty());
  EXPECT_EQ(quick.tracks, fresh.tracks);
  EXPECT_EQ(slow.tracks, fresh.tracks);
  EXPECT_LT(quick.told, 5 * fresh.told);
}

}  // namespace
}  // namespace lapwing::station
