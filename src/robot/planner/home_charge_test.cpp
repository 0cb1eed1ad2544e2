#include "robot/planner/home_charge.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace lapwing::robot {
namespace {

using namespace std::chrono_literals;

/// A robot that drives straight away from home, and tells its charge in whole percents.
struct Drive {
  HomeCharge home{0.3};
  double charge = 0.8;
  double per_s = 1.0 / 3600.0;
  double speed_m_s = 0.2;
  double away_m = 0.0;
  base::TimePoint now{};
  bool tells = true;

  void go(double seconds) { pass(seconds, speed_m_s, true); }
  void stand(double seconds) { pass(seconds, 0.0, false); }
  /// For as long as it may, at most.
  void go_on_until_due(double most_s) {
    for (double left_s = most_s; left_s > 0.0 && !home.is_due(); --left_s) go(1.0);
  }
  void pass(double seconds, double at_m_s, bool is_under_way) {
    for (auto const end = now + base::from_seconds(seconds); now < end; now += 100ms) {
      charge -= 0.1 * per_s;
      away_m += 0.1 * at_m_s;
      home.set_way(away_m);
      home.note({.at = now,
                 .charge = tells ? std::optional(std::floor(100.0 * charge) / 100.0) : std::nullopt,
                 .driven_m = away_m,
                 .is_under_way = is_under_way});
    }
  }
};

TEST(HomeCharge, IsDueWhenTheWayHomeTakesWhatIsLeftButAMargin) {
  Drive drive;
  drive.go_on_until_due(3600.0);
  ASSERT_TRUE(drive.home.is_due());
  double const home = drive.away_m / drive.speed_m_s * drive.per_s;
  EXPECT_GT(drive.charge, home + 0.03) << "it comes home, and has some left there";
  EXPECT_LT(drive.charge, home + 0.12) << "it does not give up more than it has to";
}

TEST(HomeCharge, IsDueTheLaterTheNearerItIsToHome) {
  Drive near;
  near.speed_m_s = 0.02;
  near.go_on_until_due(3600.0);
  ASSERT_TRUE(near.home.is_due());
  EXPECT_NEAR(near.charge, 0.2, 0.06);
  Drive far;
  far.speed_m_s = 0.3;
  far.go_on_until_due(3600.0);
  EXPECT_GT(far.charge, near.charge + 0.1);
}

TEST(HomeCharge, IsNeverDueBelowWhatCellsNeed) {
  Drive drive;
  drive.speed_m_s = 0.0;
  drive.go_on_until_due(3600.0);
  ASSERT_TRUE(drive.home.is_due());
  EXPECT_NEAR(drive.charge, 0.16, 0.011);
}

TEST(HomeCharge, IsDueAtAFifthWhereNobodyKnowsWhatDrivingDraws) {
  Drive drive;
  drive.charge = 0.195;
  drive.go(6.0);
  EXPECT_TRUE(drive.home.is_due());
}

TEST(HomeCharge, DoesNotTakeAMomentForTheBattery) {
  Drive drive;
  drive.go(600.0);
  drive.charge -= 0.6;
  drive.go(3.0);
  EXPECT_FALSE(drive.home.is_due());
  drive.charge += 0.6;
  drive.go(10.0);
  EXPECT_FALSE(drive.home.is_due());
}

TEST(HomeCharge, IsNotDueWithANewBattery) {
  Drive drive;
  drive.go_on_until_due(3600.0);
  ASSERT_TRUE(drive.home.is_due());
  drive.charge = 1.0;
  drive.stand(1.0);
  EXPECT_FALSE(drive.home.is_due());
}

TEST(HomeCharge, OfWhoDoesNotTellItsChargeIsNeverDue) {
  Drive drive;
  drive.tells = false;
  drive.go(3600.0);
  EXPECT_FALSE(drive.home.is_due());
}

}  // namespace
}  // namespace lapwing::robot
