#include "fleet/actions/operator_actions.hpp"

#include <gtest/gtest.h>

#include "fleet/testing/world.hpp"

namespace lapwing::fleet {
namespace {

using namespace std::chrono_literals;
using mavlink::MavCmd;

struct TakeOff : ::testing::Test {
  TakeOff() {
    world.run_for(10s);
    copter.refused_commands.insert(MavCmd::nav_takeoff);
  }
  base::Result<> ask() {
    auto& craft = *world.fleet->find(vehicle::VehicleId{"1"});
    vehicle::VehicleCommand const command{.action = vehicle::Action::take_off, .height_m = 20.0};
    return world.loop.run_until_done(carry_out(world.connection, craft, command, ActionOptions{}));
  }

  TestWorld world;
  TestAutopilot& copter = world.add();
};

TEST_F(TakeOff, IsRefusedWithoutWordsThatAreNotThere) {
  copter.send(mavlink::StatusText{.severity = mavlink::MavSeverity::critical, .text = "of before"});
  world.run_for(1s);
  auto const refused = ask();
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().message, "vehicle 1 answered NAV_TAKEOFF: failed");  // and nothing behind it
}

TEST_F(TakeOff, IsRefusedBecauseItFliesAlready) {
  copter.is_armed = copter.is_flying = true;
  copter.change_mode(copter_mode::guided);
  auto const refused = ask();  // before it has told that it flies
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().message, "copter 1 is in the air already");
}

}  // namespace
}  // namespace lapwing::fleet
