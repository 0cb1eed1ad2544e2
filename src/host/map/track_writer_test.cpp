#include "host/map/track_writer.hpp"

#include <gtest/gtest.h>

namespace lapwing::host {
namespace {

using lapwing::map::LayerKind;
using lapwing::map::LiveMap;
using namespace std::chrono_literals;

struct TrackWriterTest : ::testing::Test {
  /// So far north of the home that all tests share, at a height above it.
  void stand(std::string const& id, double north_m, double up_m = 0.0) {
    auto& motion = vehicles.edit({id}).motion;
    motion.home.set(home, loop.now());
    motion.position.set(geo::displaced(home, {north_m, 0.0, -up_m}), loop.now());
    vehicles.touch({id});
  }
  base::Task<> wait(base::Duration time) { co_await loop.sleep(time); }
  void go_on(base::Duration time) { loop.run_until_done(wait(time)); }
  [[nodiscard]] std::vector<lapwing::map::Track> tracks() const {
    std::vector<lapwing::map::Track> all;
    for (auto const& [id, site] : map.sites())
      for (auto const* record : map.within(LayerKind::tracks, id, std::nullopt, 1000))
        all.push_back(std::get<lapwing::map::Track>(record->feature.content));
    return all;
  }

  geo::Wgs84 const home = geo::Wgs84::from_degrees(47.0, 8.0, 400.0);
  base::Loop loop{base::Loop::Pace{.unpaced = true, .begins_at = base::UtcTime(std::chrono::hours(500'000))}};
  vehicle::Registry vehicles{loop};
  LiveMap map{[this] { return loop.utc_now(); }};
};

TEST_F(TrackWriterTest, WritesWhereAVehicleGoes) {
  TrackWriter const writer(loop, vehicles, map);
  for (int i = 0; i < 20; ++i) {
    stand("1", i, 2.0 * i);
    go_on(500ms);
  }
  go_on(3s);
  ASSERT_EQ(tracks().size(), 1U);
  auto const track = tracks().front();
  EXPECT_EQ(track.vehicle, "1");
  ASSERT_EQ(track.samples.size(), 20U);
  EXPECT_NEAR(track.samples.back().position.y(), 19.0, 0.01);
  EXPECT_NEAR(track.samples.back().up_m, 38.0, 0.01);
  EXPECT_EQ(track.samples[3].at - track.samples[1].at, 1s);
  EXPECT_EQ(map.site("default")->anchor(), home) << "where there was no site it makes one";
}

TEST_F(TrackWriterTest, WritesNothingOfWhatStands) {
  TrackWriter const writer(loop, vehicles, map);
  for (int i = 0; i < 20; ++i) {
    stand("1", 0.1 * (i % 2));
    go_on(500ms);
  }
  EXPECT_TRUE(tracks().empty());
}

TEST_F(TrackWriterTest, GoesOnInLegsOfWhichTheOldestGo) {
  TrackWriter const writer(loop, vehicles, map, {.pause = 1s, .points_a_leg = 10, .legs = 3});
  for (int i = 0; i < 100; ++i) {
    stand("1", i);
    go_on(500ms);
  }
  go_on(3s);
  auto const legs = tracks();
  ASSERT_LE(legs.size(), 3U);
  ASSERT_GE(legs.size(), 2U) << "a leg that has just begun has one point and is not written yet";
  double last_m = 0.0;
  for (std::size_t i = 0; i < legs.size(); ++i) {
    EXPECT_LE(legs[i].samples.size(), 12U);
    if (i > 0) {
      EXPECT_EQ(legs[i].samples.front(), legs[i - 1].samples.back()) << "the line has no gap";
    }
    last_m = legs[i].samples.back().position.y();
  }
  EXPECT_NEAR(last_m, 99.0, 0.01);
}

TEST_F(TrackWriterTest, WritesEachVehicleInTheSiteThatItIsIn) {
  map.put_site(geo::Site::make("yard", home).value());
  map.put_site(geo::Site::make("office", geo::displaced(home, {2'000.0, 0.0, 0.0})).value());
  TrackWriter const writer(loop, vehicles, map);
  for (int i = 0; i < 10; ++i) {
    stand("1", i);
    stand("2", 2'000.0 + i);
    auto& robot = vehicles.edit({"3"}).motion;
    robot.site_pose.set({.site = "office", .floor = "0", .position = {1.0 * i, 0.0, 0.0}}, loop.now());
    go_on(1s);
  }
  std::map<std::string, std::string> site_of;
  for (auto const& [id, site] : map.sites())
    for (auto const* record : map.within(LayerKind::tracks, id, std::nullopt, 10))
      site_of[record->feature.account.writer] = id + "/" + record->feature.floor;
  EXPECT_EQ(site_of, (std::map<std::string, std::string>{{"1", "yard/"}, {"2", "office/"}, {"3", "office/0"}}));
}

}  // namespace
}  // namespace lapwing::host
