#pragma once

#include <vector>

#include <opencv2/core.hpp>

#include "vision/cars/turned_box.hpp"

namespace lapwing::vision {

/// Pixels a side of what the network sees, and of the part of it that each place of its answer speaks for; metres a
/// pixel. As training/cars/network.py has them.
inline constexpr int car_input = 512;
inline constexpr int car_step = 4;
inline constexpr double car_metres = 0.1;

/// A vehicle from above.
struct SeenCar {
  TurnedBox box;
  double score = 0.0;  ///< the chance that it is one
};

/// What the network's answer says: 1 x 8 x 128 x 128, each place the logit of the chance that a vehicle's middle is
/// there, the way from the place to it in steps, logarithms of its length and width beside a usual car's, cosine and
/// sine of twice its heading, and the chance that a vehicle is seen there. Pixels are those of the network.
[[nodiscard]] std::vector<SeenCar> cars_of_answer(cv::Mat const& answer, double least_score);
/// The last plane of it: a view, as long as the answer lives.
[[nodiscard]] cv::Mat covered_of_answer(cv::Mat const& answer);

/// `mirror`: the answer to the mirror image of the same square. Both chances become the mean of what the two say: what
/// one of them alone shows is less sure.
void confirm(cv::Mat& answer, cv::Mat const& mirror);

/// Each vehicle once, the surest first: what lies within half a width of a surer one is that one.
[[nodiscard]] std::vector<SeenCar> each_once(std::vector<SeenCar> cars);

}  // namespace lapwing::vision
