// Surveys of drawn car parks by pictures, in simulated time: camera, vision, mapper and planner of a survey drone, and
// a drone that is where it was told to be. A row a seed: slots found within half a metre, states told rightly,
// coverage. The same seeds give the same rows. `chain.py` flies such car parks with whole programs, in real time.
//
//   bench_survey_flown NETWORK SEED... [--faults POSITION_M ANGLE_DEG]
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <numbers>
#include <optional>
#include <random>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "perceive/lot_eye.hpp"
#include "perceive/surveyor.hpp"
#include "video/camera/simulated_camera.hpp"
#include "video/files/file_bytes.hpp"
#include "video/world/car_park_file.hpp"

namespace {

using namespace lapwing;
using map::SitePoint;

auto const anchor = geo::Wgs84::from_degrees(43.2585, -79.9201, 100.0);
constexpr double across_rad = 1.0821;
constexpr double picture_s = 0.2;

struct Options {
  std::string network;
  video::CameraFaults faults = {.noise = 3.0, .position_m = 0.3, .angle_rad = 0.5 * std::numbers::pi / 180.0};
  std::vector<std::uint64_t> seeds;
};

/// A car park north of home, and the ground that is to be surveyed.
struct Drawn {
  std::string text;
  std::vector<SitePoint> area;
};

/// One or two blocks of two rows of 8 to 14 slots, head to head.
Drawn drawn(std::uint64_t seed) {
  constexpr double slot_m = 2.5;
  constexpr double depth_m = 5.0;
  constexpr double aisle_m = 6.0;
  constexpr double margin_m = 6.0;
  std::mt19937_64 random(seed);
  auto const uniform = [&](double low, double high) { return std::uniform_real_distribution(low, high)(random); };
  auto const turn = uniform(-0.5, 0.5);
  auto const columns = std::uniform_int_distribution(8, 14)(random);
  auto const blocks = std::uniform_int_distribution(1, 2)(random);
  double const wide = columns * slot_m;
  double const deep = blocks * 2 * depth_m + (blocks - 1) * aisle_m;
  Eigen::Vector2d const ahead(std::cos(turn), std::sin(turn));
  Eigen::Vector2d const left(-ahead.y(), ahead.x());
  double const south = 16.0 + 0.5 * wide * std::abs(std::sin(turn)) + uniform(0.0, 4.0);
  auto const at = [&](double along, double across) {
    return SitePoint(Eigen::Vector2d(Eigen::Vector2d(0.0, south) + (along - wide / 2) * ahead + across * left));
  };
  auto const box = [&](double margin) {
    return std::vector{at(-margin, -margin), at(wide + margin, -margin), at(wide + margin, deep + margin),
                       at(-margin, deep + margin)};
  };
  auto const text_of = [](SitePoint const& place) { return fmt::format("[{:.4f}, {:.4f}]", place.x(), place.y()); };
  double const share = uniform(0.3, 0.8);
  std::string corners;
  for (auto const& corner : box(margin_m + 2.0)) corners += text_of(corner) + ", ";
  auto const asphalt = fmt::format("[[area]]\nground = \"asphalt\"\nkerb = true\ncorners = [{}]\n", corners);
  auto text = fmt::format(
      "name = \"Drawn {}\"\nanchor = [43.2585, -79.9201, 100.0]\nseed = {}\n[light]\nsun_azimuth_deg = {:.0f}\n"
      "sun_height_deg = {:.0f}\nshadow = {:.2f}\n[ground]\npixel_m = 0.03\nwear = {:.2f}\n[cars]\nshare = {:.2f}\n{}",
      seed, seed, uniform(90, 270), uniform(25, 70), uniform(0.4, 0.7), uniform(0.1, 0.5), share, asphalt);
  for (int block = 0; block < blocks; ++block) {
    double const low = block * (2 * depth_m + aisle_m);
    for (bool const is_second : {false, true}) {
      std::vector<int> taken;
      std::vector<int> free;
      for (int i = 1; i <= columns; ++i) (uniform(0.0, 1.0) < share ? taken : free).push_back(i);
      auto const begin = is_second ? at(wide, low + 2 * depth_m) : at(0.0, low);
      double const heading = turn + (is_second ? std::numbers::pi : 0.0);
      text += fmt::format(
          "[[row]]\nname = \"{}{}\"\nat = {}\nheading_deg = {:.6f}\ncount = {}\ntaken = {}\nfree = {}\n",
          is_second ? 'B' : 'A', block, text_of(begin), heading * 180.0 / std::numbers::pi, columns, taken, free);
    }
  }
  return {std::move(text), box(margin_m)};
}

base::UtcTime at(double seconds) {
  return base::UtcTime(std::chrono::hours(24 * 365 * 50)) +
         std::chrono::duration_cast<base::UtcTime::duration>(base::from_seconds(seconds));
}

struct Row {
  std::size_t slots = 0;
  std::size_t found = 0;
  std::size_t right = 0;
  std::size_t others = 0;
  double off_m = 0.0;  ///< summed over those found
  double coverage = 0.0;
  double took_s = 0.0;
  std::size_t pictures = 0;
  double all_m = 0.0;     ///< by which all of the map is off
  double beside_m = 0.0;  ///< by which slots are off beside that, root mean square
};

/// Of what is on the map: each slot that there is with the nearest one on it, each once.
void compare(Row& row, video::CarPark const& park, perceive::Surveyor const& surveyor, base::UtcTime now) {
  constexpr double near_m = 0.5;
  auto const is_taken = video::occupation_at(park, now).taken;
  auto left = surveyor.slots();
  std::vector<Eigen::Vector2d> offs;
  for (std::size_t i = 0; i < park.slots.size(); ++i) {
    auto const middle = park.slots[i].middle();
    auto const off = [&](map::Slot const& slot) -> Eigen::Vector2d {
      auto const& ring = slot.outline.rings.front();
      return explore::middle_of({ring[0], ring[1], ring[2], ring[3]}).v - middle.v;
    };
    auto const off_m = [&](map::Slot const& slot) { return off(slot).norm(); };
    ++row.slots;
    auto const nearest = std::ranges::min_element(left, {}, off_m);
    constexpr double half_a_slot_m = 1.2;
    if (nearest != left.end() && off_m(*nearest) < half_a_slot_m) offs.push_back(off(*nearest));
    if (nearest == left.end() || off_m(*nearest) > near_m) continue;
    ++row.found;
    row.off_m += off_m(*nearest);
    row.right += nearest->taken_probability && (*nearest->taken_probability > 0.5) == is_taken[i] ? 1 : 0;
    left.erase(nearest);
  }
  row.others += left.size();
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  double squares = 0.0;
  for (auto const& apart : offs) mean += apart / static_cast<double>(offs.size());
  for (auto const& apart : offs) squares += (apart - mean).squaredNorm() / static_cast<double>(offs.size());
  row.all_m = mean.norm();
  row.beside_m = std::sqrt(squares);
}

/// At 5 m/s, and pictures on the way.
Row fly(Options const& options, std::uint64_t seed) {
  auto const scene = drawn(seed);
  auto const park = video::car_park_of("drawn.toml", scene.text).value();
  auto const site = geo::Site::make("lot", anchor).value();
  perceive::SurveyOrder order;
  for (auto const& corner : scene.area)
    order.area.push_back(site.place_of(geo::Point3<geo::SiteFrame>(corner.x(), corner.y(), 0.0)));
  video::CameraSettings camera{.lens = geo::pinhole(640, 480, across_rad), .seed = seed, .faults = options.faults};
  order.planner.camera = camera.lens;
  auto eye = perceive::LotEye::make(options.network, order.lot).value();
  eye.tie_pictures();
  auto surveyor = perceive::Surveyor::make(order, {.anchor = anchor}, {7.0, 9.0, 14.0}).value();
  video::SimulatedCamera pictures(camera, park, {});

  constexpr double speed_m_s = 5.0;
  constexpr double turn_rad_s = 1.2;
  constexpr double most_s = 600.0;
  geo::Point3<geo::SiteFrame> drone(0.0, 0.0, 9.0);
  double yaw_rad = 0.0;
  Row row;
  for (double now_s = 0.0; now_s < most_s; now_s += picture_s) {
    auto const now = at(now_s);
    auto const place = geo::camera_at(drone, yaw_rad, 0.0);
    auto const frame = pictures.take({.site_from_camera = place, .at = now}).value();
    auto sight = eye.look(frame.picture, {.lens = camera.lens, .site_from_camera = place}, now);
    if (sight) sight->vehicle = "drone";
    ++row.pictures;
    perceive::News news{.now = now, .sight = std::move(sight), .explores = true};
    news.drone = video::BodyPlace(drone, Eigen::Quaterniond(Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitZ())));
    auto const conclusion = surveyor.think(std::move(news));
    row.coverage = conclusion.figures.coverage;
    row.took_s = now_s;
    if (conclusion.report) break;
    if (!conclusion.goal) continue;
    auto const way = conclusion.goal->place - drone;
    drone = drone + std::min(1.0, speed_m_s * picture_s / std::max(1e-6, way.v.norm())) * way;
    double const turn = geo::wrap_pi(conclusion.goal->yaw_rad - yaw_rad);
    yaw_rad = geo::wrap_pi(yaw_rad + std::clamp(turn, -turn_rad_s * picture_s, turn_rad_s * picture_s));
  }
  compare(row, park, surveyor, at(row.took_s));
  return row;
}

void print(std::string const& name, Row const& row) {
  auto const found = static_cast<double>(std::max<std::size_t>(1, row.found));
  fmt::print("| {} | {} | {} | {:.2f} m | {:.2f} m | {:.2f} m | {} | {} | {:.3f} | {:.0f} s | {} |\n", name, row.slots,
             row.found, row.off_m / found, row.all_m, row.beside_m, row.right, row.others, row.coverage, row.took_s,
             row.pictures);
  std::fflush(stdout);
}

std::optional<Options> options_of(std::vector<std::string_view> const& words) {
  if (words.size() < 2) return std::nullopt;
  auto network = video::bytes_of(words[0], std::size_t{64} << 20);
  if (!network) {
    fmt::print(stderr, "{}\n", network.error().message);
    return std::nullopt;
  }
  Options options{.network = *std::move(network), .seeds = {}};
  for (std::size_t i = 1; i < words.size(); ++i) {
    if (words[i] == "--faults" && i + 2 < words.size()) {
      options.faults.position_m = std::atof(words[++i].data());
      options.faults.angle_rad = std::atof(words[++i].data()) * std::numbers::pi / 180.0;
    } else {
      options.seeds.push_back(std::strtoull(words[i].data(), nullptr, 10));
    }
  }
  return options;
}

}  // namespace

int main(int argc, char** argv) {
  auto const options = options_of({argv + 1, argv + argc});
  if (!options) {
    std::fputs("usage: bench_survey_flown models/cars.onnx SEED... [--faults POSITION_M ANGLE_DEG]\n", stderr);
    return 2;
  }
  fmt::print(
      "| seed | slots | within 0.5 m | off | all of them | beside that | rightly told | others | coverage | took | "
      "pictures |\n");
  fmt::print("|---|---|---|---|---|---|---|---|---|---|---|\n");
  Row all;
  for (auto const seed : options->seeds) {
    auto const row = fly(*options, seed);
    print(std::to_string(seed), row);
    all.slots += row.slots;
    all.found += row.found;
    all.right += row.right;
    all.others += row.others;
    all.off_m += row.off_m;
    all.coverage += row.coverage / static_cast<double>(options->seeds.size());
    all.took_s += row.took_s;
    all.pictures += row.pictures;
    all.all_m += row.all_m / static_cast<double>(options->seeds.size());
    all.beside_m += row.beside_m / static_cast<double>(options->seeds.size());
  }
  print("all", all);
}
