#include "robot/old_parts/order.hpp"

#include <string>

#include <gtest/gtest.h>

namespace lapwing::robot {
namespace {

Order order(std::string_view line) {
  return std::get<Order>(heard_in(line).value());
}

TEST(OldPartOrder, AKillIsTakenFromWhoeverSaysItInBothSpellings) {
  EXPECT_EQ(order("CC_CAR_1500_Kill"), Order::kill);
  EXPECT_EQ(order("CM_CAR_0_e-Stop"), Order::kill);
  EXPECT_EQ(order("PLN_CAR_7_Kill"), Order::kill);
}

TEST(OldPartOrder, ACommandCentreStopsThePlannerAndHasItGoOn) {
  EXPECT_EQ(order("CC_PLN_1500_STOP"), Order::stand);
  EXPECT_EQ(order("CC_PLN_1500_CONTINUE"), Order::go_on);
}

TEST(OldPartOrder, PartsOfTheOperatorAndPointsOfInterestSayHowTheyAre) {
  for (auto const* const line : {"CC_CM_5_ready:801:4096", "VSL_CC_5_ready:801:4096", "POI_CM_5_ready:801:4096"}) {
    auto const report = std::get<OldPartReport>(heard_in(line).value());
    EXPECT_EQ(name_of(report.module).short_name, std::string_view(line).substr(0, std::string_view(line).find('_')));
    EXPECT_EQ(report.report.state, ModuleState::ready);
    EXPECT_EQ(report.report.error_code, 801);
    EXPECT_EQ(report.report.memory_bytes, 4096U);
  }
}

TEST(OldPartOrder, NobodySpeaksForThePartsThatTheRobotHasItselfOrDrivesItByHand) {
  auto const why = [](std::string_view line) { return heard_in(line).error().message; };
  EXPECT_EQ(why("CAR_CC_5_ready:0:0"), "the robot takes nothing of that kind from CAR to CC");
  EXPECT_EQ(why("PLN_CAR_5_Medium"), "the robot takes nothing of that kind from PLN to CAR");
  EXPECT_EQ(why("MMU_PLN_5_1:2:3"), "the robot takes nothing of that kind from MMU to PLN");
  EXPECT_EQ(why("POI_PLN_5_STOP"), "the robot takes nothing of that kind from POI to PLN");
  EXPECT_EQ(why("CC_PLN_5_REVERSE"), "the robot takes nothing of that kind from CC to PLN");
  EXPECT_EQ(why("CC_PLN_5_fly"), "CC says nothing of that kind to PLN");
  EXPECT_EQ(why("hello"), "not Sender_Receiver_TimeStamp_Message: three _ are needed");
}

}  // namespace
}  // namespace lapwing::robot
