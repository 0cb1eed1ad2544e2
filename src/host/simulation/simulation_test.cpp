#include "host/simulation/simulation.hpp"

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

TEST(ParseWind, BlowsFromWhereItIsSaid) {
  auto const west = parse_wind("6,270");
  ASSERT_TRUE(west);
  EXPECT_NEAR(west->air_m_s.north, 0.0, 1e-9);
  EXPECT_NEAR(west->air_m_s.east, 6.0, 1e-9);
  EXPECT_EQ(west->gust_m_s, 0.0);
  auto const north = parse_wind("3,0,1.5");
  ASSERT_TRUE(north);
  EXPECT_NEAR(north->air_m_s.north, -3.0, 1e-9);
  EXPECT_EQ(north->gust_m_s, 1.5);
}

TEST(ParseWind, RefusesWhatIsNone) {
  for (auto const* text : {"", "6", "6,", "-1,0", "6,400", "60,0", "6,0,-1", "6,0,80", "6,0,1,2", "a,b"}) {
    auto const wind = parse_wind(text);
    ASSERT_FALSE(wind) << text;
    EXPECT_NE(wind.error().hint.find("SPEED,FROM"), std::string::npos);
  }
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
