#include "vision/doors/door_answer.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <gtest/gtest.h>

namespace lapwing::vision {
namespace {

constexpr int places = answer_input / answer_step;

/// Nothing anywhere.
cv::Mat nothing() {
  std::vector<int> const shape{1, 5, places, places};
  cv::Mat answer(shape, CV_32F, cv::Scalar(1.0));
  for (int row = 0; row < places; ++row) std::fill_n(answer.ptr<float>(0, 0, row), places, -12.0F);
  return answer;
}

/// A place says: a door from there by so many steps.
void say(cv::Mat& answer, int row, int column, std::array<float, 5> const& what) {
  for (int channel = 0; channel < 5; ++channel)
    answer.ptr<float>(0, channel, row)[column] = what[static_cast<std::size_t>(channel)];
}

TEST(DoorAnswer, PlacesThatMeanOneDoorAreOne) {
  auto answer = nothing();
  say(answer, 10, 10, {-0.1F, 2.5F, 5.5F, 2.5F, 5.5F});
  say(answer, 10, 11, {-0.3F, 3.5F, 5.5F, 1.5F, 5.5F});
  say(answer, 10, 16, {-0.2F, 2.0F, 4.0F, 2.0F, 4.0F});
  auto const doors = doors_of_answer(answer);
  ASSERT_GE(doors.size(), 2U);
  EXPECT_NEAR(doors[0].surety, -0.1, 1e-6);
  EXPECT_NEAR(doors[0].box.x, 64.0, 1e-3);
  EXPECT_NEAR(doors[0].box.y, 40.0, 1e-3);
  EXPECT_NEAR(doors[0].box.width, 40.0, 1e-3);
  EXPECT_NEAR(doors[0].box.height, 88.0, 1e-3);
  EXPECT_NEAR(doors[1].surety, -0.2, 1e-6);
}

TEST(DoorAnswer, NeighboursVoteOnTheEdgesByHowSureTheyAre) {
  auto answer = nothing();
  // Chances of 0.75 and 0.25.
  say(answer, 10, 10, {std::log(3.0F), 2.0F, 5.0F, 2.0F, 5.0F});
  say(answer, 11, 10, {-std::log(3.0F), 2.0F, 6.0F, 3.0F, 4.0F});
  auto const doors = doors_of_answer(answer);
  EXPECT_NEAR(doors.front().box.width, 0.75 * 32.0 + 0.25 * 40.0, 0.01);
}

TEST(DoorAnswer, AnAnswerOfAnotherShapeIsNotRead) {
  std::vector<int> const shape{1, 5, 16, 16};
  EXPECT_THROW((void)doors_of_answer(cv::Mat(shape, CV_32F, cv::Scalar(0.0))), cv::Exception);
}

TEST(DoorAnswer, AMirrorImageIsTurnedBack) {
  auto const doors = mirrored_back({{.box = {10.0, 20.0, 30.0, 60.0}}});
  EXPECT_EQ(doors.front().box, (Box{answer_input - 40.0, 20.0, 30.0, 60.0}));
}

TEST(DoorAnswer, WhatBothViewsHaveIsSurerThanWhatOneHas) {
  std::vector<AnsweredDoor> const picture{{.box = {10, 10, 40, 80}, .surety = -0.2},
                                          {.box = {150, 10, 40, 80}, .surety = -0.2}};
  std::vector<AnsweredDoor> const mirror{{.box = {14, 10, 40, 80}, .surety = -0.4},
                                         {.box = {80, 100, 20, 40}, .surety = -0.5}};
  auto const doors = agreed(picture, mirror);
  ASSERT_EQ(doors.size(), 3U);
  EXPECT_NEAR(doors[0].surety, -0.3, 1e-9);
  EXPECT_EQ(doors[0].box, (Box{12, 10, 40, 80}));
  EXPECT_NEAR(doors[1].surety, -1.2, 1e-9);
  EXPECT_NEAR(doors[2].surety, -1.5, 1e-9);
}

TEST(DoorAnswer, ChancesGrowWithSuretyAndStayChances) {
  EXPECT_LT(chance_of(-3.0), chance_of(-0.5));
  EXPECT_GT(chance_of(-20.0), 0.0);
  EXPECT_DOUBLE_EQ(chance_of(0.0), 0.5);
  EXPECT_LT(chance_of(20.0), 1.0);
}

}  // namespace
}  // namespace lapwing::vision
