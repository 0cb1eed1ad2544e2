// The guard over a board that runs the firmware's program, at the far end of a line.
#include "robot/platform/carrier_guard.hpp"

#include <optional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "base/async/loop.hpp"
#include "link/pipe_link.hpp"
#include "robot/carrier/testing/piped_board.hpp"
#include "robot/platform/linked_body.hpp"
#include "robot/watch/codes.hpp"

namespace lapwing::robot {
namespace {

using namespace std::chrono_literals;

constexpr Motion ahead{.speed_m_s = 0.3, .turn_rad_s = 0.0};

/// A robot whose modules all report, until one is told not to.
struct CarrierGuardTest : ::testing::Test {
  CarrierGuardTest() {
    scope.spawn(report());
    wait(1s);
  }
  base::Task<> report() {
    for (;;) {
      for (auto const module : WatchSettings{}.required)
        if (module != hung)
          watch.report(module, {.state = ModuleState::ready, .error_code = module == sick ? code : std::uint16_t{0}},
                       loop.now());
      co_await loop.sleep(100ms);
    }
  }
  void wait(base::Duration time) {
    auto const sleep = [](base::Loop& on, base::Duration how_long) -> base::Task<> { co_await on.sleep(how_long); };
    loop.run_until_done(sleep(loop, time));
  }
  void drives() {
    ASSERT_EQ(guard.drive(ahead), ahead);
    wait(3s);
    ASSERT_GT(board.body.speed_m_s(), 0.28F);
    said.clear();
  }

  base::LogHub hub;
  base::Loop loop{{.unpaced = true}};
  link::Pipe pipe = link::make_pipe(loop);
  testing::PipedBoard board{loop, *pipe.b};
  LinkedBody body{loop, std::move(pipe.a), base::Logger(hub, "test")};
  ModuleWatch watch;
  std::vector<std::string> said;
  CarrierGuard guard{loop,
                     body,
                     watch,
                     {.stopped = [this](Clearance const& why) { said.push_back(why.reason); },
                      .free = [this] { said.emplace_back("free"); }}};
  std::optional<Module> hung;
  std::optional<Module> sick;
  std::uint16_t code = 0;
  base::Scope scope{loop};
};

TEST_F(CarrierGuardTest, StopsTheRobotWithinTheWatchPeriodWhicheverModuleHangs) {
  for (auto const module : WatchSettings{}.required) {
    hung.reset();
    wait(1s);
    drives();
    hung = module;
    wait(340ms);  // the period, and a look
    EXPECT_EQ(said.size(), 1U) << name_of(module).name;
    wait(1500ms);
    EXPECT_TRUE(board.body.is_standing()) << name_of(module).name;
    ASSERT_EQ(said.size(), 1U);
    EXPECT_NE(said[0].find(name_of(module).short_name), std::string::npos) << said[0];
    EXPECT_EQ(guard.drive(ahead), Motion{});
    wait(1s);
    EXPECT_TRUE(board.body.is_standing()) << name_of(module).name;
  }
}

TEST_F(CarrierGuardTest, StopsTheRobotAtOnceWhicheverModuleReportsACriticalErrorAndForAWhile) {
  code = code::pose_lost;
  for (auto const module : WatchSettings{}.required) {
    wait(3s);
    drives();
    sick = module;
    wait(120ms);  // until its next report, and a look
    ASSERT_EQ(said.size(), 1U) << name_of(module).name;
    EXPECT_NE(said[0].find(name_of(module).short_name), std::string::npos) << said[0];
    wait(1500ms);
    EXPECT_TRUE(board.body.is_standing()) << name_of(module).name;
    sick.reset();
    wait(1500ms);
    EXPECT_EQ(guard.drive(ahead), Motion{}) << "it was not well a moment ago";
  }
}

TEST_F(CarrierGuardTest, GoesOnByItselfAfterASilenceAndByAnOperatorAfterAKill) {
  hung = Module::mapping;
  wait(1s);
  EXPECT_EQ(guard.drive(ahead), Motion{});
  hung.reset();
  wait(500ms);
  EXPECT_EQ(guard.drive(ahead), ahead);
  wait(2s);
  guard.kill();
  wait(1s);
  EXPECT_TRUE(board.body.is_standing());
  EXPECT_EQ(guard.drive(ahead), Motion{});
  hung = Module::planner;
  wait(1s);
  EXPECT_FALSE(guard.restart());
  EXPECT_TRUE(board.program().carrier().is_killed());
  hung.reset();
  wait(500ms);
  EXPECT_TRUE(guard.restart());
  wait(500ms);
  EXPECT_EQ(guard.drive(ahead), ahead);
  wait(2s);
  EXPECT_GT(board.body.speed_m_s(), 0.08F);
}

TEST_F(CarrierGuardTest, ABoardThatIsUnpluggedStopsByItselfAndSaysSoWhenItIsBack) {
  drives();
  EXPECT_EQ(body.take_carrier_code(), code::none);
  board.is_unplugged = true;
  wait(300ms);
  EXPECT_EQ(body.take_carrier_code(), std::nullopt) << "nothing new is heard of it";
  wait(1500ms);
  EXPECT_TRUE(board.body.is_standing()) << "its own watchdog";
  EXPECT_EQ(body.take_carrier_code(), code::board_away);
  board.is_unplugged = false;
  wait(1s);
  EXPECT_EQ(body.take_carrier_code(), code::board_watchdog);
  EXPECT_EQ(guard.drive(ahead), ahead);
  wait(2s);
  EXPECT_GT(board.body.speed_m_s(), 0.28F);
  EXPECT_EQ(body.take_carrier_code(), code::none);
}

}  // namespace
}  // namespace lapwing::robot
