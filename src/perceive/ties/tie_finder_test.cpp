#include "perceive/ties/tie_finder.hpp"

#include <numbers>

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include "explore/lot/lot_map.hpp"

namespace lapwing::perceive {
namespace {

constexpr double texel_m = 0.02;
constexpr double side_m = 60.0;

/// What lies on the ground, north up, with the site's origin in its middle.
using Ground = cv::Mat;

Ground bare() {
  int const side = static_cast<int>(side_m / texel_m);
  return {side, side, CV_8UC3, cv::Scalar::all(90)};
}

cv::Point texel(double east_m, double north_m) {
  return {static_cast<int>((side_m / 2 + east_m) / texel_m), static_cast<int>((side_m / 2 - north_m) / texel_m)};
}

/// Patches and cracks as asphalt has them.
Ground asphalt() {
  auto ground = bare();
  cv::RNG random(4);
  for (int i = 0; i < 3000; ++i) {
    cv::Point const at(random.uniform(0, ground.cols), random.uniform(0, ground.rows));
    cv::Size const size(random.uniform(5, 40), random.uniform(5, 40));
    cv::ellipse(ground, at, size, random.uniform(0, 180), 0, 360, cv::Scalar::all(random.uniform(60, 130)), -1);
  }
  return ground;
}

geo::GroundView view_at(double east_m, double north_m, double yaw_rad = std::numbers::pi / 2.0, double up_m = 14.0) {
  constexpr double across_rad = 1.08;
  return {.lens = geo::pinhole(320, 240, across_rad),
          .site_from_camera = geo::camera_at({east_m, north_m, up_m}, yaw_rad, 0.0)};
}

cv::Mat picture_of(Ground const& ground, geo::GroundView const& view) {
  cv::Mat picture(view.lens.height_px, view.lens.width_px, CV_8UC3);
  for (int row = 0; row < picture.rows; ++row) {
    for (int column = 0; column < picture.cols; ++column) {
      auto const place = geo::ground_at(view, {column + 0.5, row + 0.5}).value();
      picture.at<cv::Vec3b>(row, column) = ground.at<cv::Vec3b>(texel(place.x(), place.y()));
    }
  }
  return picture;
}

/// A drone that is not quite where it says.
class Drone {
 public:
  /// `off`: from where it says that it is to where it is.
  explore::LotSight look(Ground const& ground, geo::GroundView const& told, Eigen::Vector2d const& off,
                         std::vector<cv::Rect2d> const& vehicles = {}) {
    auto real = told;
    auto const at = told.site_from_camera.origin();
    real.site_from_camera =
        geo::CameraPlace({at.x() + off.x(), at.y() + off.y(), at.z()}, told.site_from_camera.rotation());
    now_ += std::chrono::milliseconds(600);
    explore::LotSight sight{.vehicle = "drone", .at = now_, .view = told};
    auto const seen = ground_picture(picture_of(ground, real), told, {}).value();
    cv::Mat standing = cv::Mat::zeros(seen.pixels.size(), CV_8U);
    for (auto const& vehicle : vehicles) {
      // Where the picture shows it, by what the drone believes.
      auto const corner = map::SitePoint(Eigen::Vector2d(Eigen::Vector2d(vehicle.x, vehicle.y) - off));
      Eigen::Vector2d const from = (corner.v - seen.corner.v) / seen.metres_a_pixel;
      cv::rectangle(standing,
                    cv::Rect2d(from.dot(seen.right), from.dot(seen.down), vehicle.width / seen.metres_a_pixel,
                               vehicle.height / seen.metres_a_pixel),
                    cv::Scalar(255), -1);
    }
    ties_.tie(sight, seen, explore::well_seen_ground(told, {}), standing);
    return sight;
  }

 private:
  TieFinder ties_;
  base::UtcTime now_ = base::UtcTime(std::chrono::sys_days(std::chrono::year(2026) / 11 / 20));
};

/// What is at `here` by this picture is at `here` + `off` on the ground, and at that - `off_before` by the earlier one.
void expect_ties(explore::LotSight const& sight, std::size_t fewest, Eigen::Vector2d const& off,
                 Eigen::Vector2d const& off_before) {
  EXPECT_GE(sight.tie_points.size(), fewest);
  for (auto const& tie : sight.tie_points)
    EXPECT_LT((tie.there.v - tie.here.v - (off - off_before)).norm(), 0.05)
        << tie.there.v.transpose() << " and " << tie.here.v.transpose();
}

TEST(TieFinder, FindsTheSameGroundHoweverFarThePosesAreOff) {
  auto const ground = asphalt();
  Drone drone;
  Eigen::Vector2d const before(0.3, -0.2);
  Eigen::Vector2d const now(-0.2, 0.3);
  auto const first = drone.look(ground, view_at(0.0, 0.0), before);
  EXPECT_TRUE(first.tie_points.empty());
  EXPECT_TRUE(first.ties_later);
  auto const second = drone.look(ground, view_at(3.0, 1.0), now);
  expect_ties(second, 3, now, before);
  for (auto const& tie : second.tie_points) EXPECT_EQ(tie.earlier, first.at);
}

TEST(TieFinder, FindsItFromTheOtherSideAndFromLower) {
  auto const ground = asphalt();
  Drone drone;
  drone.look(ground, view_at(0.0, 0.0), {0.1, 0.2});
  expect_ties(drone.look(ground, view_at(1.0, -2.0, -std::numbers::pi / 2.0, 11.0), {-0.2, 0.1}), 2, {-0.2, 0.1},
              {0.1, 0.2});
}

TEST(TieFinder, LooksInOldPicturesWhereThoseBetweenSayThatItLies) {
  auto const ground = asphalt();
  Drone drone;
  // The drone's error grows to 1.5 m on a way round, which is more than is searched.
  std::vector<base::UtcTime> times;
  std::vector<Eigen::Vector2d> offs;
  explore::LotSight last;
  for (int i = 0; i <= 14; ++i) {
    double const away_m = 2.0 * std::min(i, 14 - i);
    offs.emplace_back(0.11 * i, 0.0);
    last = drone.look(ground, view_at(away_m - 7.0, 0.0), offs.back());
    times.push_back(last.at);
  }
  bool has_old = false;
  for (auto const& tie : last.tie_points) {
    auto const earlier = static_cast<std::size_t>(std::ranges::find(times, tie.earlier) - times.begin());
    has_old = has_old || earlier < 3;
    EXPECT_LT((tie.there.v - tie.here.v - (offs.back() - offs[earlier])).norm(), 0.06) << earlier;
  }
  EXPECT_TRUE(has_old);
}

TEST(TieFinder, FindsNothingOnBareGroundNorAlongLines) {
  Drone over_bare;
  over_bare.look(bare(), view_at(0.0, 0.0), {0.0, 0.0});
  EXPECT_TRUE(over_bare.look(bare(), view_at(2.0, 0.0), {0.3, 0.0}).tie_points.empty());
  auto lines = bare();
  for (double north = -25.0; north < 25.0; north += 2.5)
    cv::line(lines, texel(-29.0, north), texel(29.0, north), cv::Scalar::all(220), 6);
  Drone over_lines;
  over_lines.look(lines, view_at(0.0, 0.0), {0.0, 0.0});
  EXPECT_TRUE(over_lines.look(lines, view_at(2.0, 0.0), {0.3, 0.0}).tie_points.empty());
}

TEST(TieFinder, DoesNotGoByVehicles) {
  auto const ground = asphalt();
  auto const with_car = [&](double east_m) {
    auto shown = ground.clone();
    for (double const north : {-2.0, 2.0, 5.0}) {
      cv::rectangle(shown, cv::Rect(texel(east_m, north), cv::Size(220, 100)), cv::Scalar(40, 30, 200), -1);
      cv::rectangle(shown, cv::Rect(texel(east_m + 1.0, north - 0.4), cv::Size(90, 60)), cv::Scalar::all(20), -1);
    }
    return shown;
  };
  auto const boxes = [](double east_m) {
    std::vector<cv::Rect2d> cars;
    for (double const north : {-2.0, 2.0, 5.0}) cars.emplace_back(east_m, north, 4.4, 2.0);
    return cars;
  };
  Drone drone;
  drone.look(with_car(-2.0), view_at(0.0, 0.0), {0.0, 0.0}, boxes(-2.0));
  auto const sight = drone.look(with_car(-1.7), view_at(1.5, 0.0), {0.0, 0.0}, boxes(-1.7));
  expect_ties(sight, 2, {0.0, 0.0}, {0.0, 0.0});
}

TEST(TieFinder, KeepsNoPictureThatShowsWhatTheLastDid) {
  auto const ground = asphalt();
  Drone drone;
  EXPECT_TRUE(drone.look(ground, view_at(0.0, 0.0), {0.0, 0.0}).ties_later);
  EXPECT_FALSE(drone.look(ground, view_at(0.2, 0.0), {0.0, 0.0}).ties_later);
  EXPECT_TRUE(drone.look(ground, view_at(4.0, 0.0), {0.0, 0.0}).ties_later);
}

TEST(TieFinder, FindsItFromHighAboveToo) {
  auto const ground = asphalt();
  Drone drone;
  auto const from_high = [](double east_m, double north_m) {
    auto view = view_at(east_m, north_m, std::numbers::pi / 2.0, 32.0);
    view.lens = geo::pinhole(640, 480, 1.08);
    return view;
  };
  drone.look(ground, from_high(0.0, 0.0), {0.3, -0.2});
  auto const second = drone.look(ground, from_high(6.0, 1.0), {-0.1, 0.2});
  EXPECT_GE(second.tie_points.size(), 2U);
  for (auto const& tie : second.tie_points)
    EXPECT_LT((tie.there.v - tie.here.v - Eigen::Vector2d(-0.4, 0.4)).norm(), 0.1) << "a pixel measures 0.12 m";
}

TEST(TieFinder, PicturesFromHighAboveAreCoarser) {
  auto const low = view_at(0.0, 0.0);
  auto const plan_from = [](geo::GroundView const& view) {
    explore::LotSettings settings;
    settings.coarsest_m = 1.0;
    settings.farthest_m = 200.0;
    auto const ground =
        ground_picture(cv::Mat(view.lens.height_px, view.lens.width_px, CV_8UC3, cv::Scalar::all(90)), view, settings);
    return ground_plan({.vehicle = "drone", .at = {}, .view = view}, *ground, explore::well_seen_ground(view, settings),
                       cv::Mat::zeros(ground->pixels.size(), CV_8U));
  };
  EXPECT_EQ(plan_from(low).pixel_m, 0.06);
  auto const high = plan_from(view_at(0.0, 0.0, 0.0, 60.0));
  EXPECT_EQ(high.pixel_m, 0.24);
  EXPECT_LE(std::max(high.shades.cols, high.shades.rows), 513);
}

}  // namespace
}  // namespace lapwing::perceive
