#include <fstream>
#include <iterator>

#include <gtest/gtest.h>

#include "video/camera/simulated_camera.hpp"
#include "video/testing/small_car_park.hpp"
#include "vision/cars/car_network.hpp"
#include "vision/lot/evaluate_slots.hpp"
#include "vision/lot/layout.hpp"
#include "vision/lot/occupancy.hpp"

/// The project's own detectors on rendered pictures: what is drawn looks enough like a car park to them.
namespace lapwing::video {
namespace {

vision::CarNetwork network() {
  std::ifstream in(LAPWING_SOURCE_DIR "/models/cars.onnx", std::ios::binary);
  return vision::CarNetwork::load({std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()}).value();
}

/// As `lapwing detect slots` looks at a picture.
std::vector<vision::JudgedSlot> found_slots(vision::CarNetwork& cars, cv::Mat const& picture, double metres_a_pixel) {
  constexpr double least_car = 0.15;
  constexpr double least_car_of_layout = 0.5;
  auto const overhead = cars.look(picture, metres_a_pixel, least_car);
  std::vector<vision::TurnedBox> boxes;
  for (auto const& car : overhead.cars) {
    if (car.score < least_car_of_layout) continue;
    auto box = car.box;
    box.middle = {box.middle.x * metres_a_pixel, box.middle.y * metres_a_pixel};
    box.length *= metres_a_pixel;
    box.width *= metres_a_pixel;
    boxes.push_back(box);
  }
  std::vector<vision::JudgedSlot> slots;
  auto const seen = vision::SeenGround::rectangle(picture.cols * metres_a_pixel, picture.rows * metres_a_pixel);
  for (auto const& shape : vision::slots_between(vision::painted_lines(picture, metres_a_pixel), boxes, seen)) {
    auto& slot = slots.emplace_back(vision::JudgedSlot{.corners = shape.corners});
    for (auto& corner : slot.corners) corner *= 1.0 / metres_a_pixel;
    slot.occupied = vision::occupied_chance(slot.corners, overhead, picture.size());
  }
  return slots;
}

/// Those that are wholly in the picture, and a metre from its edge: with the lines on both of their sides.
std::vector<vision::JudgedSlot> true_slots(CarPark const& park, geo::GroundView const& view, Occupation const& now) {
  double const edge_px = view.lens.focal_x_px / view.height_m();
  std::vector<vision::JudgedSlot> slots;
  for (std::size_t i = 0; i < park.slots.size(); ++i) {
    vision::JudgedSlot slot{.corners = {}, .occupied = now.taken[i] ? 1.0 : 0.0};
    bool is_whole = true;
    for (std::size_t k = 0; k < slot.corners.size(); ++k) {
      auto const pixel = geo::seen_at(view, park.slots[i].outline[k]);
      is_whole = is_whole && pixel && pixel->x > edge_px && pixel->y > edge_px &&
                 pixel->x < view.lens.width_px - edge_px && pixel->y < view.lens.height_px - edge_px;
      if (pixel) slot.corners[k] = {pixel->x, pixel->y};
    }
    if (is_whole) slots.push_back(slot);
  }
  return slots;
}

TEST(RenderedPictures, TheDetectorsFindTheirSlotsAndWhichAreTaken) {
  auto cars = network();
  CameraSettings const settings;
  vision::SlotFigures figures;
  for (double const height_m : {20.0, 30.0})
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
      SimulatedCamera camera(settings, testing::small_car_park(seed, 0.55), {});
      double const yaw_rad = 0.4 * static_cast<double>(seed);
      geo::GroundView const view{
          .lens = settings.lens,
          .site_from_camera = geo::camera_at(geo::Point3<geo::SiteFrame>(0, 0, height_m), yaw_rad, 0.0)};
      auto const frame = camera.take({view.site_from_camera, {}});
      ASSERT_TRUE(frame);
      double const metres_a_pixel = height_m / settings.lens.focal_x_px;
      add(figures, found_slots(cars, frame->picture, metres_a_pixel),
          true_slots(camera.park(), view, occupation_at(camera.park(), frame->taken)), metres_a_pixel);
    }
  EXPECT_GE(figures.there, 90U);
  EXPECT_GE(figures.recall(), 0.95);
  EXPECT_GE(figures.accuracy(), 0.97);
}

}  // namespace
}  // namespace lapwing::video
