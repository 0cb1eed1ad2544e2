#include "robot/watch/carrier_guard.hpp"

#include <optional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "base/async/loop.hpp"
#include "link/pipe_link.hpp"
#include "robot/carrier/testing/piped_board.hpp"

namespace lapwing::robot {
namespace {

using namespace std::chrono_literals;
using firmware::Drive;

Drive ahead(float speed_m_s) {
  return {.number = 0, .speed_m_s = speed_m_s, .by = Drive::By::heading, .turn = 0};
}

/// A robot whose modules all report, until one is told not to.
struct CarrierGuardTest : ::testing::Test {
  CarrierGuardTest() {
    client.start({});
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

  base::Loop loop{{.unpaced = true}};
  link::Pipe pipe = link::make_pipe(loop);
  testing::PipedBoard board{loop, *pipe.b};
  CarrierClient client{loop, *pipe.a};
  ModuleWatch watch;
  std::vector<std::string> said;
  CarrierGuard guard{loop,
                     client,
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
    ASSERT_TRUE(guard.begin(ahead(0.3F)));
    wait(3s);
    ASSERT_GT(board.body.speed_m_s(), 0.28F);
    said.clear();
    hung = module;
    wait(340ms);  // the period, and a look
    EXPECT_EQ(said.size(), 1U) << name_of(module).name;
    wait(1500ms);
    EXPECT_TRUE(board.body.is_standing()) << name_of(module).name;
    ASSERT_EQ(said.size(), 1U);
    EXPECT_NE(said[0].find(name_of(module).short_name), std::string::npos) << said[0];
    auto const refused = guard.begin(ahead(0.3F));
    ASSERT_FALSE(refused);
    EXPECT_NE(refused.error().message.find(name_of(module).short_name), std::string::npos);
  }
}

TEST_F(CarrierGuardTest, TellsWhoWaitsForAnOrderWhichModuleEndedIt) {
  std::optional<base::Result<>> ended;
  auto const run = [](CarrierGuard& on, std::optional<base::Result<>>& into) -> base::Task<> {
    into = co_await on.carry_out(firmware::Turn{.number = 0, .heading_rad = 3}, 20s);
  };
  scope.spawn(run(guard, ended));
  wait(500ms);
  sick = Module::mapping;
  code = 302;
  wait(2s);
  ASSERT_TRUE(ended);
  ASSERT_FALSE(*ended);
  EXPECT_EQ(
      ended->error().message,
      "the robot stays where it is: mapping (MMU) reports error 302: The place on the map is not known any more.");
  EXPECT_TRUE(board.body.is_standing());
}

TEST_F(CarrierGuardTest, GoesOnByItselfAfterASilenceAndByAnOperatorAfterAKill) {
  hung = Module::mapping;
  wait(1s);
  EXPECT_FALSE(guard.begin(ahead(0.1F)));
  hung.reset();
  wait(500ms);
  EXPECT_TRUE(guard.begin(ahead(0.1F)));
  wait(2s);
  guard.kill();
  wait(1s);
  EXPECT_TRUE(board.body.is_standing());
  EXPECT_FALSE(guard.begin(ahead(0.1F)));
  hung = Module::planner;
  wait(1s);
  EXPECT_FALSE(guard.restart());
  EXPECT_TRUE(board.program().carrier().is_killed());
  hung.reset();
  wait(500ms);
  EXPECT_TRUE(guard.restart());
  wait(500ms);
  EXPECT_TRUE(guard.begin(ahead(0.1F)));
  wait(2s);
  EXPECT_GT(board.body.speed_m_s(), 0.08F);
}

}  // namespace
}  // namespace lapwing::robot
