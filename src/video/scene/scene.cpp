#include "video/scene/scene.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <opencv2/imgproc.hpp>

#include "video/scene/vehicle_solid.hpp"

namespace lapwing::video {

namespace {

Sun sun_of(Light const& light) {
  double const level = std::cos(light.sun_height_rad);
  return {.towards = {level * std::sin(light.sun_azimuth_rad), level * std::cos(light.sun_azimuth_rad),
                      std::sin(light.sun_height_rad)},
          .share = light.shadow,
          .brightness = light.brightness};
}

/// What the pixels of one part of the picture show, in pixels of the ground's first level.
struct GroundMap {
  cv::Mat at;  // two 32-bit numbers each
  bool has_sky = false;
};

/// What lies farther away is haze.
constexpr float farthest_heights = 60.0F;
constexpr float nowhere = -1e6F;

/// From the camera's directions to the ground's pixels.
class GroundMapper {
 public:
  GroundMapper(geo::GroundView const& view, GroundRaster const& raster)
      : turn_(view.site_from_camera.rotation().toRotationMatrix().cast<float>()),
        height_px_(static_cast<float>(view.height_m() / raster.pixel_m)),
        foot_x_(
            static_cast<float>((view.site_from_camera.origin().x() - raster.north_west.x()) / raster.pixel_m - 0.5)),
        foot_y_(
            static_cast<float>((raster.north_west.y() - view.site_from_camera.origin().y()) / raster.pixel_m - 0.5)) {}

  [[nodiscard]] GroundMap map(Rays const& rays, cv::Rect const& part) const {
    GroundMap map{.at = cv::Mat(part.size(), CV_32FC2)};
    for (int row = 0; row < part.height; ++row) {
      auto const* const x = rays.x.ptr<float>(part.y + row) + part.x;
      auto const* const y = rays.y.ptr<float>(part.y + row) + part.x;
      auto* const out = map.at.ptr<cv::Vec2f>(row);
      for (int i = 0; i < part.width; ++i) {
        float const sink = -(turn_(2, 0) * x[i] + turn_(2, 1) * y[i] + turn_(2, 2));
        float const east = turn_(0, 0) * x[i] + turn_(0, 1) * y[i] + turn_(0, 2);
        float const north = turn_(1, 0) * x[i] + turn_(1, 1) * y[i] + turn_(1, 2);
        bool const is_sky = sink * farthest_heights < 1.0F;
        float const along = is_sky ? 0.0F : height_px_ / sink;
        map.has_sky = map.has_sky || is_sky;
        out[i] = is_sky ? cv::Vec2f(nowhere, nowhere) : cv::Vec2f(foot_x_ + along * east, foot_y_ - along * north);
      }
    }
    return map;
  }

 private:
  Eigen::Matrix3f turn_;
  float height_px_;
  float foot_x_;
  float foot_y_;
};

/// The level whose pixels are as large as the picture's in the middle of the part.
int level_for(GroundMap const& map, std::size_t level_count) {
  int const row = map.at.rows / 2;
  int const column = map.at.cols / 2;
  if (map.has_sky || row < 1 || column < 1) return static_cast<int>(level_count) - 1;
  auto const& here = map.at.at<cv::Vec2f>(row, column);
  double const aside = cv::norm(map.at.at<cv::Vec2f>(row, column - 1) - here);
  double const down = cv::norm(map.at.at<cv::Vec2f>(row - 1, column) - here);
  double const step = std::max(1e-6, std::sqrt(aside * down));
  return std::clamp(static_cast<int>(std::lround(std::log2(step))), 0, static_cast<int>(level_count) - 1);
}

void draw_sky(cv::Mat part, GroundMap const& map) {
  constexpr std::array<std::uint8_t, 3> haze = {206, 198, 190};
  for (int row = 0; row < part.rows; ++row)
    for (int i = 0; i < part.cols; ++i)
      if (map.at.at<cv::Vec2f>(row, i)[0] == nowhere) part.at<cv::Vec3b>(row, i) = cv::Vec3b(haze[0], haze[1], haze[2]);
}

/// A camera on the ground sees it from a little above.
void lift(geo::GroundView& view) {
  auto const& at = view.site_from_camera.origin();
  if (at.z() >= Scene::lowest_m) return;
  view.site_from_camera = {geo::Point3<geo::SiteFrame>(at.x(), at.y(), Scene::lowest_m),
                           view.site_from_camera.rotation()};
}

}  // namespace

Rays rays_of(geo::Lens const& lens) {
  Rays rays{.x = cv::Mat(lens.height_px, lens.width_px, CV_32F), .y = cv::Mat(lens.height_px, lens.width_px, CV_32F)};
  geo::Vector3<geo::CameraFrame> last(0.0, 0.0, 1.0);
  for (int row = 0; row < lens.height_px; ++row)
    for (int column = 0; column < lens.width_px; ++column) {
      // Where Newton's method does not end within the picture of a sound lens, the neighbour's direction is as good.
      if (auto const ray = geo::ray_of(lens, {column + 0.5, row + 0.5})) last = *ray;
      rays.x.at<float>(row, column) = static_cast<float>(last.x());
      rays.y.at<float>(row, column) = static_cast<float>(last.y());
    }
  return rays;
}

Scene::Scene(CarPark park, cv::Mat const& photograph)
    : park_(std::move(park)), sun_(sun_of(park_.light)), ground_(draw_ground(park_, sun_, photograph)) {
  for (auto const& tree : park_.trees) crowns_.push_back(crown_of(tree, sun_, park_.seed, crowns_.size()));
}

cv::Mat Scene::seen(geo::GroundView view, Rays const& rays, Occupation const& now) const {
  view.ground_up_m = 0.0;
  lift(view);
  cv::Mat picture = ground_seen(view, rays);
  Projector const projector(view, picture);
  std::vector<Vehicle const*> near;
  for (auto const& vehicle : now.vehicles) {
    constexpr double reach_m = 8.0;  // a long vehicle and its shadow
    if (projector.may_show({vehicle.at.x(), vehicle.at.y(), 0.5}, reach_m)) near.push_back(&vehicle);
  }
  shadows(picture, view, near);
  standing(picture, view, near);
  return picture;
}

cv::Mat Scene::ground_seen(geo::GroundView const& view, Rays const& rays) const {
  cv::Mat picture(rays.x.size(), CV_8UC3);
  GroundMapper const mapper(view, ground_);
  constexpr int part_px = 64;
  for (int y = 0; y < picture.rows; y += part_px)
    for (int x = 0; x < picture.cols; x += part_px) {
      cv::Rect const part(x, y, std::min(part_px, picture.cols - x), std::min(part_px, picture.rows - y));
      auto map = mapper.map(rays, part);
      int const level = level_for(map, ground_.levels.size());
      double const scale = 1.0 / (1 << level);
      // A pixel of the level has its middle between those of the first level that it is made of.
      cv::Mat at = level == 0 ? map.at : cv::Mat();
      if (level > 0) map.at.convertTo(at, -1, scale, 0.5 * scale - 0.5);
      cv::Mat into = picture(part);
      cv::remap(ground_.levels[static_cast<std::size_t>(level)], into, at, {}, cv::INTER_LINEAR, cv::BORDER_CONSTANT,
                ground_.beyond);
      if (map.has_sky) draw_sky(into, map);
    }
  return picture;
}

void Scene::shadows(cv::Mat& picture, geo::GroundView const& view, std::vector<Vehicle const*> const& vehicles) const {
  if (vehicles.empty()) return;
  cv::Mat dark = cv::Mat::zeros(picture.size(), CV_8U);
  Projector const projector(view, dark);
  for (auto const* const vehicle : vehicles) {
    double const sunny = 1.0 - ground_.shade_at(vehicle->at);
    projector.fill(vehicle_shadow(*vehicle, sun_), cv::Scalar(255.0 * (1.0 - sun_.in_shadow(1.0)) * sunny));
  }
  // Under a vehicle no light comes from the sky either.
  constexpr double under = 190.0;
  for (auto const* const vehicle : vehicles) projector.fill(vehicle_foot(*vehicle), cv::Scalar(under));
  constexpr double soft_m = 0.06;
  double const pixel_m = projector.metres_a_pixel({vehicles.front()->at.x(), vehicles.front()->at.y(), 0.0});
  double const soft_px = pixel_m > 0.0 ? std::clamp(soft_m / pixel_m, 0.5, 6.0) : 0.5;
  cv::GaussianBlur(dark, dark, {}, soft_px);
  for (int row = 0; row < picture.rows; ++row) {
    auto const* const by = dark.ptr<std::uint8_t>(row);
    auto* const out = picture.ptr<std::uint8_t>(row);
    for (int i = 0; i < picture.cols; ++i) {
      if (by[i] == 0) continue;
      unsigned const left = 255U - by[i];
      for (int channel = 0; channel < 3; ++channel)
        out[3 * i + channel] = static_cast<std::uint8_t>(out[3 * i + channel] * left / 255U);
    }
  }
}

void Scene::standing(cv::Mat& picture, geo::GroundView const& view, std::vector<Vehicle const*> const& vehicles) const {
  Projector const projector(view, picture);
  struct Thing {
    double distance_m;
    Vehicle const* vehicle = nullptr;
    Crown const* crown = nullptr;
    Block const* block = nullptr;
  };
  std::vector<Thing> things;
  auto const far = [&](Spot const& at) { return (at.v - projector.camera().head<2>()).norm(); };
  for (auto const* const vehicle : vehicles) things.push_back({.distance_m = far(vehicle->at), .vehicle = vehicle});
  constexpr double overhang_m = 3.0;  // a crown is above the vehicles beside it
  for (auto const& crown : crowns_)
    if (projector.may_show({crown.tree.at.x(), crown.tree.at.y(), crown.tree.height_m}, crown.tree.radius_m))
      things.push_back({.distance_m = far(crown.tree.at) - crown.tree.radius_m - overhang_m, .crown = &crown});
  for (auto const& block : park_.blocks) {
    double nearest = far(block.corners.front());
    for (auto const& corner : block.corners) nearest = std::min(nearest, far(corner));
    things.push_back({.distance_m = nearest, .block = &block});
  }
  // What is nearer to the place below the camera hides what is farther out.
  std::ranges::stable_sort(things, std::ranges::greater(), &Thing::distance_m);
  for (auto const& thing : things) {
    if (thing.vehicle != nullptr)
      draw_vehicle(projector, *thing.vehicle, sun_, sun_.in_shadow(ground_.shade_at(thing.vehicle->at)));
    else if (thing.crown != nullptr)
      draw_tree(projector, *thing.crown, sun_);
    else
      draw_block(projector, *thing.block, sun_);
  }
}

}  // namespace lapwing::video
