#include "fleet/plausibility/doubts.hpp"

#include <algorithm>

#include <gtest/gtest.h>

#include "fleet/testing/control_world.hpp"

// What makes no sense is refused before anything moves; what is not known, or allowed, passes.
namespace lapwing::fleet {
namespace {

using namespace std::chrono_literals;
using mavlink::MavCmd;
using tasks::RunState;
using vehicle::Action;
using vehicle::CommandState;
using vehicle::VehicleId;

geo::Wgs84 beside(double north_m) {
  return geo::displaced(TestAutopilot::home, {.north = north_m});
}

struct Flight : ::testing::Test {
  /// Flies the mission on a copter that stands at home; its end.
  RunState end_of(plan::Mission mission, FleetPlatform::Options options = {}) {
    world = std::make_unique<TestWorld>(Fleet::Options{}, std::move(options));
    copter = &world->add();
    world->run_for(5s);
    run = world->platform->start(task_of(std::move(mission)), VehicleId{"1"});
    (void)world->run_until([this] { return run->state() != RunState::in_progress; }, 300s);
    return run->state();
  }
  [[nodiscard]] bool was_moved() const {
    return copter->commands_heard(MavCmd::component_arm_disarm) + copter->commands_heard(MavCmd::do_set_home) > 0;
  }
  std::unique_ptr<TestWorld> world;
  TestAutopilot* copter = nullptr;
  std::unique_ptr<tasks::TaskRun> run;
};

TEST_F(Flight, DoesNotMoveHomeFarFromWhereTheVehicleStands) {
  auto mission = mission_ending_with(MavCmd::nav_land);
  mission.home = beside(400.0);
  EXPECT_EQ(end_of(mission), RunState::failed);
  EXPECT_NE(run->error().find("home would be moved 400 m"), std::string::npos) << run->error();
  EXPECT_FALSE(was_moved());
  EXPECT_TRUE(copter->mission.empty()) << "it was not even sent";
}

TEST_F(Flight, SaysThatHomeIsMovedAtAll) {
  auto mission = mission_ending_with(MavCmd::nav_land);
  mission.home = beside(40.0);
  EXPECT_EQ(end_of(mission), RunState::done) << run->error();
  EXPECT_TRUE(world->has_logged("home moves 40 m"));
}

TEST_F(Flight, DoesNotFlyAltitudesAboveTheGroundWhereTheyCountFromTheSea) {
  auto mission = mission_ending_with(MavCmd::nav_land);
  for (auto& item : mission.items) item.place.z_m -= 100.0;
  mission.home = geo::Wgs84{TestAutopilot::home.lat_rad, TestAutopilot::home.lon_rad, 0.0};
  EXPECT_EQ(end_of(mission), RunState::failed);
  EXPECT_NE(run->error().find("it looks like a height above the ground"), std::string::npos) << run->error();
  EXPECT_FALSE(was_moved());
}

TEST_F(Flight, FliesWhatSomebodyAllowsAndLogsTheReason) {
  auto mission = mission_ending_with(MavCmd::nav_land);
  mission.home = beside(400.0);
  plan::plausibility::Settings settings;
  ASSERT_TRUE(add_allowance(settings, "home_moved=the other pad"));
  EXPECT_EQ(end_of(mission, {.run = {.plausibility = settings}}), RunState::done) << run->error();
  EXPECT_TRUE(world->has_logged("[home_moved]: allowed: the other pad"));
}

TEST_F(Flight, TakesOffAgainBeforeASecondMission) {
  ASSERT_EQ(end_of(mission_ending_with(MavCmd::nav_land)), RunState::done);
  auto second = mission_ending_with(MavCmd::nav_land);
  second.items.erase(second.items.begin());
  auto const armings = copter->commands_heard(MavCmd::component_arm_disarm);
  run = world->platform->start(task_of(second), VehicleId{"1"});
  ASSERT_TRUE(world->run_until([this] { return run->state() == RunState::failed; }, 60s));
  EXPECT_NE(run->error().find("without a take-off"), std::string::npos) << run->error();
  EXPECT_EQ(copter->commands_heard(MavCmd::component_arm_disarm), armings);
}

TEST_F(Flight, WarnsOfTwoThatLandOnOneSpot) {
  world = std::make_unique<TestWorld>();
  world->add({.address = {1, 1}});
  world->add({.address = {2, 1}});
  world->run_for(5s);
  run = world->platform->start(task_of(mission_ending_with(MavCmd::nav_land)), VehicleId{"1"});
  world->run_for(3s);
  EXPECT_TRUE(world->has_logged("[shared_pad]"));
}

TEST(PickedVehicles, AreCountedBeforeTheFirstIsChosen) {
  TestWorld world;
  world.add({.address = {2, 1}});
  ASSERT_TRUE(world.run_until([&] { return world.platform->find(VehicleId{"2"}).has_value(); }));
  EXPECT_TRUE(world.platform->vehicles().empty()) << "another may be heard within the next second";
  world.add({.address = {1, 1}});
  world.run_for(3s);
  ASSERT_EQ(world.platform->vehicles().size(), 2u);
  EXPECT_EQ(world.platform->vehicles().front().id.text, "1");
}

// ---- by hand

TEST(OperatorsCommand, GoesToNoPlaceThatCannotBeMeant) {
  ControlWorld world;
  auto& copter = world.add_flying();
  auto const reason_of = [&](geo::Wgs84 place, std::optional<double> height_m = std::nullopt) {
    auto const number = world.give({.action = Action::go_to, .height_m = height_m, .place = place});
    EXPECT_EQ(world.end_of(number), CommandState::refused);
    return world.outcome(number).reason;
  };
  EXPECT_NE(reason_of(geo::Wgs84::from_degrees(-8.0, 40.0)).find("swapped"), std::string::npos);
  EXPECT_NE(reason_of(beside(60'000.0)).find("60.0 km"), std::string::npos);
  EXPECT_NE(reason_of(geo::Wgs84{}).find("latitude 0"), std::string::npos);
  EXPECT_NE(reason_of(beside(100.0), -50.0).find("below the ground"), std::string::npos);
  EXPECT_NE(reason_of(beside(100.0), 5'000.0).find("ceiling of 120 m"), std::string::npos);
  EXPECT_EQ(copter.commands_heard(MavCmd::do_reposition), 0);
}

TEST(OperatorsCommand, GoesThereWhenItIsAllowedByNameWithAReason) {
  ControlWorld world;
  auto& copter = world.add_flying();
  auto const far = beside(6'000.0);
  EXPECT_EQ(world.give({.action = Action::go_to, .place = far, .allow = {{"too_farr", "x"}}}), 0u);
  EXPECT_EQ(world.give({.action = Action::go_to, .place = far, .allow = {{"too_far", " "}}}), 0u);
  auto const number = world.give({.action = Action::go_to, .place = far, .allow = {{"too_far", "area B"}}});
  EXPECT_NE(world.end_of(number), CommandState::refused) << world.outcome(number).reason;
  EXPECT_EQ(copter.commands_heard(MavCmd::do_reposition), 1);
  EXPECT_TRUE(world.has_logged("allowed: area B"));
}

TEST(OperatorsCommand, StartsNoMissionThatTheVehicleDoesNotHold) {
  ControlWorld world;
  auto& copter = world.add_ready();
  auto const number = world.give({.action = Action::start_mission});
  EXPECT_EQ(world.end_of(number), CommandState::refused);
  EXPECT_EQ(world.outcome(number).reason, "copter 1 holds no mission; upload one first [empty_mission]");
  EXPECT_EQ(copter.commands_heard(MavCmd::component_arm_disarm), 0);
}

std::vector<mavlink::MissionItem> mission_of_another_place() {
  auto mission = mission_ending_with(MavCmd::nav_land);
  for (auto& item : mission.items) item.place.lat_rad += 0.05;
  return plan::for_autopilot(mission, vehicle::Autopilot::ardupilot, TestAutopilot::home);
}

TEST(OperatorsCommand, StartsNoMissionOfAnotherPlace) {
  ControlWorld world;
  auto& copter = world.add_ready();
  copter.mission = mission_of_another_place();
  auto const number = world.give({.action = Action::start_mission});
  EXPECT_EQ(world.end_of(number), CommandState::refused);
  EXPECT_NE(world.outcome(number).reason.find("[too_far]"), std::string::npos) << world.outcome(number).reason;
  EXPECT_EQ(world.outcome(number).rule, "too_far");
  EXPECT_EQ(copter.commands_heard(MavCmd::component_arm_disarm), 0);
}

TEST(OperatorsCommand, GetsNoVehicleToFlyAMissionOfAnotherPlaceByOtherWords) {
  ControlWorld world;
  auto& copter = world.add_flying();
  copter.mission = mission_of_another_place();
  auto const modes = copter.modes_commanded().size();
  auto const is_refused = [&](vehicle::VehicleCommand command, std::string const& id = "1") {
    auto const number = world.give(std::move(command), {id});
    return world.end_of(number) == CommandState::refused && world.outcome(number).reason.contains("[too_far]");
  };
  EXPECT_TRUE(is_refused({.action = Action::resume_mission}));
  EXPECT_TRUE(is_refused({.action = Action::set_mode, .mode = "AUTO"}));
  EXPECT_EQ(copter.modes_commanded().size(), modes);

  auto& rover = world.add_ready(a_rover(2));
  rover.mission = mission_of_another_place();
  rover.change_mode(rover_mode::automatic);
  world.run_for(2s);
  EXPECT_TRUE(is_refused({.action = Action::arm}, "2")) << "it would set off at once";
  EXPECT_EQ(rover.commands_heard(MavCmd::component_arm_disarm), 0);
}

TEST(OperatorsCommand, LetsAModeBeChosenAtLeisureOnTheGround) {
  ControlWorld world;
  auto& rover = world.add_ready(a_rover(2));
  rover.mission = mission_of_another_place();
  auto const number = world.give({.action = Action::set_mode, .mode = "AUTO"}, {"2"});
  EXPECT_EQ(world.end_of(number), CommandState::confirmed) << world.outcome(number).reason;
}

TEST(OperatorsCommand, TakesOffToNoHeightAboveTheCeiling) {
  ControlWorld world;
  auto& copter = world.add_ready();
  EXPECT_EQ(world.end_of(world.give({.action = Action::take_off, .height_m = 130.0})), CommandState::refused);
  EXPECT_EQ(copter.commands_heard(MavCmd::component_arm_disarm), 0);
  plan::plausibility::Settings high;
  high.limits.ceiling_m = 150.0;
  ControlWorld mountains({.plausibility = high});
  mountains.add_ready();
  auto const number = mountains.give({.action = Action::take_off, .height_m = 130.0});
  EXPECT_EQ(mountains.end_of(number), CommandState::confirmed) << mountains.outcome(number).reason;
}

}  // namespace
}  // namespace lapwing::fleet
