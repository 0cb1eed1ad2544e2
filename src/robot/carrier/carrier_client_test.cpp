#include "robot/carrier/carrier_client.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "base/async/loop.hpp"
#include "link/pipe_link.hpp"
#include "robot/carrier/testing/piped_board.hpp"

namespace lapwing::robot {
namespace {

using namespace std::chrono_literals;
using base::ErrorKind;
using firmware::Drive;
using firmware::Stop;
using firmware::Turn;

Drive ahead(float speed_m_s) {
  return {.number = 0, .speed_m_s = speed_m_s, .by = Drive::By::heading, .turn = 0};
}

/// A host and a board with a pipe between, in time that does not wait for the wall's.
struct CarrierClientTest : ::testing::Test {
  void start() {
    client.start({.here = [this](auto const&, bool anew) { said.push_back(anew ? "anew" : "here"); },
                  .away =
                      [this](auto const& why) {
                        said.push_back("away");
                        why_away = why;
                      },
                  .readings = [this](auto const&) { ++readings; },
                  .scan = [this](LaserRanges const& scan) { scans.push_back(scan); },
                  .log = [this](firmware::Log const& log) { logs.push_back(log.code); }});
  }
  base::Result<firmware::Description> find() {
    start();
    return loop.run_until_done(client.description(2s));
  }
  void wait(base::Duration time) {
    auto const sleep = [](base::Loop& on, base::Duration how_long) -> base::Task<> { co_await on.sleep(how_long); };
    loop.run_until_done(sleep(loop, time));
  }
  base::Result<> carry_out(Order order, base::Duration timeout = 10s) {
    return loop.run_until_done(client.carry_out(order, timeout));
  }
  /// How an order ended that was given, while `meanwhile` happened a second after.
  base::Result<> carry_out_while(Order order, std::function<void()> meanwhile) {
    std::optional<base::Result<>> ended;
    base::Scope scope(loop);
    auto const run = [](CarrierClient& on, Order what, std::optional<base::Result<>>& into) -> base::Task<> {
      into = co_await on.carry_out(what, 20s);
    };
    scope.spawn(run(client, order, ended));
    wait(1s);
    meanwhile();
    wait(4s);
    return ended.value_or(base::fail(ErrorKind::timed_out, "it has not ended"));
  }

  base::Loop loop{{.unpaced = true}};
  link::Pipe pipe = link::make_pipe(loop);
  testing::PipedBoard board{loop, *pipe.b};
  CarrierClient client{loop, *pipe.a};
  std::vector<std::string> said;
  std::string why_away;
  std::vector<firmware::LogCode> logs;
  std::vector<LaserRanges> scans;
  int readings = 0;
};

TEST_F(CarrierClientTest, LearnsWhatBodyThereIs) {
  auto const body = find();
  ASSERT_TRUE(body);
  EXPECT_EQ(body->sonar_count, 5);
  EXPECT_EQ(said, std::vector<std::string>{"here"});
  wait(2s);
  EXPECT_NEAR(readings, 20, 2);
}

TEST_F(CarrierClientTest, SaysWhereToLookWhenNobodyAnswers) {
  board.is_unplugged = true;
  auto const body = find();
  ASSERT_FALSE(body);
  EXPECT_EQ(body.error().kind, ErrorKind::timed_out);
  EXPECT_EQ(body.error().message, "no robot's board answers on pipe");
  EXPECT_EQ(body.error().hint, "pipe is silent: is the board supplied and its program running?");
  auto const order = carry_out(ahead(0.1F));
  ASSERT_FALSE(order);
  EXPECT_EQ(order.error().kind, ErrorKind::lost);
}

TEST_F(CarrierClientTest, DrivesTurnsAndStopsUntilEachIsCompleted) {
  ASSERT_TRUE(find());
  EXPECT_TRUE(carry_out(ahead(0.16F)));
  EXPECT_NEAR(board.body.speed_m_s(), 0.16F, 0.01F);
  EXPECT_TRUE(carry_out(Stop{}));
  EXPECT_NEAR(board.body.speed_m_s(), 0, 0.01F);
  EXPECT_TRUE(carry_out(Turn{.number = 0, .heading_rad = 1.5F}));
  EXPECT_NEAR(board.body.heading_rad(), 1.5F, 0.0175F);
}

TEST_F(CarrierClientTest, KeepsTheBoardsWatchdogQuietWhileItIsThereAndNoLonger) {
  ASSERT_TRUE(find());
  ASSERT_TRUE(carry_out(ahead(0.16F)));
  wait(10s);
  EXPECT_NEAR(board.body.speed_m_s(), 0.16F, 0.01F);
  board.lose_frames = 1'000'000;
  wait(2s);
  EXPECT_NEAR(board.body.speed_m_s(), 0, 0.01F);
  EXPECT_EQ(std::ranges::count(logs, firmware::LogCode::watchdog), 1);
}

TEST_F(CarrierClientTest, SaysACommandAgainThatWasLostOnTheLine) {
  ASSERT_TRUE(find());
  board.lose_frames = 2;
  EXPECT_TRUE(carry_out(ahead(0.16F)));
  EXPECT_GE(client.status().repeats, 1U);
}

TEST_F(CarrierClientTest, GivesUpACommandThatNeverArrives) {
  ASSERT_TRUE(find());
  board.lose_frames = 1'000'000;
  auto const order = carry_out(ahead(0.16F));
  ASSERT_FALSE(order);
  EXPECT_EQ(order.error().kind, ErrorKind::timed_out);
  EXPECT_EQ(order.error().message, "the robot did not take the command, said 9 times");
}

TEST_F(CarrierClientTest, TellsWhoWaitsThatAnotherCommandCame) {
  ASSERT_TRUE(find());
  auto const order = carry_out_while(Turn{.number = 0, .heading_rad = 3}, [&] { EXPECT_TRUE(client.begin(Stop{})); });
  ASSERT_FALSE(order);
  EXPECT_EQ(order.error().kind, ErrorKind::cancelled);
  EXPECT_EQ(order.error().message, "another command took its place");
}

TEST_F(CarrierClientTest, AKillEndsWhatRunsAndRefusesWhatComesUntilItIsReleased) {
  ASSERT_TRUE(find());
  auto const order = carry_out_while(Turn{.number = 0, .heading_rad = 3}, [&] { client.kill(); });
  ASSERT_FALSE(order);
  EXPECT_EQ(order.error().message, "the robot was killed");
  auto const status = client.status();
  EXPECT_TRUE(status.is_killed);
  ASSERT_TRUE(status.kill_took);
  EXPECT_LE(*status.kill_took, 30ms);
  EXPECT_TRUE(board.body.is_standing());
  EXPECT_EQ(carry_out(ahead(0.1F)).error().kind, ErrorKind::refused);
  client.release();
  wait(500ms);
  EXPECT_FALSE(client.status().is_killed);
  EXPECT_TRUE(board.body.is_standing());
  EXPECT_TRUE(carry_out(ahead(0.1F)));
}

TEST_F(CarrierClientTest, AKillThatWasLostIsSaidAgainUntilItIsSeen) {
  ASSERT_TRUE(find());
  ASSERT_TRUE(carry_out(ahead(0.3F)));
  board.lose_frames = 5;
  client.kill();
  wait(300ms);
  EXPECT_TRUE(client.status().is_killed);
  EXPECT_EQ(board.body.left_output(), 0.0F);
}

TEST_F(CarrierClientTest, AKillHoldsOverAnOutageAndOverALossOfSupply) {
  ASSERT_TRUE(find());
  ASSERT_TRUE(carry_out(ahead(0.16F)));
  board.is_unplugged = true;
  client.kill();
  wait(3s);
  EXPECT_FALSE(client.status().is_here);
  board.is_unplugged = false;
  wait(1s);
  EXPECT_TRUE(client.status().is_killed);
  board.start_anew();
  wait(1s);
  EXPECT_TRUE(client.status().is_killed);
  EXPECT_TRUE(board.program().carrier().is_killed());
}

TEST_F(CarrierClientTest, ComesBackWhenThePlugIsInAgain) {
  ASSERT_TRUE(find());
  auto const order = carry_out_while(ahead(0.0F), [&] {});
  EXPECT_TRUE(order);
  board.is_unplugged = true;
  wait(2s);
  EXPECT_EQ(said, (std::vector<std::string>{"here", "away"}));
  EXPECT_NE(why_away, "");
  board.is_unplugged = false;
  wait(2s);
  EXPECT_EQ(said, (std::vector<std::string>{"here", "away", "here"}));
  EXPECT_TRUE(carry_out(ahead(0.16F)));
}

TEST_F(CarrierClientTest, TellsWhoWaitsThatTheBoardIsAway) {
  ASSERT_TRUE(find());
  auto const order = carry_out_while(Turn{.number = 0, .heading_rad = 3}, [&] { board.is_unplugged = true; });
  ASSERT_FALSE(order);
  EXPECT_EQ(order.error().kind, ErrorKind::lost);
  wait(2s);
  EXPECT_TRUE(board.body.is_standing());
}

TEST_F(CarrierClientTest, TellsThatTheBoardStartedAnew) {
  ASSERT_TRUE(find());
  wait(3s);
  auto const order = carry_out_while(Turn{.number = 0, .heading_rad = 3}, [&] { board.start_anew(); });
  ASSERT_FALSE(order);
  EXPECT_EQ(order.error().kind, ErrorKind::lost);
  EXPECT_EQ(said, (std::vector<std::string>{"here", "anew"}));
  EXPECT_TRUE(carry_out(ahead(0.1F)));
}

TEST_F(CarrierClientTest, SaysWhichWheelIsDead) {
  ASSERT_TRUE(find());
  board.body.faults.is_left_dead = true;
  auto const order = carry_out(ahead(0.16F));
  ASSERT_FALSE(order);
  EXPECT_EQ(order.error().kind, ErrorKind::refused);
  EXPECT_EQ(order.error().message, "the robot stopped: its left wheel is driven and gives no pulses");
}

TEST_F(CarrierClientTest, SaysWhatStandsInTheWayOfAnOrder) {
  ASSERT_TRUE(find());
  board.body.wall_x_m = 0.25F;
  auto const order = carry_out(ahead(0.3F), 4s);
  ASSERT_FALSE(order);
  EXPECT_EQ(order.error().kind, ErrorKind::timed_out);
  EXPECT_EQ(order.error().hint, "something stands in its way");
}

TEST(ScanAssembly, PutsPiecesTogetherAndGivesNoScanWithAHole) {
  auto const piece = [](int time, int begin, int count) {
    return firmware::LaserPiece{.time = firmware::Time(time),
                                .first_angle_rad = -1,
                                .step_rad = 0.01F,
                                .beams = 150,
                                .begin = static_cast<std::uint16_t>(begin),
                                .count = static_cast<std::uint8_t>(count),
                                .ranges_mm = {1'500}};
  };
  ScanAssembly assembly;
  EXPECT_FALSE(assembly.feed(piece(1, 0, 100)));
  auto const scan = assembly.feed(piece(1, 100, 50));
  ASSERT_TRUE(scan);
  EXPECT_EQ(scan->ranges_m.size(), 150U);
  EXPECT_DOUBLE_EQ(scan->ranges_m[100], 1.5);
  EXPECT_FALSE(assembly.feed(piece(2, 100, 50)));
  EXPECT_FALSE(assembly.feed(piece(3, 0, 100)));
  EXPECT_FALSE(assembly.feed(piece(4, 100, 50)));
  EXPECT_EQ(assembly.lost(), 1U);
  EXPECT_FALSE(assembly.feed(piece(5, 0, 100)));
  EXPECT_TRUE(assembly.feed(piece(5, 100, 50)));
}

}  // namespace
}  // namespace lapwing::robot
