#include "host/simulation/simulation.hpp"

#include <cmath>
#include <map>
#include <numbers>

#include <gtest/gtest.h>

#include "sim/model/vehicle_spec.hpp"

namespace lapwing::host {
namespace {

TEST(ParseHome, ReadsDegreesAndMetres) {
  auto const home = parse_home("41.1780,-8.5980,90");
  ASSERT_TRUE(home);
  EXPECT_NEAR(home->place.lat_deg(), 41.1780, 1e-9);
  EXPECT_NEAR(home->place.lon_deg(), -8.5980, 1e-9);
  EXPECT_DOUBLE_EQ(home->place.alt_m, 90);
  EXPECT_DOUBLE_EQ(home->heading_rad, 0);
}

TEST(ParseHome, ReadsTheHeading) {
  EXPECT_NEAR(parse_home("0,0,0,90")->heading_rad, std::numbers::pi / 2, 1e-12);
}

TEST(ParseHome, TakesTheEndsOfTheRanges) {
  EXPECT_TRUE(parse_home("90,180,-10"));
  EXPECT_TRUE(parse_home("-90,-180,8848"));
}

TEST(ParseHome, RefusesWhatIsNoPlace) {
  for (auto const* text : {"", "41", "41,-8", "41,-8,", ",-8,90", "41,-8,90,0,1", "91,0,0", "0,181,0", "41;-8;90",
                           "41,-8,high", "41,-8,nan", "41,-8,inf", "41 N,-8,90", "41,-8,90,"}) {
    auto const home = parse_home(text);
    ASSERT_FALSE(home) << text;
    EXPECT_EQ(home.error().kind, base::ErrorKind::invalid_input);
    EXPECT_NE(home.error().hint.find("LAT,LON,ALT"), std::string::npos);
  }
}

TEST(SetWind, BlowsFromWhereItIsSaid) {
  sim::WorldOptions world;
  ASSERT_TRUE(set_wind(world, "6,270"));
  EXPECT_NEAR(world.wind_m_s.north, 0.0, 1e-9);
  EXPECT_NEAR(world.wind_m_s.east, 6.0, 1e-9);
  EXPECT_EQ(world.gust_m_s, 0.0);
  ASSERT_TRUE(set_wind(world, "3,0,1.5"));
  EXPECT_NEAR(world.wind_m_s.north, -3.0, 1e-9);
  EXPECT_EQ(world.gust_m_s, 1.5);
}

TEST(SetWind, RefusesWhatIsNone) {
  for (auto const* text : {"6", "6,", "-1,0", "0,5", "6,400", "60,0", "6,0,-1", "6,0,80", "6,0,1,2", "a,b"}) {
    sim::WorldOptions world;
    auto const wind = set_wind(world, text);
    ASSERT_FALSE(wind) << text;
    EXPECT_NE(wind.error().hint.find("SPEED,FROM"), std::string::npos);
    EXPECT_EQ(std::hypot(world.wind_m_s.north, world.wind_m_s.east), 0.0);
  }
}

TEST(SetWind, TellsWhatNorthAndEastAreNow) {
  sim::WorldOptions world;
  for (auto const& [old, now] :
       std::map<std::string, std::string>{{"0,5", "5,270"}, {"-3,4", "5,307"}, {"-2.5,0", "2.5,0"}})
    EXPECT_TRUE(set_wind(world, old).error().hint.ends_with(" is " + now + " now"))
        << set_wind(world, old).error().hint;
}

TEST(PaceFor, TakesZeroForAsFastAsPossible) {
  EXPECT_TRUE(pace_for(0).unpaced);
  EXPECT_FALSE(pace_for(4).unpaced);
  EXPECT_DOUBLE_EQ(pace_for(4).speedup, 4);
}

base::Task<> until_three_are_heard(base::Loop& loop, Ground& ground) {
  while (ground.registry.all().size() < 3) co_await loop.sleep(base::from_seconds(0.1));
}

TEST(Simulation, VehiclesAreHeardByTheGround) {
  base::Loop loop({.unpaced = true});
  Ground ground(loop, {});
  sim::WorldOptions options;
  options.vehicles = *sim::parse_vehicles("copter:2,rover:1");
  auto const world = start_simulation(ground, std::move(options), {});
  ASSERT_TRUE(world) << world.error().message;
  loop.run_until_done(until_three_are_heard(loop, ground));
  EXPECT_EQ(ground.registry.all().front()->family, vehicle::Family::copter);
}

}  // namespace
}  // namespace lapwing::host
