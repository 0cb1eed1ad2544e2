#include "vehicle/joined/joined_control.hpp"

#include <gtest/gtest.h>

#include "vehicle/testing/recording_control.hpp"

namespace lapwing::vehicle {
namespace {

using testing::RecordingControl;
using Ids = std::vector<VehicleId>;

struct JoinedControlTest : ::testing::Test {
  JoinedControlTest() {
    all.add("MAVLink", drones);
    all.add("test", robots);
  }
  [[nodiscard]] CommandRecord const& last() const { return all.commands().back(); }

  RecordingControl drones{{"1", "2", "both"}, 5};
  RecordingControl robots{{"a1", "both"}, 70};
  JoinedControl all;
};

TEST_F(JoinedControlTest, GivesEachPlatformItsVehiclesAndShowsOneCommand) {
  auto const number = all.command({.action = Action::hold}, Ids{{"a1"}, {"2"}, {"1"}}, "anna", false);
  EXPECT_EQ(number, 1u) << "a number of its own: the platforms count apart";
  ASSERT_EQ(last().outcomes.size(), 3u);
  EXPECT_EQ(last().outcomes[0].vehicle.text, "a1") << "in the order in which they were named";
  EXPECT_EQ(last().outcomes[2].state, CommandState::confirmed);
  EXPECT_EQ(drones.commands().back().outcomes.size(), 2u);
  EXPECT_EQ(robots.commands().back().outcomes.size(), 1u);
}

TEST_F(JoinedControlTest, FollowsWhatBecomesOfItOnEachPlatform) {
  (void)all.command({.action = Action::hold}, Ids{{"1"}, {"a1"}}, "anna", false);
  auto const before = all.revision();
  robots.becomes("a1", CommandState::cut_short);
  EXPECT_GT(all.revision(), before);
  EXPECT_EQ(last().outcomes[1].state, CommandState::cut_short);
  (void)all.command({.action = Action::hold}, Ids{{"1"}}, "anna", false);
  EXPECT_EQ(all.commands().front().outcomes[1].state, CommandState::cut_short);
  EXPECT_EQ(last().number, 2u);
}

TEST_F(JoinedControlTest, RefusesAVehicleThatTwoPlatformsHave) {
  EXPECT_TRUE(all.command({.action = Action::hold}, Ids{{"both"}, {"1"}, {"9"}}, "anna", true));
  EXPECT_EQ(last().outcomes[0].reason, "conflict: MAVLink and test each have a vehicle both");
  EXPECT_EQ(last().outcomes[1].state, CommandState::confirmed);
  EXPECT_EQ(last().outcomes[2].reason, "there is no vehicle 9");
  EXPECT_EQ(drones.commands().back().outcomes.size(), 1u);
  EXPECT_TRUE(robots.commands().empty());
  EXPECT_EQ(all.request_control({"both"}, "anna").error().kind, base::ErrorKind::refused);
  EXPECT_TRUE(drones.said.empty() && robots.said.empty());
}

TEST_F(JoinedControlTest, TellsWhoGivesWhatNobodyTakesAndKeepsNoRecordOfIt) {
  drones.refusal = base::Error{base::ErrorKind::invalid_input, "go_to needs a place"};
  EXPECT_EQ(all.command({.action = Action::go_to}, Ids{{"1"}}, "anna", false).error().message, "go_to needs a place");
  EXPECT_TRUE(all.commands().empty());
  EXPECT_TRUE(all.command({.action = Action::go_to}, Ids{{"1"}, {"a1"}}, "anna", false)) << "one platform takes it";
  EXPECT_EQ(last().outcomes[0].reason, "go_to needs a place");
  EXPECT_EQ(last().outcomes[1].state, CommandState::confirmed);
}

TEST_F(JoinedControlTest, StopsAllPlatformsAtOnceByOneLatch) {
  all.emergency_stop(StopAction::land, "anna");
  EXPECT_TRUE(drones.emergency().is_latched && robots.emergency().is_latched);
  EXPECT_TRUE(all.emergency().is_latched);
  EXPECT_EQ(all.emergency().action, StopAction::land);
  EXPECT_EQ(all.emergency().by, "anna");
  EXPECT_EQ(all.emergency().vehicles.size(), 5u) << "those with one id on two platforms, too";
  all.release_emergency_stop("ben");
  EXPECT_FALSE(all.emergency().is_latched);
  EXPECT_EQ(all.emergency().by, "anna") << "the last one is still shown";
  EXPECT_EQ(drones.said, std::vector<std::string>{"released by ben"});
  EXPECT_EQ(robots.said, drones.said);
}

TEST_F(JoinedControlTest, IsLatchedWhileAnyPlatformIs) {
  robots.emergency_stop(std::nullopt, "the robot's own button");
  EXPECT_TRUE(all.emergency().is_latched);
  EXPECT_EQ(all.emergency().by, "the robot's own button");
}

TEST_F(JoinedControlTest, AsksThePlatformOfTheVehicleForTheCommandOfIt) {
  EXPECT_TRUE(all.request_control({"a1"}, "anna"));
  EXPECT_TRUE(all.yield_control({"1"}, "ben"));
  EXPECT_TRUE(all.keep_control({"a1"}, "carla"));
  EXPECT_EQ(all.keep_control({"9"}, "carla").error().kind, base::ErrorKind::not_found);
  all.forget("anna");
  EXPECT_EQ(robots.said, (std::vector<std::string>{"request a1 by anna", "keep a1 by carla", "forget anna"}));
  EXPECT_EQ(drones.said, (std::vector<std::string>{"yield 1 by ben", "forget anna"}));
}

TEST(JoinedControl, OfOnePlatformIsThatPlatform) {
  RecordingControl drones{{"1"}, 5};
  JoinedControl all;
  all.add("MAVLink", drones);
  EXPECT_EQ(all.command({.action = Action::hold}, Ids{{"1"}, {"9"}}, "anna", false), 5u);
  EXPECT_EQ(&all.commands(), &drones.commands());
  EXPECT_EQ(all.revision(), drones.revision());
}

TEST(JoinedControl, KeepsADozenCommands) {
  RecordingControl drones{{"1"}, 1};
  RecordingControl robots{{"a1"}, 1};
  JoinedControl all;
  all.add("MAVLink", drones);
  all.add("test", robots);
  for (int i = 0; i < 30; ++i) (void)all.command({.action = Action::hold}, Ids{{"1"}}, "anna", false);
  EXPECT_EQ(all.commands().size(), 12u);
  EXPECT_EQ(all.commands().back().number, 30u);
}

}  // namespace
}  // namespace lapwing::vehicle
