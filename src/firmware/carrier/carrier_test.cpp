#include "firmware/carrier/carrier.hpp"

#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "firmware/testing/rig.hpp"

namespace lapwing::firmware {
namespace {

using namespace std::chrono_literals;
using testing::office_robot;
using testing::Rig;

float constexpr degree = std::numbers::pi_v<float> / 180;

Drive ahead(CommandNumber number, float speed_m_s, float heading_rad = 0) {
  return {.number = number, .speed_m_s = speed_m_s, .by = Drive::By::heading, .turn = heading_rad};
}

float turn_error(Rig const& rig, float heading_rad) {
  return std::abs(wrapped(rig.body.heading_rad() - heading_rad));
}

/// The largest error of the speed over a time, and of the heading.
struct Errors {
  float speed_m_s = 0;
  float heading_rad = 0;
};
Errors worst_over(Rig& rig, Time span, float speed_m_s, float heading_rad) {
  Errors worst;
  for (Time past{0}; past < span; past += Rig::step) {
    rig.run(Rig::step);
    worst.speed_m_s = std::max(worst.speed_m_s, std::abs(rig.body.speed_m_s() - speed_m_s));
    worst.heading_rad = std::max(worst.heading_rad, turn_error(rig, heading_rad));
  }
  return worst;
}

// ---- speed and heading ----

TEST(Carrier, KeepsEachSpeedToACentimetreASecondWithMotorsThatAreNotAsBelieved) {
  for (float const gain : {0.75F, 1.0F, 1.3F})
    for (float const speed : {0.05F, 0.12F, 0.16F, 0.24F, -0.12F}) {
      Rig rig;
      rig.body.faults.motor_gain = gain;
      rig.body.faults.left_motor = 0.9F;
      rig.run(100ms);
      rig.tell(ahead(1, speed));
      rig.run(4s);
      auto const worst = worst_over(rig, 3s, speed, 0);
      EXPECT_LT(worst.speed_m_s, 0.01F) << speed << " m/s, motors " << gain;
      EXPECT_LT(worst.heading_rad, degree) << speed << " m/s, motors " << gain;
      EXPECT_EQ(rig.completed(), std::vector<CommandNumber>{1});
    }
}

TEST(Carrier, DrivesNoFasterThanItsTopSpeed) {
  Rig rig;
  rig.run(100ms);
  rig.tell(ahead(1, 2.0F));
  rig.run(3s);
  EXPECT_LT(rig.body.speed_m_s(), 0.31F);
  EXPECT_EQ(rig.completed(), std::vector<CommandNumber>{1});
}

TEST(Carrier, TurnsOnTheSpotToADegreeAndDoesNotLeaveIt) {
  for (float const heading : {90.0F, -90.0F, 179.0F, -135.0F, 5.0F}) {
    Rig rig;
    rig.body.faults.left_motor = 0.9F;
    rig.run(100ms);
    rig.tell(Turn{.number = 4, .heading_rad = heading * degree});
    ASSERT_TRUE(rig.run_until([&] { return !rig.completed().empty(); }, 10s)) << heading;
    EXPECT_LT(turn_error(rig, heading * degree), degree) << heading;
    EXPECT_LT(std::hypot(rig.body.x_m(), rig.body.y_m()), 0.02F) << heading;
    rig.run(2s);
    EXPECT_LT(turn_error(rig, heading * degree), degree) << heading;
    EXPECT_EQ(rig.completed(), std::vector<CommandNumber>{4});
  }
}

TEST(Carrier, TakesTheShorterWayAcrossTheBack) {
  Rig rig;
  rig.run(100ms);
  rig.tell(Turn{.number = 1, .heading_rad = 170 * degree});
  ASSERT_TRUE(rig.run_until([&] { return rig.completed().size() == 1; }, 10s));
  rig.tell(Turn{.number = 2, .heading_rad = 190 * degree});
  ASSERT_TRUE(rig.run_until([&] { return rig.completed().size() == 2; }, 3s));
  EXPECT_NEAR(rig.body.heading_rad(), 190 * degree, degree);
}

TEST(Carrier, KeepsItsHeadingWithAWheelThatSlips) {
  Rig rig;
  rig.body.faults.left_slip = 0.15F;
  rig.run(100ms);
  rig.tell(ahead(1, 0.16F, 30 * degree));
  rig.run(5s);
  EXPECT_LT(worst_over(rig, 3s, 0.16F, 30 * degree).heading_rad, degree);
}

TEST(Carrier, TurnsFirstWhereTheHeadingIsFarAway) {
  Rig rig;
  rig.run(100ms);
  rig.tell(ahead(1, 0.16F, 90 * degree));
  rig.run(8s);
  EXPECT_LT(std::abs(rig.body.x_m()), 0.05F);
  EXPECT_GT(rig.body.y_m(), 0.5F);
}

TEST(Carrier, DrivesAnArcByItsRate) {
  Rig rig;
  rig.run(100ms);
  rig.tell(Drive{.number = 1, .speed_m_s = 0.1F, .by = Drive::By::rate, .turn = 0.3F});
  rig.run(2s);
  float const before = rig.body.heading_rad();
  rig.run(2s);
  EXPECT_NEAR(rig.body.heading_rad() - before, 0.6F, 0.05F);
  EXPECT_EQ(rig.completed(), std::vector<CommandNumber>{1});
}

TEST(Carrier, StopIsCompletedWhereItStands) {
  Rig rig;
  rig.run(100ms);
  rig.tell(ahead(1, 0.3F));
  rig.run(3s);
  rig.tell(Stop{.number = 2});
  ASSERT_TRUE(rig.run_until([&] { return rig.completed().size() == 2; }, 3s));
  EXPECT_EQ(rig.completed().back(), 2);
  rig.run(500ms);
  EXPECT_TRUE(rig.body.is_standing());
  EXPECT_EQ(rig.last().command, 0);
}

// ---- commands said again ----

TEST(Carrier, SaysCompletedAgainWhenItIsToldTheSameAgainAndStartsNothingAnew) {
  Rig rig;
  rig.run(100ms);
  rig.tell(ahead(7, 0.1F));
  rig.tell(ahead(7, 0.1F));
  rig.run(4s);
  EXPECT_EQ(rig.completed(), std::vector<CommandNumber>{7});
  rig.tell(ahead(7, 0.1F));
  rig.run(1s);
  EXPECT_EQ(rig.completed(), (std::vector<CommandNumber>{7, 7}));
}

TEST(Carrier, BeginsToCountAnewWithAnotherHost) {
  Rig rig;
  rig.run(100ms);
  rig.tell(ahead(1, 0.1F));
  rig.run(3s);
  rig.tell(Hail{});
  rig.run(2s);
  EXPECT_TRUE(rig.body.is_standing());
  rig.tell(ahead(1, 0.1F));
  rig.run(3s);
  EXPECT_EQ(rig.completed(), (std::vector<CommandNumber>{1, 1}));
}

// ---- kill ----

TEST(Carrier, AKillTakesTheVoltageAwayInTheStepInWhichItArrives) {
  Rig rig;
  rig.run(100ms);
  rig.tell(ahead(1, 0.3F));
  rig.run(2s);
  ASSERT_GT(rig.body.left_output(), 0.1F);
  rig.tell(Kill{});
  rig.run(Rig::step);
  EXPECT_EQ(rig.body.left_output(), 0.0F);
  EXPECT_EQ(rig.body.right_output(), 0.0F);
  EXPECT_TRUE(rig.last().has(Flag::killed));
  EXPECT_EQ(rig.last().time, rig.now());
  EXPECT_EQ(rig.last().left_output_permille, 0);
}

TEST(Carrier, StandsAfterAKillWhateverThePlannerSaysUntilItIsReleasedAndToldAgain) {
  Rig rig;
  rig.run(100ms);
  rig.tell(ahead(1, 0.3F));
  rig.run(2s);
  rig.tell(Kill{});
  rig.run(2s);
  float const x = rig.body.x_m();
  for (CommandNumber number = 2; number < 12; ++number) {
    rig.tell(ahead(number, 0.3F));
    rig.run(100ms);
  }
  EXPECT_EQ(rig.body.x_m(), x);
  EXPECT_EQ(rig.count(LogCode::refused), 10);
  rig.tell(Release{});
  rig.run(1s);
  EXPECT_EQ(rig.body.x_m(), x);
  EXPECT_FALSE(rig.last().has(Flag::killed));
  rig.tell(ahead(12, 0.3F));
  rig.run(1s);
  EXPECT_GT(rig.body.x_m(), x + 0.1F);
}

// ---- watchdog ----

TEST(Carrier, StopsByItselfHalfASecondAfterItsHostFellSilent) {
  Rig rig;
  rig.run(100ms);
  rig.tell(ahead(1, 0.3F));
  rig.run(2s);
  rig.is_host_alive = false;
  rig.run(480ms);
  EXPECT_NE(rig.last().command, 0);
  rig.run(1s);
  EXPECT_TRUE(rig.last().has(Flag::watchdog));
  EXPECT_EQ(rig.count(LogCode::watchdog), 1);
  EXPECT_LT(rig.body.speed_m_s(), 0.01F);
  float const x = rig.body.x_m();
  rig.is_host_alive = true;
  rig.run(2s);
  EXPECT_NEAR(rig.body.x_m(), x, 0.005F);
  rig.tell(ahead(2, 0.3F));
  rig.run(1s);
  EXPECT_GT(rig.body.x_m(), x + 0.1F);
  EXPECT_FALSE(rig.last().has(Flag::watchdog));
}

// ---- what breaks ----

TEST(Carrier, FindsADeadEncoderWhileItIsSteeredAllTheTime) {
  Rig rig;
  rig.body.faults.is_left_dead = true;
  rig.run(100ms);
  for (CommandNumber number = 1; number <= 8; ++number) {
    rig.tell(ahead(number, 0.16F));
    rig.run(100ms);
  }
  EXPECT_EQ(rig.count(LogCode::left_wheel_dead), 1);
}

TEST(Carrier, StopsWhenAnEncoderIsDead) {
  Rig rig;
  rig.body.faults.is_left_dead = true;
  rig.run(100ms);
  rig.tell(ahead(1, 0.16F));
  rig.run(1500ms);
  EXPECT_TRUE(rig.last().has(Flag::left_wheel_dead));
  EXPECT_FALSE(rig.last().has(Flag::right_wheel_dead));
  EXPECT_EQ(rig.count(LogCode::left_wheel_dead), 1);
  rig.run(1s);
  EXPECT_TRUE(rig.body.is_standing());
  EXPECT_LT(std::abs(rig.body.heading_rad()), 60 * degree);
  EXPECT_TRUE(rig.completed().empty());
}

TEST(Carrier, StopsWhenAWheelIsBlocked) {
  Rig rig;
  rig.body.faults.is_right_blocked = true;
  rig.run(100ms);
  rig.tell(ahead(1, 0.16F));
  rig.run(3s);
  EXPECT_TRUE(rig.last().has(Flag::right_wheel_dead));
  EXPECT_TRUE(rig.body.is_standing());
}

TEST(Carrier, DropsAHeadingThatItCannotFeelAndRefusesOthers) {
  Rig rig;
  rig.run(100ms);
  rig.tell(ahead(1, 0.16F));
  rig.run(2s);
  rig.body.faults.is_imu_silent = true;
  rig.run(2s);
  EXPECT_TRUE(rig.body.is_standing());
  EXPECT_TRUE(rig.last().has(Flag::imu_silent));
  EXPECT_FALSE(rig.last().imu);
  EXPECT_EQ(rig.count(LogCode::imu_silent), 1);
  rig.tell(Turn{.number = 2, .heading_rad = 1});
  rig.run(1s);
  EXPECT_EQ(rig.count(LogCode::refused), 1);
  rig.tell(Drive{.number = 3, .speed_m_s = 0.1F, .by = Drive::By::rate, .turn = 0});
  rig.run(2s);
  EXPECT_GT(rig.body.speed_m_s(), 0.08F);
}

TEST(Carrier, TellsThatAWheelSpins) {
  Rig rig;
  rig.run(100ms);
  rig.tell(Drive{.number = 1, .speed_m_s = 0.25F, .by = Drive::By::rate, .turn = 0});
  rig.run(2s);
  EXPECT_EQ(rig.count(LogCode::slipping), 0);
  rig.body.faults.left_slip = 0.8F;
  rig.run(1s);
  EXPECT_TRUE(rig.last().has(Flag::slipping));
  EXPECT_EQ(rig.count(LogCode::slipping), 1);
}

}  // namespace
}  // namespace lapwing::firmware
