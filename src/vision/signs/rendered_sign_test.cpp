#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <opencv2/imgproc.hpp>

#include "sim/building/building.hpp"
#include "sim/building/testing/small_building.hpp"
#include "vision/doors/classic.hpp"
#include "vision/signs/sign_finder.hpp"

namespace lapwing::vision {
namespace {

namespace building = sim::building;

cv::Mat pixels_of(building::Picture const& picture) {
  cv::Mat const rgb(picture.height, picture.width, CV_8UC3, const_cast<std::uint8_t*>(picture.rgb.data()));
  cv::Mat bgr;
  cv::cvtColor(rgb, bgr, cv::COLOR_RGB2BGR);
  return bgr;
}

std::unique_ptr<building::Building> room_with_sign(std::string const& text) {
  auto plan = building::testing::small_plan();
  plan.doors[0].sign = text;
  return building::testing::small_building({{1, 1}, 0.0}, 1, plan);
}

/// What a robot sees that stands `away_m` before the sign, `aside_rad` from straight, and looks at it.
cv::Mat seen_from(building::Building& in, double away_m, double aside_rad) {
  building::Place const sign(4.25, 4.95);
  double const yaw = std::numbers::pi / 2.0 + aside_rad;
  building::Shift const way(std::cos(yaw), std::sin(yaw));
  auto const& camera = in.robot(0).settings().camera;
  building::Pose const pose{sign - (away_m + camera.x_m) * way, yaw};
  return pixels_of(develop(in.shoot_from(camera_on(pose, camera), camera)));
}

TEST(RenderedSign, IsReadByTesseractFromOneToTwoMetresAlsoWhenItIsSeenAslant) {
  auto reader = make_tesseract_reader();
  if (!reader) GTEST_SKIP() << reader.error().message;
  std::vector<std::unique_ptr<LineReader>> readers;
  readers.push_back(*std::move(reader));
  SignFinder finder(std::move(readers));
  int read = 0;
  int all = 0;
  std::string missed;
  for (std::string const text : {"221", "101", "108", "346", "579"}) {
    auto const in = room_with_sign(text);
    for (double const away_m : {1.0, 1.5, 2.0}) {
      for (double const aside_rad : {0.0, 0.4, -0.4, 0.9, -0.9}) {
        auto const signs = finder.find(seen_from(*in, away_m, aside_rad));
        ++all;
        if (std::ranges::any_of(signs, [&](auto const& sign) { return sign.text == text; }))
          ++read;
        else
          missed += fmt::format("{} from {} m, {} rad aside: {}\n", text, away_m, aside_rad,
                                signs.empty() ? "nothing" : signs.front().text.value_or("no number"));
      }
    }
  }
  EXPECT_GE(read, all * 97 / 100) << missed;
}

TEST(RenderedDoor, IsFoundByItsColour) {
  auto const in = room_with_sign("221");
  auto const& camera = in->robot(0).settings().camera;
  building::Pose const pose{{3.5, 2.2}, std::numbers::pi / 2.0};
  auto const doors = doors_by_colour(pixels_of(develop(in->shoot_from(camera_on(pose, camera), camera))));
  ASSERT_EQ(doors.size(), 1U);
  // The middle of the leaf is where the camera looks, so it is on the picture's middle line.
  EXPECT_NEAR(doors.front().box.x + doors.front().box.width / 2.0, camera.width / 2.0, 0.03 * camera.width);
}

}  // namespace
}  // namespace lapwing::vision
