// From how far name tags are noticed, and read: rendered ones on a wall, looked at from further and further off and
// more and more aslant. A row for each distance and angle; what a wall's clearness is: robot/views/look_book.hpp.
//
//   bench_notice
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <opencv2/imgproc.hpp>

#include "apps/vision/sign_readers.hpp"
#include "robot/views/look_book.hpp"
#include "sim/building/building.hpp"
#include "vision/signs/sign_finder.hpp"

namespace {

using namespace lapwing;
namespace building = sim::building;

struct Tag {
  std::string lines;
  std::string number;  ///< empty: a kind of room alone is written there
};

Tag const tags[] = {
    {"221", "221"}, {"108\nOffice", "108"}, {"B-106", "B-106"}, {"346\nMeeting room", "346"}, {"EXIT", ""}};
constexpr double aways_m[] = {1.2, 1.6, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 7.0};
constexpr double asides_rad[] = {0.0, 0.5, 0.9, 1.2};

/// A big room with a tag beside the door in its northern wall.
std::unique_ptr<building::Building> room_with(Tag const& tag) {
  building::BuildingPlan plan;
  building::Place const corners[] = {{0, 0}, {16, 0}, {16, 9}, {0, 9}};
  for (int i = 0; i < 4; ++i)
    plan.walls.push_back({.from = corners[i], .to = corners[(i + 1) % 4], .thickness_m = 0.1});
  building::DoorPlan door{.id = "door", .hinge = {7, 9}, .latch = {8, 9}, .opens_to = building::Side::left};
  door.sign = tag.lines;
  plan.doors = {door};
  building::BuildingOptions options{.seed = 1, .robots = 1, .starts = {{{1.0, 1.0}, 0.0}}};
  auto made = building::Building::make(std::move(plan), std::move(options));
  if (made) return *std::move(made);
  fmt::print(stderr, "bench_notice: {}\n", made.error().message);
  std::exit(1);
}

struct Count {
  int all = 0;
  int noticed = 0;
  int read = 0;
  std::string missed;  ///< what was not noticed
};

/// The camera stands so far off and looks straight at the tag.
void look(building::Building& in, Tag const& tag, vision::SignFinder& finder, double away_m, double yaw_rad,
          Count& count) {
  building::Place const hangs_at(8.25, 8.95);
  building::Shift const way(std::cos(yaw_rad), std::sin(yaw_rad));
  auto const& camera = in.robot(0).settings().camera;
  building::Pose const body{hangs_at - (away_m + camera.x_m) * way, yaw_rad};
  auto const picture = develop(in.shoot_from(camera_on(body, camera), camera));
  cv::Mat const rgb(picture.height, picture.width, CV_8UC3, const_cast<std::uint8_t*>(picture.rgb.data()));
  cv::Mat bgr;
  cv::cvtColor(rgb, bgr, cv::COLOR_RGB2BGR);
  // Nothing else in the room is written.
  auto const signs = finder.find(bgr);
  auto const says_it = [&](vision::Detection const& sign) {
    return tag.number.empty() ? sign.kind.has_value() : sign.text == tag.number;
  };
  ++count.all;
  if (!signs.empty()) {
    ++count.noticed;
  } else {
    count.missed += " " + tag.lines.substr(0, tag.lines.find('\n'));
  }
  if (std::ranges::any_of(signs, says_it)) ++count.read;
}

}  // namespace

int main() {
  auto readers = apps::detect::sign_readers();
  if (!readers) {
    fmt::print(stderr, "bench_notice: {}\n", readers.error().message);
    return 1;
  }
  vision::SignFinder finder(*std::move(readers));
  fmt::print("{:>7} {:>10} {:>16} {:>9} {:>6}  {}\n", "away, m", "aside, rad", "clearness, px/m", "noticed", "read",
             "not noticed");
  constexpr double north_rad = std::numbers::pi / 2.0;
  for (double const aside_rad : asides_rad) {
    for (double const away_m : aways_m) {
      Count count;
      for (auto const& tag : tags) {
        auto const in = room_with(tag);
        look(*in, tag, finder, away_m, north_rad + aside_rad, count);
        if (aside_rad > 0.0) look(*in, tag, finder, away_m, north_rad - aside_rad, count);
      }
      double const clear =
          robot::clearness({}, {.position = {}, .range_m = away_m, .facing_rad = -north_rad}, north_rad + aside_rad);
      fmt::print("{:7.1f} {:10.1f} {:16.0f} {:5}/{:<3} {:3}/{:<2} {}\n", away_m, aside_rad, clear, count.noticed,
                 count.all, count.read, count.all, count.missed);
      std::fflush(stdout);
    }
  }
}
