#include "fleet/watch/leg_progress.hpp"

#include <gtest/gtest.h>

namespace lapwing::fleet {
namespace {

using namespace std::chrono_literals;
using mavlink::MavCmd;
using vehicle::Family;

geo::Wgs84 const home = geo::Wgs84::from_degrees(40.0, -8.0, 100.0);

geo::Wgs84 at(double north_m, double up_m = 20.0) {
  return geo::displaced(home, {.north = north_m, .east = 0.0, .down = -up_m});
}

mavlink::MissionItem item(MavCmd command, double north_m = 0.0, float first = 0.0F) {
  mavlink::MissionItem made;
  made.command = command;
  made.params[0] = first;
  auto const place = at(north_m);
  made.place = {.lat_rad = place.lat_rad, .lon_rad = place.lon_rad, .z_m = place.alt_m};
  return made;
}

Legs legs_of(std::vector<mavlink::MissionItem> items, Family family = Family::copter) {
  items.insert(items.begin(), item(MavCmd::nav_waypoint));
  return {std::move(items), home, family};
}

void stay(LegProgress& progress, geo::Wgs84 place, base::Duration time) {
  for (base::Duration passed{}; passed < time; passed += 1s) progress.note(place, 1s);
}

TEST(LegProgress, CountsTheTimeInWhichItComesNoNearer) {
  auto const legs = legs_of({item(MavCmd::nav_waypoint, 1000.0)});
  LegProgress progress(legs);
  progress.note_item(1);
  stay(progress, at(100.0), 31s);
  EXPECT_EQ(progress.stalled_for(), 30s);
  progress.note(at(103.0), 1s);
  EXPECT_EQ(progress.stalled_for(), 0s);
  stay(progress, at(50.0), 10s);  // going away is none
  EXPECT_EQ(progress.stalled_for(), 10s);
}

TEST(LegProgress, DoesNotCountSilence) {
  auto const legs = legs_of({item(MavCmd::nav_waypoint, 1000.0)});
  LegProgress progress(legs);
  progress.note_item(1);
  progress.note(at(100.0), 0s);
  progress.note(at(100.0), 60s);
  EXPECT_EQ(progress.stalled_for(), 0s);
}

TEST(LegProgress, BeginsAnewWithEveryItem) {
  auto const legs = legs_of({item(MavCmd::nav_waypoint, 1000.0), item(MavCmd::nav_waypoint, 2000.0)});
  LegProgress progress(legs);
  progress.note_item(1);
  stay(progress, at(100.0), 31s);
  progress.note_item(2);
  progress.note(at(100.0), 1s);
  EXPECT_EQ(progress.stalled_for(), 0s);
  EXPECT_GT(*progress.patience(), 60s + 2 * 190s);
}

TEST(LegProgress, WaitsAsLongAsTheItemsDo) {
  auto const legs =
      legs_of({item(MavCmd::nav_loiter_time, 0.0, 600.0F), item(MavCmd::nav_delay, 0.0, 900.0F),
               item(MavCmd::nav_waypoint, 0.0, 300.0F), item(MavCmd::nav_loiter_unlim), item(MavCmd::nav_delay)});
  EXPECT_GE(*legs.patience(1, at(0.0)), 1200s);
  EXPECT_GE(*legs.patience(2, at(0.0)), 1800s);
  EXPECT_GE(*legs.patience(3, at(0.0)), 600s);
  EXPECT_FALSE(legs.patience(4, at(0.0)));  // for ever
  EXPECT_FALSE(legs.patience(5, at(0.0)));  // until a time of the day
  EXPECT_FALSE(legs.patience(6, at(0.0)));  // behind the last
}

TEST(LegProgress, IsMadeByGoingRoundAndByComingDown) {
  auto const legs = legs_of({item(MavCmd::nav_loiter_turns, 0.0, 100.0F), item(MavCmd::nav_return_to_launch)});
  LegProgress progress(legs);
  progress.note_item(1);
  progress.note(at(10.0), 1s);
  progress.note(at(-10.0), 1s);
  EXPECT_EQ(progress.stalled_for(), 0s);
  stay(progress, at(-10.0), 10s);
  EXPECT_EQ(progress.stalled_for(), 10s);
  progress.note_item(2);
  progress.note(at(0.0, 50.0), 1s);
  progress.note(at(0.0, 45.0), 1s);
  EXPECT_EQ(progress.stalled_for(), 0s);
}

TEST(Legs, KnowWhereACopterIsInTheAir) {
  auto const legs = legs_of({item(MavCmd::nav_delay), item(MavCmd::nav_takeoff), item(MavCmd::nav_waypoint),
                             item(MavCmd::do_change_speed), item(MavCmd::nav_land), item(MavCmd::nav_takeoff),
                             item(MavCmd::nav_delay)});
  std::vector<bool> in_the_air;
  for (int seq = 1; seq <= 8; ++seq) in_the_air.push_back(legs.is_in_the_air(seq));
  EXPECT_EQ(in_the_air, (std::vector{false, false, true, false, false, false, true, false}));
  EXPECT_TRUE(legs_of({item(MavCmd::nav_waypoint)}).is_in_the_air(1));  // begun in flight
}

}  // namespace
}  // namespace lapwing::fleet
