#include "robot/platform/linked_body.hpp"

#include <gtest/gtest.h>

#include "base/async/loop.hpp"
#include "link/pipe_link.hpp"
#include "robot/carrier/testing/piped_board.hpp"

namespace lapwing::robot {
namespace {

using namespace std::chrono_literals;

/// A board that describes its body so, as the host knows it after a second.
struct Described {
  explicit Described(firmware::Description const& description) : board(loop, *pipe.b, description) {
    auto const wait = [](base::Loop& on) -> base::Task<> { co_await on.sleep(1s); };
    loop.run_until_done(wait(loop));
  }
  base::LogHub hub;
  base::Loop loop{{.unpaced = true}};
  link::Pipe pipe = link::make_pipe(loop);
  testing::PipedBoard board;
  LinkedBody body{loop, std::move(pipe.a), base::Logger(hub, "test")};
};

TEST(LinkedBody, IsAsLargeAsTheHullThatItsBoardDescribes) {
  auto description = firmware::testing::office_robot();
  description.hull = {.front_m = 0.2F, .back_m = 0.31F, .half_width_m = 0.25F};
  Described const described(description);
  ASSERT_NE(described.body.sensor(), nullptr);
  EXPECT_NEAR(described.body.limits().radius_m, 0.31, 1e-6);
}

TEST(LinkedBody, DrivesNoFasterAndBrakesNoHarderThanItsBoardCan) {
  auto description = firmware::testing::office_robot();
  description.top_speed_m_s = 0.12F;
  description.braking_m_s2 = 0.2F;
  auto const slow = Described(description).body.limits();
  EXPECT_NEAR(slow.speed_m_s, 0.12, 1e-6);
  EXPECT_NEAR(slow.near_speed_m_s, 0.12, 1e-6);
  EXPECT_NEAR(slow.acceleration_m_s2, 0.2, 1e-6);
  description.top_speed_m_s = 2.0F;
  description.braking_m_s2 = 5.0F;
  auto const fast = Described(description).body.limits();
  EXPECT_EQ(fast.speed_m_s, Limits{}.speed_m_s) << "the planner's own";
  EXPECT_EQ(fast.acceleration_m_s2, Limits{}.acceleration_m_s2);
}

TEST(LinkedBody, IsAsMostAreWhereItsBoardDoesNotSay) {
  auto description = firmware::testing::office_robot();
  description.hull = {};
  description.top_speed_m_s = 0.0F;
  description.braking_m_s2 = 0.0F;
  Described const described(description);
  ASSERT_NE(described.body.sensor(), nullptr);
  EXPECT_EQ(described.body.limits().radius_m, Limits{}.radius_m);
  EXPECT_EQ(described.body.limits().speed_m_s, Limits{}.speed_m_s);
}

TEST(LinkedBody, OfSomethingTooLargeForABuildingIsNeverMappedBy) {
  auto description = firmware::testing::office_robot();
  description.hull.front_m = 1.2F;
  EXPECT_EQ(Described(description).body.sensor(), nullptr);
}

}  // namespace
}  // namespace lapwing::robot
