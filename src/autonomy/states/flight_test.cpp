// The machine flies: a copter as one point, a planner that knows the lot, and an operator who may fall silent.

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "autonomy/testing/bench.hpp"
#include "autonomy/testing/point_mass.hpp"

namespace lapwing::autonomy {
namespace {

using namespace testing;

struct Flight {
  Machine machine = Machine();
  PointMass drone = {};
  Told told = ready();
  base::TimePoint now = base::TimePoint(1h);
  geo::Box<ArmingFrame> lot{geo::Point<ArmingFrame>(10, -10), geo::Point<ArmingFrame>(90, 60)};
  std::optional<geo::Point3<ArmingFrame>> wanted = {};
  Said said = {};
  double highest_m = 0;

  [[nodiscard]] State state() const { return machine.memory().state; }

  void step() {
    now += frame;
    drone.pass(frame);
    told.flight = drone.state();
    told.flight->drain = vehicle::Drain{.per_s = drone.drain_per_s, .error = 0.1};
    if (wanted) told.place = {lot.contains({wanted->x(), wanted->y()}), now};
    said = machine.step(told, now);
    told.commands.clear();
    drone.take(said);
    if (said.wanted_place) wanted = said.wanted_place->place;
    if (state() == State::autonomous_explore || told.setpoint) explore();
    highest_m = std::max(highest_m, drone.place().z());
  }
  /// The planner's, which goes on wanting whatever the state is.
  void explore() {
    told.setpoint = {.place = geo::Point3<ArmingFrame>(120, 50, 10), .at = now};
    told.sees_lot = lot.contains({drone.place().x(), drone.place().y()}) || drone.place().x() < lot.least.x();
  }
  void give(Command command) {
    told.commands.push_back(std::move(command));
    step();
  }
  /// Whether that state came within the time.
  [[nodiscard]] bool reaches(State wanted_state, base::Duration within) {
    for (auto const end = now + within; now < end && state() != wanted_state;) step();
    return state() == wanted_state;
  }
  [[nodiscard]] bool is_armed_within(base::Duration within) {
    for (auto const end = now + within; now < end && !drone.state().is_armed;) step();
    return drone.state().is_armed;
  }
  void take_off() {
    step();
    give(command::Arm{});
    ASSERT_TRUE(is_armed_within(5s));
    step();
    give(command::Takeoff{});
    ASSERT_TRUE(reaches(State::hover, 10s));
  }
  [[nodiscard]] double from_m(double x_m, double y_m) const {
    return std::hypot(drone.place().x() - x_m, drone.place().y() - y_m);
  }
};

TEST(Flight, GoesUpAboutAndDown) {
  Flight flight;
  flight.take_off();
  EXPECT_NEAR(flight.drone.place().z(), 10, 0.6);
  flight.give(command::AutonomousMove{.place = {40, 50}});
  ASSERT_TRUE(flight.reaches(State::hover, 15s));
  EXPECT_LT(flight.from_m(40, 50), 1.5);
  flight.give(command::CompulsiveMove{.place = geo::Point<ArmingFrame>(-20, 0)});
  ASSERT_TRUE(flight.reaches(State::hover, 20s));
  EXPECT_LT(flight.from_m(-20, 0), 1.5);
  flight.give(command::Land{});
  ASSERT_TRUE(flight.reaches(State::idle, 60s));
  EXPECT_FALSE(flight.drone.state().is_armed);
  EXPECT_LT(flight.from_m(0, 0), 0.5);
  EXPECT_LT(flight.highest_m, 11);
}

TEST(Flight, ExploresUntilTheLotEndsAndWaitsThere) {
  Flight flight;
  flight.take_off();
  flight.give(command::AutonomousExplore{});
  ASSERT_TRUE(flight.reaches(State::no_parking_lot_detected, 30s));
  auto const x_m = flight.drone.place().x();
  EXPECT_GT(x_m, 90);
  for (int i = 0; i < 200; ++i) flight.step();
  EXPECT_NEAR(flight.drone.place().x(), x_m, 1.0);
  EXPECT_EQ(flight.said.user_error, UserError::no_lot_detected);
}

TEST(Flight, DoesNotFlyToAPlaceOutsideTheLot) {
  Flight flight;
  flight.take_off();
  flight.give(command::AutonomousMove{.place = {95, 50}});
  ASSERT_TRUE(flight.reaches(State::desired_location_error, 5s));
  EXPECT_LT(flight.from_m(0, 0), 0.5);
  flight.give(command::AutonomousMove{.place = {85, 50}});
  ASSERT_TRUE(flight.reaches(State::hover, 20s));
  EXPECT_LT(flight.from_m(85, 50), 1.5);
}

TEST(Flight, ReturnsWhenTheOperatorFallsSilentAndWaitsWhenHeIsBack) {
  Flight flight;
  flight.take_off();
  flight.give(command::AutonomousMove{.place = {80, 50}});
  flight.step();
  flight.told.link = {.is_up = false, .silence = 3001ms};
  flight.step();
  EXPECT_EQ(flight.state(), State::communication_lost);
  for (int i = 0; i < 40; ++i) flight.step();
  flight.told.link = {.is_up = true, .silence = 0s};
  flight.step();
  EXPECT_EQ(flight.state(), State::hover);
  flight.step();
  auto const here = flight.drone.place();
  for (int i = 0; i < 100; ++i) flight.step();
  EXPECT_LT(geo::distance_m(flight.drone.place(), here), 1.0);
}

TEST(Flight, ComesDownAtHomeWhenTheOperatorStaysSilent) {
  Flight flight;
  flight.take_off();
  flight.give(command::AutonomousExplore{});
  for (int i = 0; i < 100; ++i) flight.step();
  flight.told.link = {.is_up = false, .silence = 4s};
  ASSERT_TRUE(flight.reaches(State::idle, 60s));
  EXPECT_LT(flight.from_m(0, 0), 0.5);
}

TEST(Flight, ReturnsWhileTheBatteryStillLastsForIt) {
  Flight flight;
  flight.drone.drain_per_s = 1.0 / 300.0;
  flight.take_off();
  flight.give(command::CompulsiveMove{.place = geo::Point<ArmingFrame>(0, 600)});
  ASSERT_TRUE(flight.reaches(State::land, 200s));
  EXPECT_GT(flight.drone.place().y(), 300);
  ASSERT_TRUE(flight.reaches(State::idle, 200s));
  EXPECT_LT(flight.from_m(0, 0), 0.5);
  EXPECT_GT(*flight.drone.state().battery, 0.05);
}

TEST(Flight, LandsWhereItIsWhenItCannotReturn) {
  Flight flight;
  flight.drone.can_return = false;
  flight.take_off();
  flight.told.processes[1].silence = 5s;
  flight.step();
  EXPECT_EQ(flight.state(), State::malfunction);
  ASSERT_TRUE(flight.reaches(State::idle, 60s));
  EXPECT_FALSE(flight.drone.state().is_armed);
}

TEST(Flight, ArmsAgainWhenItWaitsTooLongOnTheGround) {
  Flight flight;
  flight.step();
  flight.give(command::Arm{});
  ASSERT_TRUE(flight.reaches(State::idle, 120s)) << "not for ever";
  EXPECT_FALSE(flight.drone.state().is_armed);
}

}  // namespace
}  // namespace lapwing::autonomy
