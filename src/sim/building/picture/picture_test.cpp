#include "sim/building/picture/picture.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <numbers>
#include <set>

#include "sim/building/picture/camera.hpp"
#include "sim/building/testing/small_building.hpp"

namespace lapwing::sim::building {
namespace {

using testing::small_building;
using testing::small_plan;

CameraSettings plain_camera() {
  return {.width = 320, .height = 240, .defocus_px = 0.0, .noise = 0.0, .corner_light = 1.0};
}

/// A room with a red block in its middle; the camera looks east.
std::unique_ptr<Building> with_block() {
  auto plan = small_plan();
  plan.furniture.push_back(
      {.middle = {{5, 2.5}, 0.0}, .length_m = 0.4, .width_m = 0.6, .height_m = 1.0, .colour = {0.9, 0.05, 0.05}});
  return small_building({{2, 2.5}, 0.0}, 1, plan);
}

bool is_red(Picture const& picture, Eigen::Vector2d const& pixel) {
  auto const* const rgb = picture.at(static_cast<int>(pixel.x()), static_cast<int>(pixel.y()));
  return rgb[0] > 100 && rgb[1] < 60 && rgb[2] < 60;
}

double mean(Picture const& picture) {
  double sum = 0.0;
  for (auto const value : picture.rgb) sum += value;
  return sum / static_cast<double>(picture.rgb.size());
}

/// Squares of what neighbours along a row or a column differ by: blurred edges have less, though as much in sum.
double roughness(Picture const& picture, bool is_along_rows) {
  double sum = 0.0;
  for (int y = 0; y + 1 < picture.height; ++y) {
    for (int x = 0; x + 1 < picture.width; ++x) {
      auto const* const next = is_along_rows ? picture.at(x + 1, y) : picture.at(x, y + 1);
      double const off = picture.at(x, y)[1] - next[1];
      sum += off * off;
    }
  }
  return sum;
}

TEST(Camera, ShowsThingsWhereTheirPlaceInThePictureIs) {
  auto const building = with_block();
  auto const camera = plain_camera();
  for (double const yaw : {0.0, 0.3, -0.25}) {
    auto const pose = camera_on({{2, 2.5}, yaw}, camera);
    auto const picture = develop(building->shoot_from(pose, camera));
    auto const at = [&](double y, double z) { return pixel_of({4.8, y, z}, pose, camera).value(); };
    EXPECT_TRUE(is_red(picture, at(2.23, 0.95))) << yaw;
    EXPECT_TRUE(is_red(picture, at(2.77, 0.7))) << yaw;
    EXPECT_FALSE(is_red(picture, at(2.15, 0.95))) << yaw;
    EXPECT_FALSE(is_red(picture, at(2.85, 0.7))) << yaw;
    EXPECT_FALSE(is_red(picture, at(2.5, 1.2))) << yaw;
  }
  EXPECT_FALSE(pixel_of({1.0, 2.5, 1.0}, camera_on({{2, 2.5}, 0.0}, camera), camera));
}

TEST(Camera, SeesNothingThroughAWall) {
  auto plan = small_plan();
  plan.furniture.push_back({.middle = {{5, 2.5}, 0.0}, .height_m = 2.0, .colour = {0.9, 0.05, 0.05}});
  plan.walls.push_back({.from = {4, 0}, .to = {4, 5}});
  auto const building = small_building({{2, 2.5}, 0.0}, 1, plan);
  auto const camera = plain_camera();
  auto const picture = develop(building->shoot_from(camera_on({{2, 2.5}, 0.0}, camera), camera));
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x)
      ASSERT_FALSE(is_red(picture, {static_cast<double>(x), static_cast<double>(y)})) << x << ' ' << y;
  }
}

TEST(Camera, SeesDoorsMoveAndPeopleAndOtherRobots) {
  auto plan = small_plan();
  plan.people.push_back({.start = {{6, 2.5}, 0.0}});
  auto const building = Building::make(plan, {.robots = 2, .starts = {{{2, 2.5}, 0.0}, {{4, 2.2}, 0.0}}}).value();
  auto camera = plain_camera();
  auto const look = [&](double yaw) {
    return develop(building->shoot_from(camera_on({{3, 2.5}, yaw}, camera), camera));
  };
  auto const closed = look(std::numbers::pi / 2.0);
  auto const crowd = look(0.0);
  building->doors().hold(0, 1.5);
  for (int i = 0; i < 600; ++i) building->step();
  building->people().put(0, {{6, 4.5}, 0.0});
  EXPECT_NE(look(std::numbers::pi / 2.0), closed);
  auto const without_person = look(0.0);
  EXPECT_NE(without_person, crowd);
  building->robot(1).body().put({{1, 4}, 0.0});
  EXPECT_NE(look(0.0), without_person);
  // Nobody sees the robot that he is on.
  EXPECT_LT(building->shoot(0)->moving.size(), building->shoot_from({}, camera).moving.size());
}

TEST(Lens, HasTheNoiseOfItsSettings) {
  auto const building = with_block();
  auto camera = plain_camera();
  auto shot = building->shoot_from(camera_on({{2, 2.5}, 0.0}, camera), camera);
  // Values in the middle of the scale, so that nothing is cut off.
  shot.settings.light = 0.5;
  auto const clean = develop(shot);
  shot.settings.noise = 0.02;
  auto const noisy = develop(shot);
  double squares = 0.0;
  double sum = 0.0;
  for (std::size_t i = 0; i < clean.rgb.size(); ++i) {
    double const off = static_cast<double>(noisy.rgb[i]) - clean.rgb[i];
    sum += off;
    squares += off * off;
  }
  auto const count = static_cast<double>(clean.rgb.size());
  EXPECT_NEAR(sum / count, 0.0, 0.2);
  EXPECT_NEAR(std::sqrt(squares / count), 0.02 * 255.0, 0.15);
}

TEST(Lens, DimsAndBlursAsAsked) {
  auto const building = with_block();
  auto shot = building->shoot_from(camera_on({{2, 2.5}, 0.0}, plain_camera()), plain_camera());
  auto const sharp = develop(shot);
  shot.settings.light = 0.5;
  EXPECT_NEAR(mean(develop(shot)) / mean(sharp), 0.5, 0.02);
  shot.settings.light = 0.0;
  EXPECT_EQ(mean(develop(shot)), 0.0);
  shot.settings.light = 1.0;
  shot.settings.defocus_px = 3.0;
  EXPECT_LT(roughness(develop(shot), true), 0.6 * roughness(sharp, true));
  EXPECT_LT(roughness(develop(shot), false), 0.6 * roughness(sharp, false));
  shot.settings.defocus_px = 0.0;
  shot.turn_rad_s = 3.0;
  EXPECT_LT(roughness(develop(shot), true), 0.6 * roughness(sharp, true));
  EXPECT_GT(roughness(develop(shot), false), 0.6 * roughness(sharp, false));
}

TEST(Lens, IsDarkerInItsCorners) {
  auto const building = with_block();
  auto shot = building->shoot_from(camera_on({{2, 2.5}, 0.0}, plain_camera()), plain_camera());
  auto const even = develop(shot);
  shot.settings.corner_light = 0.5;
  auto const uneven = develop(shot);
  EXPECT_NEAR(uneven.at(1, 1)[0] / static_cast<double>(even.at(1, 1)[0]), 0.5, 0.03);
  EXPECT_NEAR(uneven.at(160, 120)[0], even.at(160, 120)[0], 1);
}

TEST(Robot, HasPicturesAsBrokenAsItsCamera) {
  auto const building = with_block();
  auto& robot = building->robot(0);
  auto const fine = develop(*building->shoot(0));
  robot.set({.kind = Fault::Kind::camera_dark, .amount = 0.1});
  EXPECT_LT(mean(develop(*building->shoot(0))), 0.15 * mean(fine));
  robot.mend_all();
  robot.set({.kind = Fault::Kind::camera_blurred, .amount = 4.0});
  EXPECT_LT(roughness(develop(*building->shoot(0)), true), roughness(fine, true));
  robot.set({.kind = Fault::Kind::camera_silent});
  EXPECT_FALSE(building->shoot(0));
}

TEST(Letters, AreAllDifferentAndStayInTheirRow) {
  std::set<std::vector<double>> shapes;
  for (char const letter : known_letters()) {
    auto const row = row_of_letters(std::string(1, letter));
    ASSERT_FALSE(row.strokes.empty()) << letter;
    std::vector<double> shape;
    for (auto const& stroke : row.strokes) {
      shape.insert(shape.end(), {stroke.from_x, stroke.from_y, stroke.to_x, stroke.to_y});
      for (double const x : {stroke.from_x, stroke.to_x}) {
        EXPECT_GE(x, -0.02) << letter;
        EXPECT_LE(x, row.width + 0.07) << letter;
      }
      EXPECT_GE(std::min(stroke.from_y, stroke.to_y), -0.35) << letter;
      EXPECT_LE(std::max(stroke.from_y, stroke.to_y), 1.11) << letter;
      EXPECT_LT(std::abs(stroke.to_x - stroke.from_x), 1.3) << letter;
    }
    EXPECT_TRUE(shapes.insert(shape).second) << letter;
  }
  EXPECT_TRUE(has_letter(' '));
  EXPECT_FALSE(has_letter('\xc3'));
  EXPECT_GT(row_of_letters("101").width, row_of_letters("10").width);
}

TEST(Letters, AreNearWhereTheirStrokesAre) {
  auto const row = row_of_letters("IHI");
  Noise noise(1, "test");
  for (int i = 0; i < 500; ++i) {
    double const x = noise.uniform(-0.5, row.width + 0.5);
    double const y = noise.uniform(-0.3, 1.3);
    double least = 10.0;
    for (auto const& stroke : row.strokes) {
      for (int part = 0; part <= 200; ++part) {
        double const share = part / 200.0;
        least = std::min(least, std::hypot(x - std::lerp(stroke.from_x, stroke.to_x, share),
                                           y - std::lerp(stroke.from_y, stroke.to_y, share)));
      }
    }
    EXPECT_NEAR(distance_to_strokes(row, x, y, 0.3), std::min(least, 0.3), 0.005);
  }
}

/// Compilers may round light differently by one in 255; a different picture differs by more.
TEST(Camera, TakesThePictureThatItTookBefore) {
  auto plan = small_plan();
  plan.people.push_back({.start = {{5.2, 3.6}, -2.0}});
  plan.furniture.push_back({.middle = {{6, 1}, 0.4}});
  auto const building = small_building({{2.6, 2.6}, 1.1}, 1, plan);
  CameraSettings camera{.width = 128, .height = 96, .noise = 0.0};
  camera.pitch_rad = 0.1;
  auto const picture = develop(building->shoot_from(camera_on({{2.2, 1.4}, 1.0}, camera), camera));
  std::string const path = LAPWING_SOURCE_DIR "/tests/golden/building/room.ppm";
  if (std::getenv("LAPWING_REFRESH_GOLDEN")) std::ofstream(path, std::ios::binary) << ppm_of(picture);
  std::ifstream file(path, std::ios::binary);
  std::string const golden{std::istreambuf_iterator<char>(file), {}};
  auto const now = ppm_of(picture);
  ASSERT_EQ(golden.size(), now.size());
  double sum = 0.0;
  for (std::size_t i = 0; i < now.size(); ++i)
    sum += std::abs(static_cast<std::uint8_t>(now[i]) - static_cast<std::uint8_t>(golden[i]));
  EXPECT_LT(sum / static_cast<double>(now.size()), 0.1);
}

}  // namespace
}  // namespace lapwing::sim::building
