#include "vision/cars/car_answer.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace lapwing::vision {
namespace {

constexpr int places = car_input / car_step;

cv::Mat nothing() {
  int const shape[] = {1, 8, places, places};
  cv::Mat answer(4, shape, CV_32F, cv::Scalar(0.0));
  for (int row = 0; row < places; ++row) {
    for (int column = 0; column < places; ++column) answer.ptr<float>(0, 0, row)[column] = -8.0F;
  }
  return answer;
}

void say(cv::Mat& answer, int row, int column, float logit, double heading_rad) {
  float const values[] = {logit,
                          0.25F,
                          0.5F,
                          0.0F,
                          0.0F,
                          static_cast<float>(std::cos(2.0 * heading_rad)),
                          static_cast<float>(std::sin(2.0 * heading_rad)),
                          1.0F};
  for (int plane = 0; plane < 8; ++plane) answer.ptr<float>(0, plane, row)[column] = values[plane];
}

TEST(CarAnswer, APlaceTellsWhereAVehicleIsAndHowItLies) {
  auto answer = nothing();
  say(answer, 10, 20, 2.0F, std::numbers::pi / 3.0);
  auto const cars = cars_of_answer(answer, 0.5);
  ASSERT_EQ(cars.size(), 1U);
  EXPECT_NEAR(cars[0].box.middle.x, 81.0, 1e-6);
  EXPECT_NEAR(cars[0].box.middle.y, 42.0, 1e-6);
  EXPECT_NEAR(cars[0].box.length, 46.0, 1e-6);
  EXPECT_NEAR(cars[0].box.width, 19.0, 1e-6);
  EXPECT_NEAR(cars[0].box.heading_rad, std::numbers::pi / 3.0, 1e-6);
  EXPECT_NEAR(cars[0].score, 1.0 / (1.0 + std::exp(-2.0)), 1e-6);
  EXPECT_FLOAT_EQ(covered_of_answer(answer).at<float>(10, 20), 1.0F);
}

TEST(CarAnswer, NeighboursThatMeanOneVehicleAreOne) {
  auto answer = nothing();
  say(answer, 10, 20, 2.0F, 0.0);
  say(answer, 10, 21, 1.0F, 0.0);  // beside a higher place
  say(answer, 10, 22, 1.5F, 0.0);  // two places on: within half a width of a surer one
  say(answer, 10, 34, 1.0F, 0.0);  // the next car
  EXPECT_EQ(cars_of_answer(answer, 0.5).size(), 2U);
  EXPECT_EQ(cars_of_answer(answer, 0.8).size(), 1U);
}

TEST(CarAnswer, NoNumberOfTheNetworkMakesAVehicleOfNoSize) {
  auto answer = nothing();
  say(answer, 10, 20, 2.0F, 0.0);
  answer.ptr<float>(0, 3, 10)[20] = 900.0F;
  answer.ptr<float>(0, 4, 10)[20] = -900.0F;
  auto const cars = cars_of_answer(answer, 0.5);
  ASSERT_EQ(cars.size(), 1U);
  EXPECT_LT(cars[0].box.length, 200.0);
  EXPECT_GT(cars[0].box.width, 4.0);
}

TEST(CarAnswer, WhatTheMirrorImageDoesNotShowIsLessSure) {
  auto answer = nothing();
  auto mirror = nothing();
  say(answer, 10, 20, 3.0F, 0.0);
  say(answer, 40, 20, 3.0F, 0.0);
  say(mirror, 10, places - 1 - 20, 1.0F, 0.0);
  confirm(answer, mirror);
  auto const cars = cars_of_answer(answer, 0.5);
  ASSERT_EQ(cars.size(), 1U);
  EXPECT_NEAR(cars[0].box.middle.y, 42.0, 1e-6);
  EXPECT_NEAR(cars[0].score, 1.0 / (1.0 + std::exp(-2.0)), 1e-6);
  EXPECT_FLOAT_EQ(covered_of_answer(answer).at<float>(10, 20), 1.0F);
  EXPECT_FLOAT_EQ(covered_of_answer(answer).at<float>(40, 20), 0.5F);
}

TEST(CarAnswer, AnAnswerOfAnotherShapeIsRefused) {
  int const shape[] = {1, 5, 20, 20};
  EXPECT_THROW((void)cars_of_answer(cv::Mat(4, shape, CV_32F, cv::Scalar(0.0)), 0.5), cv::Exception);
}

}  // namespace
}  // namespace lapwing::vision
