#include <algorithm>
#include <cmath>
#include <numbers>
#include <ranges>

#include "dryrun/internal/picture.hpp"
#include "dryrun/missions.hpp"
#include "dryrun/words.hpp"

namespace lapwing::dryrun::internal {

namespace {

constexpr double home_radius = 9.0;
constexpr std::size_t most_legend_rows = 12;

/// 1, 2 or 5 times a power of ten, at least `least`.
double round_step(double least) {
  double const power = std::pow(10.0, std::floor(std::log10(least)));
  for (double const factor : {1.0, 2.0, 5.0})
    if (factor * power >= least * (1.0 - 1e-9)) return factor * power;
  return 10.0 * power;
}

/// Metres of the site.
struct Extent {
  geo::Ned low, high;

  void include(double north, double east) {
    low = {std::min(low.north, north), std::min(low.east, east), 0.0};
    high = {std::max(high.north, north), std::max(high.east, east), 0.0};
  }
  [[nodiscard]] double height() const { return high.north - low.north; }
  [[nodiscard]] double width() const { return high.east - low.east; }
};

/// What a map has to show: all tracks, mission items and home, the fence as far as it is near, and some room.
Extent extent_of(Subject const& subject) {
  constexpr double smallest_m = 40.0;
  constexpr double fence_share = 0.4;  // of the flight's extent
  constexpr double room_share = 0.09;
  Extent flight;
  for (auto const& vehicle : subject.record.vehicles)
    for (auto const& point : vehicle.track) flight.include(point.place_m.north, point.place_m.east);
  for (auto const& mission : missions_of(subject.record))
    for (auto const& item : mission.items)
      if (item.place_m) flight.include(item.place_m->north, item.place_m->east);
  double const reach_m = std::max(smallest_m, fence_share * std::max(flight.width(), flight.height()));
  auto extent = flight;
  for (auto const& zone : subject.fence.zones)
    for (auto const& polygon : zone.polygons)
      for (auto const& ring : polygon.rings)
        for (auto const& corner : ring)
          extent.include(std::clamp(corner.x(), flight.low.north - reach_m, flight.high.north + reach_m),
                         std::clamp(corner.y(), flight.low.east - reach_m, flight.high.east + reach_m));
  auto const room = [](double metres) { return std::max(metres * room_share, (smallest_m - metres) / 2.0); };
  double const north = room(extent.height());
  double const east = room(extent.width());
  extent.include(extent.low.north - north, extent.low.east - east);
  extent.include(extent.high.north + north, extent.high.east + east);
  return extent;
}

/// North is up, both directions in one scale, the extent in the middle of the box.
class Map {
 public:
  Map(Drawing& drawing, Subject const& subject, Box const& box)
      : out_(drawing), subject_(subject), box_(box), extent_(extent_of(subject)), labels_(box) {
    note_spots();
  }

  void draw() {
    keep_corners_free();
    out_.add(R"(<rect x="{0}" y="{1}" width="{2}" height="{3}" class="panel"/>)"
             R"(<svg x="{0}" y="{1}" width="{2}" height="{3}" viewBox="{0} {1} {2} {3}">)",
             box_.at.x, box_.at.y, box_.width, box_.height);
    draw_grid();
    draw_fence();
    draw_tracks();
    draw_home();
    for (auto const& spot : spots_) {
      if (spot.at_home) continue;
      out_.add(R"(<g class="{}"><circle cx="{}" cy="{}" r="2.8" class="item"><title>{}: {}</title></circle></g>)",
               spot.colour, spot.at.x, spot.at.y, spot.mission, spot.numbers);
    }
    draw_approach();
    draw_breaches();
    for (auto const& spot : spots_)
      labels_.write(out_, spot.at, spot.numbers, 10.0, spot.at_home ? 12.0 : 4.0, "number halo " + spot.colour);
    out_.add("</svg>");
    draw_legend();
  }

 private:
  /// Items of a mission that lie on each other.
  struct Spot {
    std::string_view mission;
    std::string colour;
    Point at;
    bool at_home = false;
    std::string numbers = {};
    int count = 0;
  };

  [[nodiscard]] Point at(double north_m, double east_m) const {
    return {box_.at.x + box_.width / 2.0 + (east_m - (extent_.low.east + extent_.high.east) / 2.0) * pixels_,
            box_.at.y + box_.height / 2.0 - (north_m - (extent_.low.north + extent_.high.north) / 2.0) * pixels_};
  }
  [[nodiscard]] Point at(geo::Ned place) const { return at(place.north, place.east); }

  void keep_corners_free() {
    auto const rows = std::min(subject_.record.vehicles.size(), most_legend_rows);
    labels_.occupy({box_.at, 130.0, 16.0 + 18.0 * static_cast<double>(rows)});
    labels_.occupy({{box_.at.x, box_.bottom() - 34.0}, 220.0, 34.0});
    labels_.occupy({{box_.right() - 40.0, box_.at.y}, 40.0, 56.0});
  }

  void note_spots() {
    constexpr double same = 7.0;
    constexpr int most_numbers = 4;
    for (auto const& mission : missions_) {
      auto const first = spots_.size();
      for (auto const& item : mission.items) {
        if (!item.place_m) continue;
        auto const place = at(*item.place_m);
        auto const is_here = [&](Spot const& spot) { return distance(spot.at, place) < same; };
        auto spot = std::find_if(spots_.begin() + static_cast<std::ptrdiff_t>(first), spots_.end(), is_here);
        if (spot == spots_.end())
          spot = spots_.insert(
              spot, {mission.name, colour_of_mission(mission), place, distance(place, at(0.0, 0.0)) < home_radius});
        if (++spot->count <= most_numbers)
          spot->numbers += fmt::format("{}{}", spot->numbers.empty() ? "" : " ", item.number);
        if (spot->count == most_numbers + 1) spot->numbers += " …";
      }
    }
  }

  static double distance(Point a, Point b) { return std::hypot(a.x - b.x, a.y - b.y); }

  /// The first vehicle that flies it gives a mission its colour.
  [[nodiscard]] std::string colour_of_mission(MissionTable const& mission) const {
    auto const& vehicles = subject_.record.vehicles;
    auto const flies = [&](auto const& one) {
      return std::ranges::count(one.tasks, mission.name, &TaskSpan::name) > 0;
    };
    return colour_of(static_cast<std::size_t>(std::ranges::find_if(vehicles, flies) - vehicles.begin()));
  }

  void draw_grid() {
    double const step = round_step(90.0 / pixels_) * pixels_;
    auto const home = at(0.0, 0.0);
    auto const begin = [&](double from, double through) { return from + std::fmod(through - from, step); };
    std::string lines;
    for (double x = begin(box_.at.x, home.x); x < box_.right(); x += step)
      lines += fmt::format("M{:.1f} {}V{}", x, box_.at.y, box_.bottom());
    for (double y = begin(box_.at.y, home.y); y < box_.bottom(); y += step)
      lines += fmt::format("M{} {:.1f}H{}", box_.at.x, y, box_.right());
    out_.add(R"(<path class="grid" d="{}"/>)", lines);
  }

  void draw_fence() {
    constexpr std::size_t most_tries = 24;
    for (auto const& zone : subject_.fence.zones) {
      bool const inside = zone.kind == plan::Zone::Kind::inclusion;
      std::vector<Line> rings;
      for (auto const& polygon : zone.polygons)
        for (auto const& ring : polygon.rings)
          for (auto& line = rings.emplace_back(); auto const& corner : ring) line.push_back(at(corner.x(), corner.y()));
      auto name = zone.name;
      if (zone.highest_m) name += fmt::format(", up to {} m", number_text(*zone.highest_m, 0));
      if (zone.lowest_m) name += fmt::format(", from {} m", number_text(*zone.lowest_m, 0));
      out_.add(R"(<path d="{}" fill-rule="evenodd" class="{}"><title>{}</title></path>)", rings,
               inside ? "inside" : "outside", name);
      // At the first corner beside which there is room.
      auto const beside = [&](Point corner) {
        return box_.contains(corner) &&
               labels_.write(out_, corner, name, 11.0, 5.0, inside ? "halo fencename" : "halo small alarm");
      };
      (void)std::ranges::any_of(rings | std::views::join | std::views::take(most_tries), beside);
    }
  }

  void draw_tracks() {
    constexpr double detail = 0.25;  // in pixels
    for (std::size_t i = 0; i < subject_.record.vehicles.size(); ++i) {
      auto const& vehicle = subject_.record.vehicles[i];
      Line line;
      for (auto const& point : vehicle.track) line.push_back(at(point.place_m));
      line = simplified(line, detail);
      out_.add(R"(<g class="{0}"><path d="{1}" class="under"/><path d="{1}" class="track"><title>{2}</title></path>)",
               colour_of(i), line, vehicle.name);
      draw_arrows(line);
      out_.add("</g>");
    }
  }

  /// Which way it goes, every so many pixels.
  void draw_arrows(Line const& line) {
    constexpr double apart = 120.0;
    constexpr double size = 5.0;
    double to_next = apart / 2.0;
    for (std::size_t i = 1; i < line.size(); ++i) {
      auto const& from = line[i - 1];
      double const x = line[i].x - from.x;
      double const y = line[i].y - from.y;
      double const length = std::hypot(x, y);
      if (length < 2.0 * size) continue;
      for (; to_next <= length - size; to_next += apart)
        out_.add(R"svg(<path d="M5 0L-5 4V-4Z" transform="translate({}) rotate({})" class="mark"/>)svg",
                 Point{from.x + x * to_next / length, from.y + y * to_next / length},
                 std::atan2(y, x) * 180.0 / std::numbers::pi);
      to_next = std::max(size, to_next - length);
    }
  }

  void draw_home() {
    auto const home = at(0.0, 0.0);
    out_.add(R"(<circle cx="{}" cy="{}" r="{}" class="ink"><title>home</title></circle>)", home.x, home.y, home_radius);
    out_.add(R"(<text x="{}" y="{}" class="onhome">H</text>)", home.x, home.y + 4.2);
    labels_.occupy({{home.x - 11.0, home.y - 11.0}, 22.0, 22.0});
  }

  void draw_approach() {
    if (subject_.analysis.pairs.empty()) return;
    auto const& approach = subject_.analysis.pairs.front().approach;
    auto const a = at(approach.first_m);
    auto const b = at(approach.second_m);
    Point const middle{(a.x + b.x) / 2.0, (a.y + b.y) / 2.0};
    double const radius = std::max(13.0, distance(a, b) / 2.0 + 6.0);
    auto const words = fmt::format("{} apart at {}", length_text(approach.distance_m), clock_text(approach.time));
    out_.add(
        R"(<path d="{}" class="alarmline"/><circle cx="{}" cy="{}" r="{}" class="alarmline" stroke-dasharray="3 2">)"
        R"(<title>closest approach: {}</title></circle>)",
        Line{a, b}, middle.x, middle.y, radius, words);
    labels_.write(out_, middle, words, 11.0, radius * 0.8, "small halo alarm");
  }

  void draw_breaches() {
    constexpr std::size_t most = 50;
    for (auto const& [vehicle, breach] : subject_.analysis.breaches | std::views::take(most)) {
      auto const place = at(breach.worst.place_m);
      out_.add(R"svg(<path d="M-6 -6L6 6M-6 6L6 -6" transform="translate({})" class="alarmline" stroke-width="3"/>)svg",
               place);
      auto const words = fmt::format("{} {}{} at {}", length_text(breach.depth_m),
                                     breach.kind == plan::Zone::Kind::inclusion ? "outside" : "inside",
                                     breach.by_height ? " in height" : "", clock_text(breach.worst.time));
      labels_.write(out_, place, words, 11.0, 7.0, "small halo alarm");
    }
  }

  /// Whose colour is whose, how long a metre is, and where north is.
  void draw_legend() {
    double y = box_.at.y + 16.0;
    for (std::size_t i = 0; i < std::min(subject_.record.vehicles.size(), most_legend_rows); ++i, y += 18.0)
      out_.add(R"(<g class="{}"><path d="M{} {}h22" class="track"/></g><text x="{}" y="{}" class="halo">{}</text>)",
               colour_of(i), box_.at.x + 12.0, y, box_.at.x + 40.0, y + 4.0, subject_.record.vehicles[i].name);
    double const metres = round_step(70.0 / pixels_);
    double const x = box_.at.x + 14.0;
    double const bottom = box_.bottom() - 14.0;
    out_.add(R"(<path d="M{} {}v5h{}v-5" class="inkline" stroke-width="1.5"/>)", x, bottom - 5.0, metres * pixels_);
    out_.add(R"(<text x="{}" y="{}" class="small halo">{}</text>)", x + metres * pixels_ + 8.0, bottom + 1.0,
             metres >= 1000.0 ? fmt::format("{:g} km", metres / 1000.0) : fmt::format("{:g} m", metres));
    out_.add(
        R"svg(<g transform="translate({} {})"><path d="M0 0L6 18L0 14L-6 18Z" class="ink"><title>north is up</title>)svg"
        R"svg(</path><text y="31" text-anchor="middle" class="small halo">N</text></g>)svg",
        box_.right() - 22.0, box_.at.y + 14.0);
  }

  Drawing& out_;
  Subject const& subject_;
  Box box_;
  Extent extent_;
  double pixels_ = std::min(box_.width / extent_.width(), box_.height / extent_.height());  ///< of a metre
  Labels labels_;
  std::vector<MissionTable> missions_ = missions_of(subject_.record);
  std::vector<Spot> spots_;
};

}  // namespace

double map_shape(Subject const& subject) {
  auto const extent = extent_of(subject);
  return extent.height() / extent.width();
}

void draw_map(Drawing& drawing, Subject const& subject, Box const& box) {
  Map(drawing, subject, box).draw();
}

}  // namespace lapwing::dryrun::internal
