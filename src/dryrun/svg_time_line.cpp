#include <algorithm>
#include <array>
#include <cmath>
#include <ranges>

#include <fmt/format.h>

#include "dryrun/internal/picture.hpp"
#include "dryrun/words.hpp"

namespace lapwing::dryrun::internal {

using base::Duration;
using base::to_seconds;

namespace {

constexpr double axis_height = 24.0;
constexpr double words_height = 40.0;  ///< for what the script said, if anything
constexpr double lane_gap = 12.0;
constexpr double name_height = 20.0;
constexpr double bar_height = 22.0;
constexpr double curve_height = 52.0;
constexpr double left_room = 46.0;
constexpr double right_room = 40.0;
/// With more vehicles only their tasks are drawn, and no more than that many of them.
constexpr std::size_t most_with_curves = 10;
constexpr std::size_t most_lanes = 60;

double words_height_of(Subject const& subject) {
  return subject.record.remarks.empty() ? 6.0 : words_height;
}

std::size_t lane_count(Subject const& subject) {
  return std::min(subject.record.vehicles.size(), most_lanes);
}

double lane_height(Subject const& subject) {
  bool const with_curves = subject.record.vehicles.size() <= most_with_curves;
  return name_height + bar_height + (with_curves ? 6.0 + curve_height : 0.0) + lane_gap;
}

bool rolls(VehicleRecord const& vehicle) {
  return !plan::flies(vehicle.family);
}

/// The curve of a vehicle: height in m, of wheels speed in m/s.
std::vector<std::pair<Duration, double>> curve_of(VehicleRecord const& vehicle) {
  std::vector<std::pair<Duration, double>> curve;
  for (std::size_t i = 0; i < vehicle.track.size(); ++i) {
    auto const& point = vehicle.track[i];
    if (!rolls(vehicle)) {
      curve.emplace_back(point.time, std::max(0.0, -point.place_m.down));
    } else if (i > 0) {
      auto const& before = vehicle.track[i - 1];
      double const way =
          std::hypot(point.place_m.north - before.place_m.north, point.place_m.east - before.place_m.east);
      curve.emplace_back(point.time, way / to_seconds(point.time - before.time));
    }
  }
  return curve;
}

class TimeLine {
 public:
  TimeLine(Canvas& canvas, Subject const& subject, Box const& box)
      : canvas_(canvas),
        subject_(subject),
        box_(box),
        left_(box.at.x + left_room),
        right_(box.right() - right_room),
        longest_s_(std::max(1.0, to_seconds(subject.record.duration))) {}

  void draw() {
    draw_remarks();
    draw_axis();
    if (subject_.record.vehicles.size() <= most_with_curves) draw_key();
    double y = box_.at.y + words_height_of(subject_);
    for (std::size_t i = 0; i < lane_count(subject_); ++i, y += lane_height(subject_)) draw_lane(i, y);
    if (auto const left_out = subject_.record.vehicles.size() - lane_count(subject_); left_out > 0)
      canvas_.words({left_, y + 4.0}, fmt::format("and {} more vehicles", left_out), "class=\"soft\"");
  }

 private:
  [[nodiscard]] double x_of(Duration time) const {
    return left_ + (right_ - left_) * std::clamp(to_seconds(time) / longest_s_, 0.0, 1.0);
  }
  [[nodiscard]] double bottom() const { return box_.bottom() - axis_height; }

  void draw_axis() {
    constexpr std::array steps_s{1.0,   2.0,   5.0,    10.0,   15.0,   30.0,    60.0,    120.0,   300.0,
                                 600.0, 900.0, 1800.0, 3600.0, 7200.0, 14400.0, 43200.0, 86400.0, 604800.0};
    auto const wide_enough = [&](double step) { return (right_ - left_) * step / longest_s_ >= 62.0; };
    auto const found = std::ranges::find_if(steps_s, wide_enough);
    double const step = found == steps_s.end() ? longest_s_ : *found;
    for (double at = 0.0; at <= longest_s_ + 1e-6; at += step) {
      double const x = x_of(base::from_seconds(at));
      canvas_.line({x, box_.at.y + words_height_of(subject_)}, {x, bottom()}, "class=\"grid\"");
      canvas_.words({x, bottom() + 15.0}, clock_text(base::from_seconds(at)),
                    "class=\"soft small\" text-anchor=\"middle\"");
    }
    canvas_.line({left_, bottom()}, {right_, bottom()}, "class=\"axis\"");
  }

  void draw_key() {
    double const y = bottom() + 32.0;
    canvas_.line({right_ - 196.0, y}, {right_ - 172.0, y}, "class=\"inkline\" stroke-width=\"1.5\"");
    canvas_.words({right_ - 167.0, y + 4.0}, "height or speed", "class=\"soft tiny\"");
    canvas_.line({right_ - 74.0, y}, {right_ - 50.0, y}, "class=\"battery\"");
    canvas_.words({right_ - 45.0, y + 4.0}, "battery", "class=\"soft tiny\"");
  }

  /// What the script said, above the lanes: as many texts as there is room for.
  void draw_remarks() {
    constexpr std::size_t most_lines = 200;
    constexpr std::string_view prefix = "Program message: ";
    std::array<double, 2> free_from{left_, left_};
    for (auto const& remark : subject_.record.remarks | std::views::take(most_lines)) {
      double const x = x_of(remark.time);
      std::string_view words = remark.text;
      if (words.starts_with(prefix)) words.remove_prefix(prefix.size());
      canvas_.line({x, box_.at.y + words_height_of(subject_) - 6.0}, {x, bottom()}, "class=\"said\"");
      auto const text = fitted(words, 11.0, 260.0);
      double const width = text_width(text, 11.0);
      double const from = std::min(x, box_.right() - width);
      auto const row = std::ranges::find_if(free_from, [&](double free) { return from >= free; });
      if (row == free_from.end() || text.empty()) continue;
      *row = from + width + 14.0;
      double const y =
          box_.at.y + words_height_of(subject_) - 10.0 - 14.0 * static_cast<double>(row - free_from.begin());
      canvas_.words({from, y}, text, "class=\"soft small\"");
    }
  }

  void draw_lane(std::size_t index, double y) {
    auto const& vehicle = subject_.record.vehicles[index];
    auto const& sums = subject_.analysis.vehicles[index];
    canvas_.open(fmt::format("class=\"{}\"", colour_of(index)));
    canvas_.words({left_, y + 14.0}, vehicle.name, "class=\"name\"");
    double const left_now = vehicle.charge.empty() ? 1.0 : static_cast<double>(vehicle.charge.back().remaining);
    auto const figures_text = fmt::format(
        "{}  ·  {} {}{}  ·  {:.2f} Wh  ·  battery {:.0f} % left", length_text(sums.path_m),
        clock_text(vehicle.under_way), rolls(vehicle) ? "in motion" : "in the air",
        rolls(vehicle) ? "" : fmt::format("  ·  up to {:.0f} m", sums.highest_m), sums.energy_wh, 100.0 * left_now);
    canvas_.words({left_ + text_width(vehicle.name, 14.0) + 14.0, y + 14.0}, figures_text, "class=\"soft small\"");
    for (auto const& span : vehicle.tasks) draw_task(span, y + name_height);
    draw_alarms(index, y + name_height);
    if (subject_.record.vehicles.size() <= most_with_curves)
      draw_curves(vehicle, {{left_, y + name_height + bar_height + 6.0}, right_ - left_, curve_height});
    canvas_.close();
  }

  void draw_task(TaskSpan const& span, double y) {
    double const from = x_of(span.begin);
    double const width = std::max(1.5, x_of(span.end) - from - 1.0);
    auto hint = fmt::format("{}: {} to {}, {}", span.name, clock_text(span.begin), clock_text(span.end),
                            to_string(span.ending));
    if (!span.reason.empty()) hint += ": " + span.reason;
    canvas_.rect({{from, y}, width, bar_height}, "class=\"bar\" rx=\"4\"", hint);
    bool const ended_well = span.ending == TaskSpan::End::done;
    double const room = width - 12.0 - (ended_well ? 0.0 : 10.0);
    auto const name = fitted(span.name, 11.5, room);
    if (!name.empty()) canvas_.words({from + 6.0, y + 15.0}, name, "class=\"onbar\"");
    if (ended_well) return;
    bool const failed = span.ending == TaskSpan::End::failed;
    canvas_.rect({{from + width - 4.0, y}, 4.0, bar_height}, failed ? "class=\"alarm\"" : "class=\"ink\"", hint);
  }

  /// When the vehicle was outside its fence, and when it was nearest to another.
  void draw_alarms(std::size_t index, double y) {
    for (auto const& [vehicle, breach] : subject_.analysis.breaches) {
      if (vehicle != index) continue;
      double const from = x_of(breach.begin);
      canvas_.rect({{from, y + bar_height + 1.0}, std::max(2.0, x_of(breach.end) - from), 4.0}, "class=\"alarm\"",
                   "outside the fence");
    }
    if (subject_.analysis.pairs.empty()) return;
    auto const& nearest = subject_.analysis.pairs.front();
    if (nearest.first != index && nearest.second != index) return;
    double const x = x_of(nearest.approach.time);
    canvas_.line({x, y - 4.0}, {x, y + lane_height(subject_) - name_height - lane_gap},
                 "class=\"alarmline\" stroke-dasharray=\"3 2\"");
    canvas_.circle({x, y - 4.0}, 3.5, "class=\"alarm\"", "closest approach between vehicles");
  }

  void draw_curves(VehicleRecord const& vehicle, Box const& box) {
    auto const curve = curve_of(vehicle);
    double highest = 0.0;
    for (auto const& [time, value] : curve) highest = std::max(highest, value);
    double const top = 1.15 * (highest > 0.05 ? highest : 1.0);
    std::vector<Point> line;
    for (auto const& [time, value] : curve) line.push_back({x_of(time), box.bottom() - value / top * box.height});
    line = simplified(line, 0.3);
    canvas_.line({box.at.x, box.bottom()}, {box.right(), box.bottom()}, "class=\"axis\"");
    if (!line.empty()) {
      auto area = line;
      area.push_back({line.back().x, box.bottom()});
      area.push_back({line.front().x, box.bottom()});
      canvas_.rings(std::array{area}, "class=\"area\"");
      canvas_.polyline(line, "class=\"curve\"", rolls(vehicle) ? "speed" : "height");
    }
    constexpr auto to_the_left = "class=\"soft tiny\" text-anchor=\"end\"";
    canvas_.words({box.at.x - 6.0, box.bottom() - highest / top * box.height + 4.0},
                  rolls(vehicle) ? fmt::format("{:.1f} m/s", highest) : fmt::format("{:.0f} m", highest), to_the_left);
    canvas_.words({box.at.x - 6.0, box.bottom()}, "0", to_the_left);
    draw_battery(vehicle, box);
  }

  void draw_battery(VehicleRecord const& vehicle, Box const& box) {
    std::vector<Point> line;
    for (std::size_t i = 0; i < vehicle.track.size(); ++i)
      line.push_back(
          {x_of(vehicle.track[i].time), box.bottom() - static_cast<double>(vehicle.charge[i].remaining) * box.height});
    canvas_.polyline(simplified(line, 0.3), "class=\"battery\"", "battery");
    if (line.empty()) return;
    double const percent = 100.0 * static_cast<double>(vehicle.charge.back().remaining);
    double const y = std::clamp(line.back().y + 4.0, box.at.y + 8.0, box.bottom());
    canvas_.words({box.right() + 6.0, y}, fmt::format("{:.0f} %", percent), "class=\"tiny\"");
  }

  Canvas& canvas_;
  Subject const& subject_;
  Box box_;
  double left_;
  double right_;
  double longest_s_;
};

}  // namespace

double time_line_height(Subject const& subject) {
  return words_height_of(subject) + lane_height(subject) * static_cast<double>(lane_count(subject)) + axis_height;
}

void draw_time_line(Canvas& canvas, Subject const& subject, Box const& box) {
  TimeLine(canvas, subject, box).draw();
}

}  // namespace lapwing::dryrun::internal
