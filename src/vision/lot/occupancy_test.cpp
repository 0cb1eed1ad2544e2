#include "vision/lot/occupancy.hpp"

#include <gtest/gtest.h>

namespace lapwing::vision {
namespace {

std::array<cv::Point2d, 4> const slot{{{100.0, 100.0}, {126.0, 100.0}, {126.0, 150.0}, {100.0, 150.0}}};
cv::Size const picture(640, 480);

Overhead empty_ground() {
  return {.cars = {}, .covered = cv::Mat::zeros(120, 160, CV_32F), .covered_scale = 0.25};
}

SeenCar car(double x, double y, double score) {
  return {.box = {.middle = {x, y}, .length = 46.0, .width = 19.0, .heading_rad = 1.57}, .score = score};
}

TEST(Occupancy, AVehicleInTheSlotTakesItAndOneBesideItDoesNot) {
  auto taken = empty_ground();
  taken.covered(cv::Rect(25, 25, 7, 13)).setTo(1.0);
  taken.cars = {car(113.0, 125.0, 0.95)};
  EXPECT_GT(occupied_chance(slot, taken, picture).value(), 0.9);
  auto beside = empty_ground();
  beside.covered(cv::Rect(33, 25, 5, 13)).setTo(1.0);
  beside.cars = {car(140.0, 125.0, 0.95)};
  EXPECT_LT(occupied_chance(slot, beside, picture).value(), 0.1);
  EXPECT_LT(occupied_chance(slot, empty_ground(), picture).value(), 0.1);
}

TEST(Occupancy, HalfOfTheEvidenceIsNeitherSureNorNothing) {
  auto covered = empty_ground();
  covered.covered(cv::Rect(25, 25, 7, 6)).setTo(1.0);
  auto const chance = occupied_chance(slot, covered, picture).value();
  EXPECT_GT(chance, 0.03);
  EXPECT_LT(chance, 0.97);
}

TEST(Occupancy, OfWhatIsBeyondThePictureNothingIsTold) {
  EXPECT_FALSE(occupied_chance(slot, empty_ground(), {110, 480}));
  EXPECT_TRUE(occupied_chance(slot, empty_ground(), {124, 480}));
}

TEST(Occupancy, WithoutANetworkFoundVehiclesTell) {
  EXPECT_GT(occupied_chance(slot, {.cars = {car(113.0, 125.0, 0.7)}, .covered = {}}, picture).value(), 0.5);
  EXPECT_LT(occupied_chance(slot, Overhead(), picture).value(), 0.5);
}

}  // namespace
}  // namespace lapwing::vision
