#include "fleet/state/failsafe_reason.hpp"

#include <gtest/gtest.h>

namespace lapwing::fleet {
namespace {

using namespace std::chrono_literals;

base::TimePoint at(base::Duration time) {
  return base::TimePoint(time);
}

vehicle::VehicleState having_said(std::initializer_list<std::pair<base::Duration, std::string>> texts) {
  vehicle::VehicleState state;
  for (auto const& [time, text] : texts) state.recent_texts.push_back({.severity = 4, .text = text, .heard = at(time)});
  return state;
}

TEST(FailsafeText, TellsThatSomethingBegins) {
  for (auto const* text :
       {"Radio Failsafe", "GCS Failsafe - Continuing Auto Mode", "GCS Failsafe On: RTL", "Throttle failsafe on",
        "RC Short Failsafe: switched to CIRCLE", "Circle fence breached", "Fence Breached",
        "Failsafe activated: Fence breached", "Battery 1 is low 11.90V used 113 mAh",
        "Battery 2 is critical 10.10V used 3000 mAh", "EKF Failsafe: changed to LAND Mode"})
    EXPECT_TRUE(tells_failsafe(text)) << text;
}

TEST(FailsafeText, DoesNotTellThatOneIsOverOrOfSomethingElse) {
  for (auto const* text :
       {"GCS Failsafe Cleared", "RC Long Failsafe Cleared", "GCS Failsafe Off", "Throttle failsafe off",
        "Fence breach cleared", "Fence Indexed OK", "PreArm: Radio failsafe on", "Arm: Radio failsafe on",
        "Min Alt fence enabled (auto enable)", "Failsafe deactivated", "Mission: 2 WP"})
    EXPECT_FALSE(tells_failsafe(text)) << text;
}

TEST(RecentFailsafe, IsTheNewestThatBegan) {
  auto const state = having_said({{1s, "Radio Failsafe"}, {8s, "GCS Failsafe"}, {9s, "Radio Failsafe Cleared"}});
  EXPECT_EQ(recent_failsafe(state, at(10s)), "GCS Failsafe");
  EXPECT_EQ(recent_failsafe(state, at(20s)), "");
}

TEST(RecentFailsafe, IsToldByTheFenceWhereAVehicleHasNoWords) {
  auto state = having_said({{1s, "Fence Indexed OK"}});
  state.mission.fence.set({.is_breached = true, .breaches = 1, .type = "boundary"}, at(3s));
  EXPECT_EQ(recent_failsafe(state, at(4s)), "fence breached: boundary");
  EXPECT_EQ(recent_failsafe(state, at(30s)), "") << "too old to be the reason";
  state.mission.fence.set({.is_breached = false, .breaches = 1}, at(30s));
  EXPECT_EQ(recent_failsafe(state, at(31s)), "");
  EXPECT_EQ(recent_failsafe(state, at(31s), at(30s)), "fence breached") << "over already, and counted";
}

}  // namespace
}  // namespace lapwing::fleet
