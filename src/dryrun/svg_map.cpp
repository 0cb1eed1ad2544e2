#include <algorithm>
#include <array>
#include <cmath>
#include <ranges>

#include <fmt/format.h>

#include "dryrun/internal/labels.hpp"
#include "dryrun/internal/map_frame.hpp"
#include "dryrun/missions.hpp"
#include "dryrun/words.hpp"

namespace lapwing::dryrun::internal {

namespace {

/// Finer detail than this, in pixels, is left out of tracks.
constexpr double detail = 0.25;
constexpr double home_radius = 9.0;

std::string classes(std::string_view names, std::size_t vehicle) {
  return fmt::format("class=\"{} {}\"", names, colour_of(vehicle));
}

class Map {
 public:
  Map(Canvas& canvas, Subject const& subject, Box const& box)
      : canvas_(canvas),
        subject_(subject),
        box_(box),
        frame_(extent_of(subject), box),
        labels_(box),
        missions_(missions_of(subject.record)) {}

  void draw() {
    canvas_.raw("<clipPath id=\"map\">");
    canvas_.rect(box_, "");
    canvas_.raw("</clipPath>\n");
    canvas_.rect(box_, "class=\"panel\"");
    canvas_.open("clip-path=\"url(#map)\"");
    keep_corners_free();
    draw_grid();
    draw_fence();
    draw_tracks();
    draw_home();
    draw_item_marks();
    draw_approach();
    draw_breaches();
    draw_item_numbers();
    canvas_.close();
    draw_legend();
    draw_scale();
    draw_north();
  }

 private:
  [[nodiscard]] FlightRecord const& record() const { return subject_.record; }

  void keep_corners_free() {
    labels_.occupy({box_.at, 130.0, 16.0 + 18.0 * static_cast<double>(legend_rows())});
    labels_.occupy({{box_.at.x, box_.bottom() - 34.0}, 220.0, 34.0});
    labels_.occupy({{box_.right() - 40.0, box_.at.y}, 40.0, 56.0});
  }

  void draw_grid() {
    auto const shown = frame_.shown();
    double const step = round_step(90.0 / frame_.pixels_per_m());
    for (double north = std::ceil(shown.south / step) * step; north < shown.north; north += step)
      canvas_.line(frame_.at(north, shown.west), frame_.at(north, shown.east), "class=\"grid\"");
    for (double east = std::ceil(shown.west / step) * step; east < shown.east; east += step)
      canvas_.line(frame_.at(shown.south, east), frame_.at(shown.north, east), "class=\"grid\"");
  }

  void draw_fence() {
    for (auto const& zone : subject_.fence.zones) {
      bool const inside = zone.kind == plan::Zone::Kind::inclusion;
      std::vector<std::vector<Point>> rings;
      for (auto const& polygon : zone.polygons) {
        for (auto const& ring : polygon.rings) {
          rings.emplace_back();
          for (auto const& corner : ring) rings.back().push_back(frame_.at(corner.north_m, corner.east_m));
        }
      }
      auto name = zone.name;
      if (zone.highest_m) name += fmt::format(", up to {} m", number_text(*zone.highest_m, 0));
      if (zone.lowest_m) name += fmt::format(", from {} m", number_text(*zone.lowest_m, 0));
      canvas_.rings(rings, inside ? "class=\"inside\"" : "class=\"outside\"", name);
      name_zone(rings, name, inside);
    }
  }

  /// At the first corner beside which there is room.
  void name_zone(std::vector<std::vector<Point>> const& rings, std::string const& name, bool inside) {
    constexpr std::size_t most_tries = 24;
    std::size_t tries = 0;
    for (auto const& ring : rings) {
      for (auto const& corner : ring) {
        if (++tries > most_tries) return;
        if (!box_.contains(corner)) continue;
        auto const at = labels_.place(corner, name, 11.0, 5.0);
        if (!at) continue;
        canvas_.words(*at, name, inside ? "class=\"halo fencename\"" : "class=\"halo small alarm\"");
        return;
      }
    }
  }

  void draw_tracks() {
    for (std::size_t i = 0; i < record().vehicles.size(); ++i) {
      auto const& vehicle = record().vehicles[i];
      std::vector<Point> line;
      for (auto const& point : vehicle.track) line.push_back(frame_.at(point.place_m));
      line = simplified(line, detail);
      canvas_.polyline(line, "class=\"under\"");
      canvas_.polyline(line, classes("track", i), vehicle.name);
      draw_arrows(line, i);
    }
  }

  /// Which way it goes, every so many pixels.
  void draw_arrows(std::vector<Point> const& line, std::size_t vehicle) {
    constexpr double apart = 120.0;
    constexpr double size = 5.0;
    double to_next = apart / 2.0;
    for (std::size_t i = 1; i < line.size(); ++i) {
      double const x = line[i].x - line[i - 1].x;
      double const y = line[i].y - line[i - 1].y;
      double const length = std::hypot(x, y);
      if (length < 2.0 * size) continue;
      double along = to_next;
      for (; along <= length - size; along += apart) {
        Point const at{line[i - 1].x + x * along / length, line[i - 1].y + y * along / length};
        double const ux = x / length * size;
        double const uy = y / length * size;
        std::array const triangle{std::vector{Point{at.x + ux, at.y + uy},
                                              Point{at.x - ux - uy * 0.8, at.y - uy + ux * 0.8},
                                              Point{at.x - ux + uy * 0.8, at.y - uy - ux * 0.8}}};
        canvas_.rings(triangle, classes("mark", vehicle));
      }
      to_next = std::max(size, along - length);
    }
  }

  void draw_home() {
    auto const at = frame_.at(0.0, 0.0);
    canvas_.circle(at, home_radius, "class=\"ink\"", "home");
    canvas_.words({at.x, at.y + 4.2}, "H",
                  "text-anchor=\"middle\" style=\"fill:var(--panel);font-size:12px;font-weight:700\"");
    labels_.occupy({{at.x - 11.0, at.y - 11.0}, 22.0, 22.0});
  }

  /// Items of a mission that lie on each other.
  struct Spot {
    Point at;
    std::string numbers;
    int count = 0;
  };

  [[nodiscard]] std::vector<Spot> spots_of(MissionTable const& mission) const {
    constexpr double same = 7.0;
    constexpr int most_numbers = 4;
    std::vector<Spot> spots;
    for (auto const& item : mission.items) {
      if (!item.place_m) continue;
      auto const at = frame_.at(*item.place_m);
      auto const near = [&](Spot const& spot) { return std::hypot(spot.at.x - at.x, spot.at.y - at.y) < same; };
      auto spot = std::ranges::find_if(spots, near);
      if (spot == spots.end()) spot = spots.insert(spots.end(), Spot{at, {}, 0});
      if (++spot->count <= most_numbers)
        spot->numbers += fmt::format("{}{}", spot->numbers.empty() ? "" : " ", item.number);
      if (spot->count == most_numbers + 1) spot->numbers += " …";
    }
    return spots;
  }

  /// The first vehicle that flies it gives a mission its colour.
  [[nodiscard]] std::size_t colour_of_mission(MissionTable const& mission) const {
    auto const vehicle = std::ranges::find_if(record().vehicles, [&](VehicleRecord const& one) {
      return std::ranges::count(one.tasks, mission.name, &TaskSpan::name) > 0;
    });
    return static_cast<std::size_t>(vehicle - record().vehicles.begin());
  }
  [[nodiscard]] bool at_home(Point at) const {
    auto const home = frame_.at(0.0, 0.0);
    return std::hypot(at.x - home.x, at.y - home.y) < home_radius;
  }

  void draw_item_marks() {
    for (auto const& mission : missions_) {
      for (auto const& spot : spots_of(mission)) {
        if (at_home(spot.at)) continue;
        canvas_.circle(spot.at, 2.8, classes("item", colour_of_mission(mission)),
                       fmt::format("{}: {}", mission.name, spot.numbers));
      }
    }
  }

  void draw_item_numbers() {
    for (auto const& mission : missions_) {
      for (auto const& spot : spots_of(mission)) {
        auto const at = labels_.place(spot.at, spot.numbers, 10.0, at_home(spot.at) ? 12.0 : 4.0);
        if (at) canvas_.words(*at, spot.numbers, classes("number halo", colour_of_mission(mission)));
      }
    }
  }

  void draw_approach() {
    if (subject_.analysis.pairs.empty()) return;
    auto const& approach = subject_.analysis.pairs.front().approach;
    auto const a = frame_.at(approach.first_m);
    auto const b = frame_.at(approach.second_m);
    Point const middle{(a.x + b.x) / 2.0, (a.y + b.y) / 2.0};
    double const radius = std::max(13.0, std::hypot(a.x - b.x, a.y - b.y) / 2.0 + 6.0);
    auto const words = fmt::format("{} apart at {}", length_text(approach.distance_m), clock_text(approach.time));
    canvas_.line(a, b, "class=\"alarmline\"");
    canvas_.circle(middle, radius, "class=\"alarmline\" stroke-dasharray=\"3 2\"", "closest approach: " + words);
    if (auto const at = labels_.place(middle, words, 11.0, radius * 0.8))
      canvas_.words(*at, words, "class=\"small halo alarm\"");
  }

  void draw_breaches() {
    constexpr std::size_t most = 50;
    for (auto const& [vehicle, breach] : subject_.analysis.breaches | std::views::take(most)) {
      auto const at = frame_.at(breach.worst.place_m);
      constexpr double arm = 6.0;
      canvas_.line({at.x - arm, at.y - arm}, {at.x + arm, at.y + arm}, "class=\"alarmline\" stroke-width=\"3\"");
      canvas_.line({at.x - arm, at.y + arm}, {at.x + arm, at.y - arm}, "class=\"alarmline\" stroke-width=\"3\"");
      auto const words = fmt::format("{} {}{} at {}", length_text(breach.depth_m),
                                     breach.kind == plan::Zone::Kind::inclusion ? "outside" : "inside",
                                     breach.by_height ? " in height" : "", clock_text(breach.worst.time));
      if (auto const place = labels_.place(at, words, 11.0, 7.0))
        canvas_.words(*place, words, "class=\"small halo alarm\"");
    }
  }

  [[nodiscard]] std::size_t legend_rows() const { return std::min<std::size_t>(record().vehicles.size(), 12); }

  void draw_legend() {
    double y = box_.at.y + 20.0;
    for (std::size_t i = 0; i < legend_rows(); ++i, y += 18.0) {
      canvas_.line({box_.at.x + 12.0, y - 4.0}, {box_.at.x + 34.0, y - 4.0}, classes("track", i));
      canvas_.words({box_.at.x + 40.0, y}, record().vehicles[i].name, "class=\"halo\"");
    }
  }

  void draw_scale() {
    double const metres = round_step(70.0 / frame_.pixels_per_m());
    double const pixels = metres * frame_.pixels_per_m();
    double const x = box_.at.x + 14.0;
    double const y = box_.bottom() - 14.0;
    std::array const bar{Point{x, y - 5.0}, Point{x, y}, Point{x + pixels, y}, Point{x + pixels, y - 5.0}};
    canvas_.polyline(bar, "class=\"inkline\" stroke-width=\"1.5\"");
    canvas_.words({x + pixels + 8.0, y + 1.0},
                  metres >= 1000.0 ? fmt::format("{:g} km", metres / 1000.0) : fmt::format("{:g} m", metres),
                  "class=\"small halo\"");
  }

  void draw_north() {
    double const x = box_.right() - 22.0;
    double const y = box_.at.y + 14.0;
    std::array const needle{
        std::vector{Point{x, y}, Point{x + 6.0, y + 18.0}, Point{x, y + 14.0}, Point{x - 6.0, y + 18.0}}};
    canvas_.rings(needle, "class=\"ink\"", "north is up");
    canvas_.words({x, y + 31.0}, "N", "text-anchor=\"middle\" class=\"small halo\"");
  }

  Canvas& canvas_;
  Subject const& subject_;
  Box box_;
  MapFrame frame_;
  Labels labels_;
  std::vector<MissionTable> missions_;
};

}  // namespace

double map_shape(Subject const& subject) {
  auto const extent = extent_of(subject);
  return extent.height() / extent.width();
}

void draw_map(Canvas& canvas, Subject const& subject, Box const& box) {
  Map(canvas, subject, box).draw();
}

}  // namespace lapwing::dryrun::internal
