#include "sim/body/dynamics.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/autopilot/start_up.hpp"
#include "sim/body/battery_pack.hpp"
#include "sim/guidance/goal.hpp"
#include "sim/guidance/guidance.hpp"

namespace lapwing::sim {
namespace {

using namespace std::chrono_literals;
using vehicle::Family;

constexpr double dt_s = 0.05;

/// A body pursuing goals in still air or wind.
struct Flight {
  Airframe airframe;
  Pace pace = {};
  geo::Ned wind = {};
  Body body = {};
  double highest_m = 0.0;

  void pursue(Goal const& goal, double seconds) {
    for (int i = 0; i < static_cast<int>(seconds / dt_s); ++i) {
      body = step(body, steer(goal, body, airframe, pace), airframe, wind, dt_s);
      highest_m = std::max(highest_m, body.height_m());
    }
  }
  [[nodiscard]] double off(geo::Ned point) const {
    return std::hypot(body.position_m.north - point.north, body.position_m.east - point.east);
  }
};

Flight copter_at(double height_m) {
  Flight flight{.airframe = airframe_of(Family::copter)};
  flight.body.position_m.down = -height_m;
  flight.body.on_ground = false;
  return flight;
}

Flight plane_at(double height_m) {
  Flight flight{.airframe = airframe_of(Family::plane), .pace = {.speed_m_s = 22.0, .climb_m_s = 5.0, .sink_m_s = 5.0}};
  flight.body.position_m.down = -height_m;
  flight.body.velocity_m_s.north = 22.0;
  flight.body.airspeed_m_s = 22.0;
  flight.body.on_ground = false;
  return flight;
}

TEST(Copter, TakesOffWithoutOvershoot) {
  Flight flight{.airframe = airframe_of(Family::copter)};
  flight.pursue(TakeOff{{}, 20.0, 0.0}, 30.0);
  EXPECT_NEAR(flight.body.height_m(), 20.0, 0.1);
  EXPECT_LT(flight.highest_m, 20.2);
}

TEST(Copter, CoversThirtyOfFiftyMetresInSixSeconds) {
  auto flight = copter_at(20.0);
  flight.pursue(FlyTo{{50.0, 0.0, -20.0}, {}, false}, 6.0);
  EXPECT_NEAR(flight.body.position_m.north, 33.0, 5.0);
  flight.pursue(FlyTo{{50.0, 0.0, -20.0}, {}, false}, 10.0);
  EXPECT_NEAR(flight.body.position_m.north, 50.0, 0.2);
}

TEST(Copter, LeansIntoTheWindAndHoldsItsPlace) {
  auto flight = copter_at(20.0);
  flight.wind = {8.0, 0.0, 0.0};
  flight.pursue(HoldAt{{0.0, 0.0, -20.0}}, 20.0);
  EXPECT_LT(flight.off({}), 0.5);
  EXPECT_GT(flight.body.attitude.pitch_rad, 0.05);
  EXPECT_NEAR(flight.body.airspeed_m_s, 8.0, 0.5);
}

TEST(Copter, CirclesAtTheWantedRadius) {
  auto flight = copter_at(20.0);
  flight.pursue(Circle{{0.0, 0.0, -20.0}, 30.0}, 60.0);
  EXPECT_NEAR(flight.off({}), 30.0, 2.0);
}

TEST(Copter, FallsWhenItsMotorsStopAndSaysHowHardItHit) {
  auto flight = copter_at(15.0);
  double impact = 0.0;
  for (int i = 0; i < 100 && impact == 0.0; ++i) {
    flight.pursue(StandStill{}, dt_s);
    impact = flight.body.touch_down_m_s.value_or(0.0);
  }
  EXPECT_NEAR(impact, 15.0, 3.0);
  EXPECT_TRUE(flight.body.on_ground);
  EXPECT_EQ(flight.body.position_m.down, 0.0);
}

TEST(Copter, StaysOnTheGroundWhileIdle) {
  Flight flight{.airframe = airframe_of(Family::copter), .wind = {10.0, 0.0, 0.0}};
  flight.pursue(Idle{}, 10.0);
  EXPECT_EQ(flight.body.position_m, geo::Ned{});
}

TEST(Plane, RollsThenClimbs) {
  Flight flight{.airframe = airframe_of(Family::plane), .pace = {.speed_m_s = 22.0, .climb_m_s = 5.0}};
  flight.pursue(TakeOff{{}, 50.0, 0.0}, 2.0);
  EXPECT_TRUE(flight.body.on_ground);
  EXPECT_GT(flight.body.position_m.north, 3.0);
  flight.pursue(TakeOff{{}, 50.0, 0.0}, 25.0);
  EXPECT_GT(flight.body.height_m(), 50.0);
}

TEST(Plane, NeverFliesSlowerThanItsLeastAirspeed) {
  auto flight = plane_at(100.0);
  flight.pace.speed_m_s = 1.0;
  flight.pursue(Cruise{{1.0, 0.0, 0.0}}, 20.0);
  EXPECT_GE(flight.body.airspeed_m_s, flight.airframe.min_airspeed_m_s);
}

TEST(Plane, HoldsByCircling) {
  auto flight = plane_at(100.0);
  flight.pursue(HoldAt{{300.0, 200.0, -100.0}}, 120.0);
  EXPECT_NEAR(flight.off({300.0, 200.0, 0.0}), 60.0, 6.0);
  EXPECT_GT(std::abs(flight.body.attitude.roll_rad), 0.3);
}

TEST(Plane, CirclesInWindToo) {
  auto flight = plane_at(100.0);
  flight.wind = {0.0, 6.0, 0.0};
  flight.pursue(Circle{{0.0, 0.0, -100.0}, -80.0}, 120.0);
  EXPECT_NEAR(flight.off({}), 80.0, 20.0);
}

TEST(Plane, NeedsRoomToTurnAndReachesAPointBehindIt) {
  auto flight = plane_at(100.0);
  geo::Ned const target{-600.0, 0.0, -120.0};
  double nearest = 1e9;
  for (int i = 0; i < 1200; ++i) {
    flight.pursue(FlyTo{target, {}, true}, dt_s);
    nearest = std::min(nearest, flight.off(target));
  }
  EXPECT_LT(nearest, 30.0);
}

TEST(Plane, GlidesDownFlaresAndRollsOut) {
  auto flight = plane_at(40.0);
  geo::Ned const runway{500.0, 0.0, 0.0};
  double impact = 0.0;
  for (int i = 0; i < 2000; ++i) {
    flight.pursue(Descend{runway}, dt_s);
    impact = std::max(impact, flight.body.touch_down_m_s.value_or(0.0));
  }
  EXPECT_TRUE(flight.body.on_ground);
  EXPECT_GT(impact, 0.0);
  EXPECT_LT(impact, 1.0);
  EXPECT_LT(flight.body.ground_speed_m_s(), 0.1);
  EXPECT_LT(flight.off(runway), 120.0);
}

TEST(Rover, DrivesToAPointBehindIt) {
  Flight flight{.airframe = airframe_of(Family::rover), .pace = {.speed_m_s = 5.0}};
  flight.pursue(FlyTo{{-30.0, 5.0, 0.0}, {}, false}, 40.0);
  EXPECT_LT(flight.off({-30.0, 5.0, 0.0}), 1.0);
  EXPECT_LT(flight.body.ground_speed_m_s(), 0.2);
}

TEST(Rover, CannotMoveSideways) {
  Flight flight{.airframe = airframe_of(Family::rover), .pace = {.speed_m_s = 5.0}};
  for (int i = 0; i < 200; ++i) {
    flight.pursue(FlyTo{{10.0, 30.0, 0.0}, {}, false}, dt_s);
    auto const& v = flight.body.velocity_m_s;
    double const yaw = flight.body.attitude.yaw_rad;
    EXPECT_NEAR(-v.north * std::sin(yaw) + v.east * std::cos(yaw), 0.0, 1e-9);
  }
}

TEST(Dynamics, SameInputsGiveTheSameBodyBitForBit) {
  auto fly = [] {
    auto flight = copter_at(10.0);
    flight.wind = {3.0, -2.0, 0.0};
    flight.pursue(FlyTo{{120.0, 33.0, -25.0}, {}, true}, 30.0);
    return flight.body;
  };
  EXPECT_EQ(fly().position_m, fly().position_m);
  EXPECT_EQ(fly().velocity_m_s, fly().velocity_m_s);
}

TEST(ClosingSpeed, StopsAtTheTarget) {
  EXPECT_DOUBLE_EQ(closing_speed(0.0, 1.0, 2.5), 0.0);
  EXPECT_NEAR(closing_speed(51.25, 1.0, 2.5), std::sqrt(2.0 * 2.5 * 50.0), 1e-9);
  EXPECT_LT(closing_speed(-10.0, 1.0, 2.5), 0.0);
}

TEST(BatteryPack, HoverDrainsChargeAndVoltageDropsUnderLoad) {
  BatteryPack pack(5000.0);
  auto body = copter_at(10.0).body;
  double const idle_v = pack.voltage_v();
  double const current = current_drawn_a(body, airframe_of(Family::copter), true);
  for (int i = 0; i < 60 * 20; ++i) pack.drain(current, dt_s);
  EXPECT_NEAR(pack.used_mah(), current * 1000.0 / 60.0, 0.5);
  EXPECT_LT(pack.voltage_v(), idle_v - 0.2);
  EXPECT_NEAR(pack.remaining(), 1.0 - pack.used_mah() / 5000.0, 1e-12);
}

TEST(BatteryPack, NeverGoesBelowEmpty) {
  BatteryPack pack(100.0, 0.01);
  pack.drain(1000.0, 60.0);
  EXPECT_EQ(pack.remaining(), 0.0);
  EXPECT_LT(pack.voltage_v(), 9.7);
}

TEST(StartUp, PassesNoFixThenFixThenPosition) {
  StartUp const start(realistic_boot());
  EXPECT_EQ(start.at(5s).fix_type, 0);
  EXPECT_FALSE(start.at(5s).position_known);
  EXPECT_EQ(start.at(10s).fix_type, 6);
  EXPECT_EQ(start.at(30s).ekf_flags, 0xA7);
  EXPECT_FALSE(start.at(41s).position_ok);
  EXPECT_EQ(start.at(42s).ekf_flags, 0x33F);
  StartUp const quick(quick_boot());
  EXPECT_EQ(quick.at(1s).fix_type, 0);
  EXPECT_TRUE(quick.at(3s).position_ok);
}

TEST(StartUp, LosesThePositionEightSecondsAfterTheGps) {
  StartUp start(quick_boot());
  start.lose_gps(20s);
  EXPECT_EQ(start.at(21s).fix_type, 1);
  EXPECT_TRUE(start.at(27s).position_ok);
  EXPECT_EQ(start.at(29s).ekf_flags, 0x25);
  EXPECT_EQ(start.at(33s).ekf_flags, 0xA7);
  start.restore_gps(40s);
  EXPECT_EQ(start.at(44s).fix_type, 6);
  EXPECT_TRUE(start.at(47s).position_ok);
}

}  // namespace
}  // namespace lapwing::sim
