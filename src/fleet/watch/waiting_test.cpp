#include <gtest/gtest.h>

#include "fleet/testing/world.hpp"

// Whoever waits learns what for.
namespace lapwing::fleet {
namespace {

using namespace std::chrono_literals;
using mavlink::MavCmd;
using tasks::RunState;

struct Waiting : ::testing::Test {
  std::unique_ptr<tasks::TaskRun> start() {
    return world.platform->start(task_of(mission_ending_with(MavCmd::nav_loiter_unlim)), vehicle::VehicleId{"1"});
  }
  [[nodiscard]] auto said(std::string_view part) const {
    return std::ranges::count_if(world.lines, [part](auto const& line) { return line.find(part) != line.npos; });
  }

  TestWorld world;
};

TEST_F(Waiting, TellsWhatAVehicleLacksThatIsNotReady) {
  world.add({.position_ok_after = 1h});
  world.run_for(5s);
  auto const run = start();
  world.run_for(2500ms);
  EXPECT_EQ(said("waiting until the vehicle is ready"), 0);
  world.run_for(1s);
  EXPECT_TRUE(world.has_logged("copter 1: 'survey': waiting until the vehicle is ready for 3 s: no GPS fix"));
  world.run_for(20s);
  EXPECT_EQ(said("waiting until the vehicle is ready"), 3);  // not a line a second
}

TEST_F(Waiting, TellsThatAVehicleTakesNoMoreItems) {
  world.add({.request_spacing = 1h});
  world.run_for(5s);
  auto const run = start();
  world.run_for(8s);
  EXPECT_TRUE(world.has_logged("uploading 0/6 for 3 s: it asks for no more items")) << world.lines.back();
  EXPECT_TRUE(world.run_until([&] { return run->state() == RunState::failed; }, 5min));
  EXPECT_NE(run->error().find("transfer cancelled by the vehicle"), std::string::npos) << run->error();
  EXPECT_EQ(run->error().find("holds 0"), std::string::npos) << run->error();
}

TEST_F(Waiting, TellsThatNothingIsHeard) {
  auto& copter = world.add({.request_spacing = 1s});
  world.run_for(5s);
  auto const run = start();
  ASSERT_TRUE(world.comes_to(*run, "uploading 1/"));
  copter.is_silent = true;
  world.run_for(5s);
  EXPECT_TRUE(world.has_logged("nothing heard from it for ")) << world.lines.back();
}

TEST_F(Waiting, TellsNothingWhileAllGoesOn) {
  world.add({.request_spacing = 1s});
  world.run_for(5s);
  auto const run = start();
  ASSERT_TRUE(world.comes_to(*run, "item 3/"));
  EXPECT_EQ(said("for 3 s"), 0);
}

TEST_F(Waiting, TellsThatAVehicleCannotBeStopped) {
  auto& copter = world.add();
  world.run_for(5s);
  auto const run = start();
  ASSERT_TRUE(world.comes_to(*run, "item 3/"));
  copter.is_silent = true;
  run->stop();
  world.run_for(4s);
  EXPECT_TRUE(
      world.has_logged("copter 1 has not stopped yet, asked again and again for 3 s: nothing heard from it for "))
      << world.lines.back();
  EXPECT_EQ(world.platform->unsettled(), std::vector<std::string>{"copter 1"});
  copter.is_silent = false;
  world.loop.run_until_done(world.platform->settle());
  EXPECT_TRUE(world.platform->unsettled().empty());
  auto const lines = world.lines.size();
  world.run_for(1min);
  EXPECT_EQ(world.lines.size(), lines);
}

}  // namespace
}  // namespace lapwing::fleet
