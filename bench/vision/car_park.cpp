// The simulated camera: how long a picture takes, and pictures with what is true of them, for `lapwing detect slots`.
//
//   bench_car_park WORLD            prints a row for each size and height
//   bench_car_park WORLD OUT [N]    writes N pictures from each height to OUT/HEIGHT, straight down, beside each of
//   them
//                                   its slots, and poses.csv
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <span>
#include <string>

#include <fmt/format.h>
#include <opencv2/imgcodecs.hpp>

#include "base/text/utc_text.hpp"
#include "video/camera/pose_table.hpp"
#include "video/camera/simulated_camera.hpp"
#include "video/world/car_park_file.hpp"

namespace {

using namespace lapwing;

constexpr double across_rad = 1.0821;

/// Over a slot, at some time of some day.
video::Moment moment_of(video::CarPark const& park, double height_m, std::uint64_t number) {
  video::Dice dice(number, 4711);
  auto const at = park.slots[dice.bits() % park.slots.size()].middle();
  auto const time = base::UtcTime() + std::chrono::days(20'000) + std::chrono::minutes(7 * number);
  auto const yaw_rad = dice.uniform(0.0, 6.28);
  return {geo::camera_at(geo::Point3<geo::SiteFrame>(at.x(), at.y(), height_m), yaw_rad, 0.0), time};
}

void time_pictures(video::CarPark const& park, int width, int height, double height_m) {
  video::CameraSettings const settings{.lens = geo::pinhole(width, height, across_rad)};
  video::SimulatedCamera camera(settings, park, {});
  constexpr int pictures = 40;
  auto const begin = std::chrono::steady_clock::now();
  for (std::uint64_t i = 0; i < pictures; ++i) {
    auto const frame = camera.take(moment_of(park, height_m, i));
    if (!frame) std::exit(1);
  }
  std::chrono::duration<double, std::milli> const took = std::chrono::steady_clock::now() - begin;
  fmt::print("{:5} x {:4}  {:3.0f} m  {:6.1f} ms a picture\n", width, height, height_m, took.count() / pictures);
}

/// The slots that are wholly in the picture, and a metre from its edge, as `lapwing detect slots --truth` takes them.
std::string truth_of(video::CarPark const& park, geo::GroundView const& view, video::Occupation const& now) {
  double const edge_px = view.lens.focal_x_px / view.height_m();
  std::string slots;
  for (std::size_t i = 0; i < park.slots.size(); ++i) {
    std::string corners;
    bool is_whole = true;
    for (auto const& corner : park.slots[i].outline) {
      auto const pixel = geo::seen_at(view, corner);
      is_whole = is_whole && pixel && pixel->x > edge_px && pixel->y > edge_px &&
                 pixel->x < view.lens.width_px - edge_px && pixel->y < view.lens.height_px - edge_px;
      if (pixel) corners += fmt::format("{}[{:.2f}, {:.2f}]", corners.empty() ? "" : ", ", pixel->x, pixel->y);
    }
    if (is_whole)
      slots += fmt::format("{}{{\"corners\": [{}], \"occupied\": {}}}", slots.empty() ? "" : ",\n  ", corners,
                           static_cast<bool>(now.taken[i]));
  }
  return fmt::format("{{\"slots\": [\n  {}]}}\n", slots);
}

bool write_pictures(video::CarPark const& park, std::filesystem::path const& folder, double height_m,
                    std::uint64_t count) {
  video::CameraSettings const settings{.lens = geo::pinhole(1280, 720, across_rad)};
  video::SimulatedCamera camera(settings, park, {});
  std::filesystem::create_directories(folder);
  std::ofstream poses(folder / "poses.csv");
  poses << video::pose_columns << '\n';
  for (std::uint64_t i = 0; i < count; ++i) {
    auto const moment = moment_of(park, height_m, i);
    auto const frame = camera.take(moment);
    auto const name = fmt::format("{:03}.png", i);
    if (!frame || !cv::imwrite((folder / name).string(), frame->picture)) return false;
    geo::GroundView const view{.lens = frame->lens, .site_from_camera = moment.site_from_camera};
    std::ofstream(folder / fmt::format("{:03}.json", i))
        << truth_of(park, view, video::occupation_at(park, frame->taken));
    auto const at = moment.site_from_camera.origin();
    // camera_at's y axis is where the lower edge of the picture points.
    auto const down = moment.site_from_camera * geo::Vector3<geo::CameraFrame>(0.0, 1.0, 0.0);
    poses << fmt::format("{},{},{:.3f},{:.3f},{:.3f},{:.4f},0,0\n", name, base::to_iso8601(frame->taken), at.x(),
                         at.y(), at.z(), std::atan2(-down.y(), -down.x()) * 180.0 / std::numbers::pi);
  }
  // The pixels' measure is the height over the focal length.
  fmt::print("{}: {} pictures, {:.5f} m a pixel\n", folder.string(), count, height_m / settings.lens.focal_x_px);
  return static_cast<bool>(poses);
}

}  // namespace

int main(int argc, char** argv) {
  std::span const words(argv, static_cast<std::size_t>(argc));
  constexpr int bad_usage = 2;
  if (words.size() < 2 || words.size() > 4) return bad_usage;
  auto const begin = std::chrono::steady_clock::now();
  auto const park = video::load_car_park(words[1]);
  if (!park) {
    fmt::print(stderr, "{}\n", park.error().message);
    return bad_usage;
  }
  if (park->slots.empty()) {
    fmt::print(stderr, "{} has no slots to fly over\n", words[1]);
    return bad_usage;
  }
  if (words.size() > 2) {
    auto const count = words.size() > 3 ? std::strtoull(words[3], nullptr, 10) : 8;
    for (double const height_m : {20.0, 30.0})
      if (!write_pictures(*park, std::filesystem::path(words[2]) / fmt::format("{:.0f}", height_m), height_m, count))
        return 1;
    return 0;
  }
  video::SimulatedCamera const opened({}, *park, {});
  std::chrono::duration<double> const took = std::chrono::steady_clock::now() - begin;
  fmt::print("opened in {:.2f} s: {} slots\n", took.count(), park->slots.size());
  for (double const height_m : {10.0, 20.0, 30.0, 60.0}) {
    time_pictures(*park, 640, 480, height_m);
    time_pictures(*park, 1280, 720, height_m);
  }
  return 0;
}
