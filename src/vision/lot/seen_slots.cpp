#include "vision/lot/seen_slots.hpp"

#include "vision/lot/layout.hpp"
#include "vision/lot/markings.hpp"

namespace lapwing::vision {

namespace {

/// Cars that are less sure say nothing of where slots are.
constexpr double least_score = 0.5;

TurnedBox scaled(TurnedBox const& box, double scale) {
  return {.middle = {box.middle.x * scale, box.middle.y * scale},
          .length = box.length * scale,
          .width = box.width * scale,
          .heading_rad = box.heading_rad};
}

}  // namespace

std::vector<SeenSlot> slots_seen(cv::Mat const& pixels, std::span<SeenCar const> cars, double metres_a_pixel,
                                 SeenGround const& seen) {
  std::vector<TurnedBox> boxes;
  for (auto const& car : cars)
    if (car.score >= least_score) boxes.push_back(scaled(car.box, metres_a_pixel));
  std::vector<SeenSlot> slots;
  for (auto const& slot : slots_between(painted_lines(pixels, metres_a_pixel), boxes, seen)) {
    auto& told = slots.emplace_back(SeenSlot{.corners = slot.corners, .surety = slot.surety});
    for (auto& corner : told.corners) corner *= 1.0 / metres_a_pixel;
  }
  return slots;
}

std::vector<SeenSlot> slots_seen(cv::Mat const& pixels, std::span<SeenCar const> cars, double metres_a_pixel) {
  return slots_seen(pixels, cars, metres_a_pixel,
                    SeenGround::rectangle(pixels.cols * metres_a_pixel, pixels.rows * metres_a_pixel));
}

}  // namespace lapwing::vision
