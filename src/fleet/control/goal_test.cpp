#include "fleet/control/goal.hpp"

#include <gtest/gtest.h>

#include "fleet/testing/autopilot.hpp"
#include "fleet/testing/test_hand.hpp"
#include "mavlink/wire/modes.hpp"

namespace lapwing::fleet {
namespace {

using namespace std::chrono_literals;
using vehicle::Action;
using Kind = Standing::Kind;

/// A copter, armed and in GUIDED at 20 m, that is heard when a test says so.
struct GoalTest : ::testing::Test {
  GoalTest() {
    state.family = vehicle::Family::copter;
    state.autopilot = vehicle::Autopilot::ardupilot;
    state.motion.home.set(home, now);
    TestHand::heard_of(craft).mav_autopilot = mavlink::MavAutopilot::ardupilotmega;
    flies(20.0);
    beats(copter_mode::guided);
  }

  void beats(std::uint32_t mode, bool is_armed = true) {
    auto& heard = TestHand::heard_of(craft);
    if (heard.custom_mode != mode) heard.mode_changed = now;
    heard.custom_mode = mode;
    heard.is_armed = is_armed;
    state.links.heartbeat_heard = now;
  }
  void flies(double height_m, double north_m = 0.0, geo::Ned velocity = {}) {
    state.motion.position.set(geo::displaced(home, {.north = north_m, .east = 0.0, .down = -height_m}), now);
    state.motion.relative_alt_m.set(height_m, now);
    state.motion.velocity_m_s.set(velocity, now);
    state.motion.landed.set(height_m <= 0.0, now);
  }
  void says(std::string text) { state.recent_texts.push_back({.severity = 2, .text = std::move(text), .heard = now}); }
  /// The command as given now and acknowledged at once.
  Goal given(vehicle::VehicleCommand command) {
    Goal goal(craft, std::move(command), now);
    now += 10ms;
    goal.acknowledge(now);
    return goal;
  }
  Standing look(Goal& goal) const { return goal.look(craft, now); }
  /// What a mode other than the command's comes to, once there was time to explain it.
  Standing look_later(Goal& goal) {
    now += 600ms;
    return look(goal);
  }

  geo::Wgs84 const home = TestAutopilot::home;
  base::Loop loop{{.unpaced = true}};
  mavlink::Connection connection{loop, {}, base::Logger()};
  vehicle::VehicleState state;
  MavlinkVehicle craft{connection, state};
  base::TimePoint now{1min};
};

TEST_F(GoalTest, ProvesNoArmingByAnOlderHeartbeat) {
  auto goal = given({.action = Action::arm});
  now += 13s;
  EXPECT_EQ(look(goal).kind, Kind::unseen) << "it was armed before";
  beats(copter_mode::guided);
  EXPECT_EQ(look(goal).kind, Kind::reached);
  auto disarm = given({.action = Action::disarm});
  EXPECT_EQ(look(disarm).kind, Kind::unseen);
  beats(copter_mode::guided, false);
  EXPECT_EQ(look(disarm).kind, Kind::reached);
}

TEST_F(GoalTest, ProvesNoModeByAnOlderHeartbeat) {
  auto goal = given({.action = Action::set_mode, .mode = "GUIDED"});
  EXPECT_EQ(look(goal).kind, Kind::unseen);
  beats(copter_mode::guided);
  EXPECT_EQ(look(goal).kind, Kind::reached);
  EXPECT_EQ(look(goal).text, "GUIDED");
}

TEST_F(GoalTest, TakesAMissionForStartedWhenItFliesItArmed) {
  auto goal = given({.action = Action::start_mission});
  beats(copter_mode::automatic, false);
  EXPECT_EQ(look(goal).kind, Kind::unseen);
  beats(copter_mode::automatic);
  EXPECT_EQ(look(goal).kind, Kind::reached);
}

TEST_F(GoalTest, ReachesATakeOffAtItsHeightOnly) {
  flies(0.0);
  beats(copter_mode::guided, false);
  auto goal = given({.action = Action::take_off, .height_m = 20.0});
  EXPECT_EQ(look(goal).kind, Kind::unseen);
  beats(copter_mode::guided);
  flies(0.1);
  EXPECT_EQ(look(goal).kind, Kind::under_way);
  flies(7.2);
  EXPECT_EQ(look(goal).text, "at 7 of 20 m");
  EXPECT_NEAR(look(goal).left_m.value_or(0.0), 12.8, 1e-9);
  flies(19.0);
  EXPECT_EQ(look(goal).kind, Kind::under_way);
  flies(19.7);
  EXPECT_EQ(look(goal).kind, Kind::reached);
}

TEST_F(GoalTest, IsNotMisledByTheHeightOfAPadAboveHome) {
  flies(6.0);
  state.motion.landed.set(true, now);
  beats(copter_mode::guided, false);
  auto goal = given({.action = Action::take_off, .height_m = 20.0});
  beats(copter_mode::guided);
  state.motion.relative_alt_m.set(6.0, now);
  EXPECT_EQ(look(goal).kind, Kind::unseen);
  EXPECT_EQ(look(goal).text, "it has not left the ground");
}

TEST_F(GoalTest, SaysWhatCutATakeOffShort) {
  flies(0.0);
  auto goal = given({.action = Action::take_off, .height_m = 20.0});
  beats(copter_mode::guided);
  flies(7.0);
  EXPECT_EQ(look(goal).kind, Kind::under_way);
  beats(copter_mode::rtl);
  EXPECT_EQ(look(goal).kind, Kind::under_way) << "its reason comes after the mode";
  says("Battery Failsafe");
  auto const cut = look_later(goal);
  EXPECT_EQ(cut.kind, Kind::cut_short);
  EXPECT_EQ(cut.text, "mode changed to RTL: Battery Failsafe, at 7 of 20 m");
}

TEST_F(GoalTest, SaysWhatAnotherStationCutShort) {
  auto goal = given({.action = Action::go_to, .place = geo::displaced(home, {.north = 300, .east = 0, .down = 0})});
  beats(copter_mode::guided);
  (void)look(goal);
  beats(copter_mode::brake);
  state.foreign_change.set("station 254/190 commanded DO_SET_MODE: accepted", now);
  flies(20.0);
  auto const cut = look_later(goal);
  EXPECT_EQ(cut.kind, Kind::cut_short);
  EXPECT_EQ(cut.text, "mode changed to BRAKE (station 254/190 commanded DO_SET_MODE: accepted), 300 m to go");
}

TEST_F(GoalTest, EndsATakeOffThatIsDisarmed) {
  flies(0.0);
  auto goal = given({.action = Action::take_off, .height_m = 20.0});
  beats(copter_mode::guided);
  (void)look(goal);
  beats(copter_mode::guided, false);
  EXPECT_EQ(look(goal).kind, Kind::cut_short);
  EXPECT_EQ(look(goal).text.substr(0, 8), "disarmed");
}

TEST_F(GoalTest, LetsPx4EndATakeOffAtItsOwnHeight) {
  state.autopilot = vehicle::Autopilot::px4;
  auto const mode = [](std::string_view name) {
    return *mavlink::mode_number(vehicle::Autopilot::px4, vehicle::Family::copter, name);
  };
  flies(0.0);
  auto goal = given({.action = Action::take_off, .height_m = 20.0});
  beats(mode("AUTO.TAKEOFF"));
  flies(3.0, 0.0, {.north = 0, .east = 0, .down = -1.5});
  EXPECT_EQ(look(goal).text, "at 3 m, to the height of its own setting");
  beats(mode("AUTO.LOITER"));
  flies(5.0);
  EXPECT_EQ(look(goal).kind, Kind::reached);
}

TEST_F(GoalTest, LetsAPlaneEndATakeOffWhenItClimbsNoMore) {
  state.family = vehicle::Family::plane;
  auto const mode = *mavlink::mode_number(state.autopilot, state.family, "TAKEOFF");
  flies(0.0);
  auto goal = given({.action = Action::take_off});
  beats(mode);
  flies(30.0, 0.0, {.north = 15, .east = 0, .down = -3.0});
  EXPECT_EQ(look(goal).kind, Kind::under_way);
  flies(50.0, 0.0, {.north = 15, .east = 0, .down = 0.0});
  EXPECT_EQ(look(goal).kind, Kind::under_way);
  now += 4s;
  flies(50.0, 0.0, {.north = 15, .east = 0, .down = 0.0});
  EXPECT_EQ(look(goal).kind, Kind::reached);
}

struct GoTo : GoalTest {
  geo::Wgs84 const there = geo::displaced(home, {.north = 300, .east = 0, .down = 0});
  void targets(geo::Wgs84 const& place) { state.mission.position_target.set(place, now); }
};

TEST_F(GoTo, IsNotProvedByBeingGuided) {
  targets(there);
  auto goal = given({.action = Action::go_to, .place = there});
  beats(copter_mode::guided);
  flies(20.0);
  EXPECT_EQ(look(goal).kind, Kind::unseen) << "the target is older than the command";
  EXPECT_EQ(look(goal).text, "it does not come nearer");
}

TEST_F(GoTo, IsProvedByItsTarget) {
  auto goal = given({.action = Action::go_to, .place = there});
  beats(copter_mode::guided);
  flies(20.0);
  targets(home);
  EXPECT_EQ(look(goal).kind, Kind::unseen);
  EXPECT_EQ(look(goal).text, "it heads for a place 300 m from there");
  targets(there);
  EXPECT_EQ(look(goal).kind, Kind::under_way);
  EXPECT_EQ(look(goal).text, "300 m to go");
  targets(home);
  EXPECT_EQ(look(goal).kind, Kind::cut_short);
  EXPECT_EQ(look(goal).text, "it was sent somewhere else, 300 m to go");
}

TEST_F(GoTo, IsProvedByComingNearerWhereNoTargetIsTold) {
  auto goal = given({.action = Action::go_to, .place = there});
  beats(copter_mode::guided);
  flies(20.0);
  EXPECT_EQ(look(goal).kind, Kind::unseen);
  flies(20.0, 50.0);
  EXPECT_EQ(look(goal).kind, Kind::under_way);
  EXPECT_EQ(look(goal).text, "250 m to go");
  flies(20.0, 298.5);
  EXPECT_EQ(look(goal).kind, Kind::reached);
}

TEST_F(GoTo, IsThereAtItsHeightOnly) {
  auto goal = given({.action = Action::go_to, .height_m = 60.0, .place = there});
  beats(copter_mode::guided);
  flies(20.0);
  (void)look(goal);
  flies(45.0, 299.5);
  EXPECT_EQ(look(goal).kind, Kind::under_way);
  EXPECT_EQ(look(goal).text, "15 m to climb");
  flies(59.0, 299.5);
  EXPECT_EQ(look(goal).kind, Kind::reached);
}

TEST_F(GoTo, SaysWhenItComesNoNearer) {
  auto goal = given({.action = Action::go_to, .place = there});
  beats(copter_mode::guided);
  flies(20.0);
  (void)look(goal);
  flies(20.0, 100.0);
  (void)look(goal);
  now += 30s;
  flies(20.0, 100.0);
  EXPECT_EQ(look(goal).text, "200 m to go, no nearer for 30 s");
}

TEST_F(GoTo, IsThereForAPlaneThatCirclesIt) {
  state.family = vehicle::Family::plane;
  auto const guided = *mavlink::mode_for(state.autopilot, state.family, mavlink::ModeRole::guided);
  beats(guided);
  auto goal = given({.action = Action::go_to, .place = there});
  beats(guided);
  flies(20.0);
  (void)look(goal);
  flies(20.0, 100.0);
  EXPECT_EQ(look(goal).kind, Kind::under_way);
  flies(20.0, 230.0);
  EXPECT_EQ(look(goal).kind, Kind::reached);
  EXPECT_EQ(look(goal).text, "circles it, 70 m away");
}

TEST_F(GoalTest, HasLandedOnTheGroundWithMotorsOff) {
  auto goal = given({.action = Action::land});
  EXPECT_EQ(look(goal).kind, Kind::unseen);
  beats(copter_mode::land);
  flies(12.0);
  EXPECT_EQ(look(goal).text, "at 12 m");
  flies(0.0);
  EXPECT_EQ(look(goal).kind, Kind::under_way);
  EXPECT_EQ(look(goal).text, "on the ground, motors still on");
  beats(copter_mode::land, false);
  EXPECT_EQ(look(goal).kind, Kind::reached);
}

TEST_F(GoalTest, SeesALandingOfWhichItHeardNothingButTheEnd) {
  auto goal = given({.action = Action::land});
  now += 60s;
  EXPECT_EQ(look(goal).kind, Kind::unseen);
  flies(0.0);
  beats(copter_mode::land, false);
  EXPECT_EQ(look(goal).kind, Kind::reached);
}

TEST_F(GoalTest, SaysWhenALandingIsBrokenOff) {
  auto goal = given({.action = Action::land});
  beats(copter_mode::land);
  flies(12.0);
  (void)look(goal);
  beats(copter_mode::guided);
  EXPECT_EQ(look_later(goal).kind, Kind::cut_short);
}

TEST_F(GoalTest, HasReturnedWhenItHasLandedAtHome) {
  flies(20.0, 250.0);
  auto goal = given({.action = Action::return_home});
  beats(copter_mode::rtl);
  flies(20.0, 250.0, {.north = -5, .east = 0, .down = 0});
  EXPECT_EQ(look(goal).kind, Kind::under_way);
  EXPECT_EQ(look(goal).text, "250 m from home, at 20 m");
  flies(0.0, 0.5);
  beats(copter_mode::rtl, false);
  EXPECT_EQ(look(goal).kind, Kind::reached);
}

TEST_F(GoalTest, HasNotReturnedWhenItLandsOnTheWay) {
  flies(20.0, 250.0);
  auto goal = given({.action = Action::return_home});
  beats(copter_mode::rtl);
  flies(10.0, 250.0);
  (void)look(goal);
  flies(0.0, 250.0);
  beats(copter_mode::rtl, false);
  EXPECT_EQ(look(goal).kind, Kind::cut_short);
  EXPECT_EQ(look(goal).text, "on the ground, motors off, 250 m from home");
}

TEST_F(GoalTest, HasReturnedWhenItStaysAboveHome) {
  auto goal = given({.action = Action::return_home});
  beats(copter_mode::rtl);
  flies(15.0);
  EXPECT_EQ(look(goal).kind, Kind::under_way);
  now += 16s;
  flies(15.0);
  EXPECT_EQ(look(goal).kind, Kind::reached);
  EXPECT_EQ(look(goal).text, "above home at 15 m");
}

TEST_F(GoalTest, HoldsWhenItStands) {
  auto goal = given({.action = Action::hold});
  beats(copter_mode::brake);
  flies(20.0, 0.0, {.north = 6.2, .east = 0, .down = 0});
  EXPECT_EQ(look(goal).kind, Kind::under_way);
  EXPECT_EQ(look(goal).text, "BRAKE, still 6.2 m/s");
  flies(20.0);
  EXPECT_EQ(look(goal).kind, Kind::reached);
  EXPECT_EQ(look(goal).text, "BRAKE, stands");
}

}  // namespace
}  // namespace lapwing::fleet
