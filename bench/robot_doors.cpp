// A robot maps a simulated building by itself and looks for name tags with the cameras at its sides, as it does in the
// verbs; what it has put on the map is held against the truth, a row a seed.
// usage: bench_robot_doors BUILDING.toml SEED... [--to PLACE] [--signs DIR]
// DIR, which is there, gets the picture of each sign that was seen; what was read in all sights of it is told.
#include <algorithm>
#include <cctype>
#include <charconv>
#include <chrono>
#include <fstream>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "host/session/session.hpp"

namespace {

using namespace lapwing;
using namespace std::chrono_literals;
namespace building = sim::building;

struct Options {
  std::string file;
  std::string to;     ///< a place to drive to before it comes home; empty: none
  std::string signs;  ///< a folder for their pictures; empty: none
  std::vector<std::uint64_t> seeds;
};

/// One run in one building.
class Trial {
 public:
  Trial(Options const& options, std::uint64_t seed)
      : options_(options), session_({.speedup = 0.0, .log_level = base::LogLevel::warn, .seed = seed}) {}

  base::Result<> run() {
    auto const anywhere = geo::Wgs84::from_degrees(41.178, -8.598, 90.0);
    if (auto added = session_.add_robots({"sim:" + options_.file}, anywhere); !added) return added;
    start_ = truth().robot(0).body().pose().position;
    auto const there = options_.to.empty() ? "" : fmt::format("driveTo '{}'; ", options_.to);
    auto const started = session_.host.start(
        "floor.dolphin", fmt::format("robot = pick {{ id 'robot1'; timeout 60.seconds }}\n"
                                     "execute robot: drive {{ name 'Floor'; explore(); {}returnToStart() }}\n",
                                     there));
    if (!started) return base::fail(base::ErrorKind::invalid_input, session_.host.rendered_diagnostics());
    session_.run_to_end(4h);
    return {};
  }

  /// `wall_s`: how long it took.
  void tell(std::uint64_t seed, double wall_s) const {
    auto const& drive = *session_.robots.robots().front()->drives().back();
    double const off_m = geo::distance_m(truth().robot(0).body().pose().position, start_);
    bool const is_home = drive.outcome == robot::DriveRecord::Outcome::done && off_m < 0.6;
    auto const walls = wall_errors();
    auto const within = std::ranges::count_if(walls, [](double error_m) { return error_m <= 0.1; });
    auto const doors = judge_doors();
    fmt::print(
        "| {} | {} | {:.3f} m | {:.3f} | {} of {} | {} | {} | {} | {} | {:.0f} m | {:.0f} s | {} | {:.0f} s | {}| {} "
        "|\n",
        seed, is_home ? "home" : "not home", walls.empty() ? 0.0 : walls[walls.size() * 95 / 100],
        walls.empty() ? 0.0 : static_cast<double>(within) / static_cast<double>(walls.size()), doors.right, doors.all,
        doors.unread, doors.misread, doors.wrong, truth().collisions().size(),
        session_.robots.robots().front()->state().motion.track_m,
        base::to_seconds(session_.loop.now().time_since_epoch()), session_.robots.tags_of({"robot1"})->pictures(),
        wall_s, doors.missing, drive.error.empty() ? drive.remark : drive.error);
    if (!options_.signs.empty()) tell_signs(seed);
    std::fflush(stdout);
  }

 private:
  struct Doors {
    int all = 0;               ///< with a sign
    int right = 0;             ///< have their number on the map
    int unread = 0;            ///< are on the map without one
    int misread = 0;           ///< have another one instead
    int wrong = 0;             ///< tags on the map that are no door's
    std::string missing = {};  ///< the numbers that are not on the map
  };

  [[nodiscard]] building::Building& truth() const { return *session_.buildings.front()->building; }
  [[nodiscard]] building::Place on_floor(map::SitePoint const& point) const {
    return session_.buildings.front()->site_from_floor.inverse() * point;
  }

  /// Of points along the walls on the map, every 5 cm, to the nearest face of the building; in order.
  [[nodiscard]] std::vector<double> wall_errors() const {
    std::vector<double> errors;
    auto const layer = map::LayerKind::walls;
    for (auto const* record : session_.live_map.within(layer, "default", std::nullopt, session_.live_map.size(layer))) {
      auto const& points = std::get<map::Wall>(record->feature.content).line.points;
      auto const from = on_floor(points.front());
      auto const to = on_floor(points.back());
      int const steps = std::max(1, static_cast<int>(geo::distance_m(from, to) / 0.05));
      for (int i = 0; i <= steps; ++i)
        errors.push_back(error_at(from + (i / static_cast<double>(steps)) * (to - from)));
    }
    std::ranges::sort(errors);
    return errors;
  }

  [[nodiscard]] double error_at(building::Place const& place) const {
    constexpr double reach_m = 1.0;
    double least_m = reach_m;
    auto const around = truth().surroundings();
    auto const look = [&](building::Face const& face) {
      least_m = std::min(least_m, geo::distance_m(nearest_point(face, place), place));
    };
    around.fixed.near(place, reach_m, look);
    std::ranges::for_each(around.moving, look);
    return least_m;
  }

  void tell_signs(std::uint64_t seed) const {
    for (auto const& tag : session_.robots.tags_of({"robot1"})->book().tags()) {
      auto const at = on_floor(tag.position);
      fmt::print("{} at {:.2f}, {:.2f}, {} sights: {}; {}; confidence {:.2f}\n", tag.number, at.x(), at.y(), tag.sights,
                 tag.names, tag.kinds, tag.confidence());
      std::ofstream(fmt::format("{}/{}-{}.jpg", options_.signs, seed, tag.number), std::ios::binary) << tag.crop;
    }
  }

  static char lower(char c) { return static_cast<char>(std::tolower(static_cast<unsigned char>(c))); }

  /// A tag is a door's that hangs within reach of its middle, on its front.
  [[nodiscard]] Doors judge_doors() const {
    constexpr double reach_m = 1.2;
    Doors doors;
    auto const layer = map::LayerKind::points_of_interest;
    auto const tags = session_.live_map.within(layer, "default", std::nullopt, session_.live_map.size(layer));
    std::vector<bool> is_a_doors(tags.size(), false);
    for (auto const& door : truth().true_doors()) {
      if (door.text.empty()) continue;
      ++doors.all;
      auto const number = door.text.substr(0, door.text.find('\n'));
      bool has_right = false;
      bool has_unread = false;
      bool has_other = false;
      for (std::size_t i = 0; i < tags.size(); ++i) {
        auto const& tag = std::get<map::PointOfInterest>(tags[i]->feature.content);
        if (geo::distance_m(on_floor(tag.position), door.middle) > reach_m) continue;
        // A sign without a number is called by its kind of room.
        bool const is_right = std::ranges::equal(tag.name, number, {}, lower, lower);
        has_right = has_right || is_right;
        has_unread = has_unread || tag.name.empty();
        has_other = has_other || (!is_right && !tag.name.empty());
        is_a_doors[i] = is_a_doors[i] || is_right || tag.name.empty();
      }
      doors.right += has_right ? 1 : 0;
      if (!has_right) doors.missing += number + " ";
      doors.misread += has_other && !has_right ? 1 : 0;
      doors.unread += has_unread && !has_other && !has_right ? 1 : 0;
    }
    doors.wrong = static_cast<int>(std::ranges::count(is_a_doors, false));
    return doors;
  }

  Options const& options_;
  host::Session session_;
  building::Place start_;
};

std::optional<Options> options_of(std::vector<std::string_view> const& words) {
  Options options;
  for (std::size_t i = 0; i < words.size(); ++i) {
    bool const has_next = i + 1 < words.size();
    std::uint64_t seed = 0;
    if (words[i] == "--to" && has_next) {
      options.to = words[++i];
    } else if (words[i] == "--signs" && has_next) {
      options.signs = words[++i];
    } else if (options.file.empty()) {
      options.file = words[i];
    } else if (std::from_chars(words[i].data(), words[i].data() + words[i].size(), seed).ec == std::errc()) {
      options.seeds.push_back(seed);
    } else {
      return std::nullopt;
    }
  }
  return options.seeds.empty() ? std::nullopt : std::optional(std::move(options));
}

}  // namespace

int main(int argc, char** argv) {
  auto const options = options_of({argv + 1, argv + argc});
  if (!options) {
    fmt::print(stderr, "usage: bench_robot_doors BUILDING.toml SEED... [--to PLACE] [--signs DIR]\n");
    return 2;
  }
  fmt::print(
      "| seed | end | walls p95 | within 0.1 m | doors right | unread | misread | wrong | collisions | travel | "
      "in | pictures | took "
      "| said |\n");
  fmt::print("|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|\n");
  for (auto const seed : options->seeds) {
    auto const began = std::chrono::steady_clock::now();
    Trial trial(*options, seed);
    if (auto const ran = trial.run(); !ran) {
      fmt::print(stderr, "{}\n", ran.error().message);
      return 1;
    }
    trial.tell(seed, std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count());
  }
  return 0;
}
