#include "fleet/state/status_text.hpp"

#include <gtest/gtest.h>

namespace lapwing::fleet {
namespace {

using namespace std::chrono_literals;

base::TimePoint at(base::Duration time) {
  return base::TimePoint(time);
}
std::string const fifty(50, 'a');

TEST(StatusTexts, GivesAShortTextAtOnce) {
  StatusTexts texts;
  auto const whole = texts.add({2, "Arm: Need Position Estimate"}, at(1s));
  ASSERT_EQ(whole.size(), 1u);
  EXPECT_EQ(whole[0].text, "Arm: Need Position Estimate");
  EXPECT_EQ(whole[0].severity, 2);
  EXPECT_EQ(whole[0].heard, at(1s));
}

TEST(StatusTexts, JoinsChunksThatArriveOutOfOrder) {
  StatusTexts texts;
  EXPECT_TRUE(texts.add({4, "end", 7, 1}, at(1s)).empty());
  auto const whole = texts.add({4, fifty, 7, 0}, at(1s));
  ASSERT_EQ(whole.size(), 1u);
  EXPECT_EQ(whole[0].text, fifty + "end");
}

TEST(StatusTexts, KeepsTextsOfDifferentIdsApart) {
  StatusTexts texts;
  EXPECT_TRUE(texts.add({4, fifty, 7, 0}, at(1s)).empty());
  EXPECT_TRUE(texts.add({4, fifty, 8, 0}, at(1s)).empty());
  auto const whole = texts.add({4, "eight", 8, 1}, at(1s));
  ASSERT_EQ(whole.size(), 1u);
  EXPECT_EQ(whole[0].text, fifty + "eight");
}

TEST(StatusTexts, EndsATextWhoseLengthFillsItsLastChunkByAnEmptyOne) {
  StatusTexts texts;
  EXPECT_TRUE(texts.add({4, fifty, 7, 0}, at(1s)).empty());
  auto const whole = texts.add({4, "", 7, 1}, at(1s));
  ASSERT_EQ(whole.size(), 1u);
  EXPECT_EQ(whole[0].text, fifty);
}

TEST(StatusTexts, GivesOutWhatItHasWhenAChunkWasLost) {
  StatusTexts texts;
  EXPECT_TRUE(texts.add({4, "end", 7, 1}, at(1s)).empty());
  EXPECT_TRUE(texts.overdue(at(2s)).empty());
  auto const torn = texts.overdue(at(3s));
  ASSERT_EQ(torn.size(), 1u);
  EXPECT_EQ(torn[0].text, "...end");
  EXPECT_TRUE(texts.overdue(at(9s)).empty());
}

TEST(StatusTexts, NumbersTheTextsOfEachComponentByItself) {
  StatusTexts texts;
  EXPECT_TRUE(texts.add({4, fifty, 7, 0, 1}, at(1s)).empty());
  EXPECT_TRUE(texts.add({6, fifty, 7, 0, 100}, at(1s)).empty());
  auto const camera = texts.add({6, "camera", 7, 1, 100}, at(1s));
  ASSERT_EQ(camera.size(), 1u);
  EXPECT_EQ(camera[0].text, fifty + "camera");
  EXPECT_EQ(camera[0].component, 100);
  auto const autopilot = texts.add({4, "autopilot", 7, 1, 1}, at(1s));
  ASSERT_EQ(autopilot.size(), 1u);
  EXPECT_EQ(autopilot[0].text, fifty + "autopilot");
  EXPECT_EQ(autopilot[0].component, 1);
}

TEST(StatusTexts, MakesNoSecondTextOfChunksThatArriveTwice) {
  StatusTexts texts;
  EXPECT_TRUE(texts.add({4, fifty, 7, 0}, at(1s)).empty());
  EXPECT_EQ(texts.add({4, "end", 7, 1}, at(1s)).size(), 1u);
  EXPECT_TRUE(texts.add({4, "end", 7, 1}, at(1s)).empty());
  EXPECT_TRUE(texts.overdue(at(9s)).empty());
  // The number is used again after a wrap.
  EXPECT_EQ(texts.add({4, "new", 7, 0}, at(10s)).size(), 1u);
}

TEST(StatusTexts, MarksALostMiddle) {
  StatusTexts texts;
  EXPECT_TRUE(texts.add({4, fifty, 7, 0}, at(1s)).empty());
  EXPECT_TRUE(texts.add({4, "end", 7, 2}, at(1s)).empty());
  auto const torn = texts.overdue(at(4s));
  ASSERT_EQ(torn.size(), 1u);
  EXPECT_EQ(torn[0].text, fifty + "...end");
}

}  // namespace
}  // namespace lapwing::fleet
