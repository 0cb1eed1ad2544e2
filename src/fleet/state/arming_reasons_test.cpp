#include "fleet/state/arming_reasons.hpp"

#include <gtest/gtest.h>

namespace lapwing::fleet {
namespace {

using namespace std::chrono_literals;
using base::TimePoint;

std::vector<std::string> words(std::vector<vehicle::StatusText> const& reasons) {
  std::vector<std::string> texts;
  for (auto const& reason : reasons) texts.push_back(reason.text);
  return texts;
}

TEST(ArmingReasons, AreTextsOfBothAutopilots) {
  std::vector<vehicle::StatusText> reasons;
  EXPECT_TRUE(note_arming_reason(reasons, {2, "PreArm: Compass not calibrated", TimePoint(1s)}));
  EXPECT_TRUE(note_arming_reason(reasons, {2, "Arm: Need Position Estimate", TimePoint(1s)}));
  EXPECT_TRUE(note_arming_reason(reasons, {4, "Preflight Fail: ekf2 missing data", TimePoint(1s)}));
  EXPECT_FALSE(note_arming_reason(reasons, {6, "Arming motors", TimePoint(1s)}));
  EXPECT_FALSE(note_arming_reason(reasons, {6, "", TimePoint(1s)}));
  EXPECT_EQ(words(reasons), (std::vector<std::string>{"PreArm: Compass not calibrated", "Arm: Need Position Estimate",
                                                      "Preflight Fail: ekf2 missing data"}));
}

TEST(ArmingReasons, AreKeptWhileTheyAreRepeated) {
  std::vector<vehicle::StatusText> reasons;
  for (auto time = 0s; time <= 300s; time += 30s) {
    note_arming_reason(reasons, {2, "PreArm: Gyros inconsistent", TimePoint(time)});
    EXPECT_FALSE(forget_old_arming_reasons(reasons, TimePoint(time)));
    EXPECT_EQ(reasons.size(), 1u);
  }
  EXPECT_FALSE(forget_old_arming_reasons(reasons, TimePoint(370s)));
  EXPECT_TRUE(forget_old_arming_reasons(reasons, TimePoint(376s)));
  EXPECT_TRUE(reasons.empty());
}

TEST(ArmingReasons, AreBounded) {
  std::vector<vehicle::StatusText> reasons;
  for (int i = 0; i < 100; ++i) note_arming_reason(reasons, {2, "PreArm: " + std::to_string(i), TimePoint(1s)});
  EXPECT_EQ(reasons.size(), 20u);
  EXPECT_EQ(reasons.back().text, "PreArm: 99");
}

}  // namespace
}  // namespace lapwing::fleet
