#include "vision/cars/car_answer.hpp"

#include <algorithm>
#include <cmath>

namespace lapwing::vision {

namespace {

constexpr int planes = 8;
constexpr int places = car_input / car_step;
/// Of the usual car, in pixels of the network.
constexpr double usual_length = 46.0;
constexpr double usual_width = 19.0;

/// No network says what is beyond these, and no car is: a quarter to four times the usual one.
double sized(double usual, double logarithm) {
  constexpr double most = 1.4;
  return usual * std::exp(std::clamp(logarithm, -most, most));
}

bool is_highest_near(cv::Mat const& logits, int row, int column) {
  auto const own = logits.at<float>(row, column);
  for (int y = std::max(0, row - 1); y <= std::min(places - 1, row + 1); ++y) {
    for (int x = std::max(0, column - 1); x <= std::min(places - 1, column + 1); ++x) {
      if (logits.at<float>(y, x) > own) return false;
    }
  }
  return true;
}

void check_shape(cv::Mat const& answer) {
  CV_Assert(answer.dims == 4 && answer.type() == CV_32F && answer.size[1] == planes && answer.size[2] == places &&
            answer.size[3] == places);
}

/// A view, which nobody writes to.
cv::Mat plane(cv::Mat const& answer, int which) {
  return {places, places, CV_32F,
          const_cast<float*>(answer.ptr<float>(0, which))};  // NOLINT(cppcoreguidelines-pro-type-const-cast)
}

}  // namespace

std::vector<SeenCar> cars_of_answer(cv::Mat const& answer, double least_score) {
  check_shape(answer);
  auto const logits = plane(answer, 0);
  double const least = std::log(least_score / (1.0 - least_score));
  std::vector<SeenCar> cars;
  for (int row = 0; row < places; ++row) {
    for (int column = 0; column < places; ++column) {
      double const logit = logits.at<float>(row, column);
      if (logit < least || !is_highest_near(logits, row, column)) continue;
      auto const said = [&](int which) { return double{answer.ptr<float>(0, which, row)[column]}; };
      cars.push_back({.box = {.middle = {(column + said(1)) * car_step, (row + said(2)) * car_step},
                              .length = sized(usual_length, said(3)),
                              .width = sized(usual_width, said(4)),
                              .heading_rad = 0.5 * std::atan2(said(6), said(5))},
                      .score = 1.0 / (1.0 + std::exp(-logit))});
    }
  }
  return each_once(std::move(cars));
}

cv::Mat covered_of_answer(cv::Mat const& answer) {
  check_shape(answer);
  return plane(answer, planes - 1);
}

void confirm(cv::Mat& answer, cv::Mat const& mirror) {
  check_shape(answer);
  check_shape(mirror);
  for (int const which : {0, planes - 1}) {
    cv::Mat own = plane(answer, which);
    cv::Mat back;
    constexpr int left_to_right = 1;
    cv::flip(plane(mirror, which), back, left_to_right);
    cv::addWeighted(own, 0.5, back, 0.5, 0.0, own);
  }
}

std::vector<SeenCar> each_once(std::vector<SeenCar> cars) {
  std::ranges::stable_sort(cars, std::ranges::greater(), &SeenCar::score);
  std::vector<SeenCar> kept;
  for (auto const& car : cars) {
    bool const is_told = std::ranges::any_of(kept, [&](SeenCar const& other) {
      return std::hypot(car.box.middle.x - other.box.middle.x, car.box.middle.y - other.box.middle.y) <=
             0.5 * other.box.width;
    });
    if (!is_told) kept.push_back(car);
  }
  return kept;
}

}  // namespace lapwing::vision
