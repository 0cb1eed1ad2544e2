#pragma once

#include <array>
#include <span>
#include <vector>

#include <opencv2/core.hpp>

#include "vision/cars/turned_box.hpp"
#include "vision/lot/markings.hpp"
#include "vision/lot/seen_ground.hpp"

namespace lapwing::vision {

/// A place to park. Corners in order round it, metres as those of PaintedLine.
struct SlotShape {
  std::array<cv::Point2d, 4> corners;
  double surety = 0.0;  ///< 0 to 1: how much of its sides is painted, or stands between what is

  [[nodiscard]] cv::Point2d middle() const { return 0.25 * (corners[0] + corners[1] + corners[2] + corners[3]); }
};

/// The slots between painted lines: lines side by side at a pitch are a row; where some of them are hidden, the pitch
/// and the cars that stand there complete it. `cars` in metres, too. What is hatched is no slot, and what does not lie
/// wholly on the ground that was seen is left out: paint that goes on beyond it does not say how deep slots are.
[[nodiscard]] std::vector<SlotShape> slots_between(std::span<PaintedLine const> lines, std::span<TurnedBox const> cars,
                                                   SeenGround const& seen);

}  // namespace lapwing::vision
