#include <algorithm>
#include <array>
#include <cmath>
#include <ranges>

#include "dryrun/internal/picture.hpp"
#include "dryrun/words.hpp"

namespace lapwing::dryrun::internal {

using base::Duration;
using base::to_seconds;

namespace {

constexpr double axis_height = 24.0;
constexpr double lane_gap = 12.0;
constexpr double name_height = 20.0;
constexpr double bar_height = 22.0;
constexpr double curve_height = 52.0;
/// With more vehicles only their tasks are drawn, and no more than that many of them.
constexpr std::size_t most_with_curves = 10;
constexpr std::size_t most_lanes = 60;

bool has_curves(Subject const& subject) {
  return subject.record.vehicles.size() <= most_with_curves;
}

/// Room for what the script said, if anything.
double words_height(Subject const& subject) {
  return subject.record.remarks.empty() ? 6.0 : 40.0;
}

double lane_height(Subject const& subject) {
  return name_height + bar_height + (has_curves(subject) ? 6.0 + curve_height : 0.0) + lane_gap;
}

bool rolls(VehicleRecord const& vehicle) {
  return !plan::flies(vehicle.family);
}

/// Height in m, of wheels speed in m/s, at that point of the track.
double curve_value(VehicleRecord const& vehicle, std::size_t i) {
  auto const& point = vehicle.track[i];
  if (!rolls(vehicle)) return std::max(0.0, -point.place_m.down);
  auto const& before = vehicle.track[i == 0 ? 0 : i - 1];
  auto const& after = vehicle.track[i == 0 ? std::min<std::size_t>(1, vehicle.track.size() - 1) : i];
  double const way = std::hypot(after.place_m.north - before.place_m.north, after.place_m.east - before.place_m.east);
  return way > 0.0 ? way / to_seconds(after.time - before.time) : 0.0;
}

class TimeLine {
 public:
  TimeLine(Drawing& drawing, Subject const& subject, Box const& box) : out_(drawing), subject_(subject), box_(box) {}

  void draw() {
    draw_remarks();
    draw_axis();
    auto const& vehicles = subject_.record.vehicles;
    double y = top_;
    for (std::size_t i = 0; i < std::min(vehicles.size(), most_lanes); ++i, y += lane_height(subject_)) draw_lane(i, y);
    if (vehicles.size() > most_lanes)
      out_.add(R"(<text x="{}" y="{}" class="soft">and {} more vehicles</text>)", left_, y + 4.0,
               vehicles.size() - most_lanes);
  }

 private:
  [[nodiscard]] double x_of(Duration time) const {
    return left_ + (right_ - left_) * std::clamp(to_seconds(time) / longest_s_, 0.0, 1.0);
  }

  void draw_axis() {
    constexpr std::array steps_s{1.0,   2.0,   5.0,    10.0,   15.0,   30.0,    60.0,    120.0,   300.0,
                                 600.0, 900.0, 1800.0, 3600.0, 7200.0, 14400.0, 43200.0, 86400.0, 604800.0};
    auto const is_wide_enough = [&](double step) { return (right_ - left_) * step / longest_s_ >= 62.0; };
    auto const found = std::ranges::find_if(steps_s, is_wide_enough);
    double const step = found == steps_s.end() ? longest_s_ : *found;
    for (double at = 0.0; at <= longest_s_ + 1e-6; at += step) {
      auto const time = base::from_seconds(at);
      out_.add(
          R"(<path d="M{0} {1}V{2}" class="grid"/><text x="{0}" y="{3}" class="soft small" text-anchor="middle">{4}</text>)",
          x_of(time), top_, bottom_, bottom_ + 15.0, clock_text(time));
    }
    out_.add(R"(<path d="M{} {}H{}" class="axis"/>)", left_, bottom_, right_);
    if (!has_curves(subject_)) return;
    out_.add(R"svg(<g transform="translate({} {})"><path d="M-196 0h24" class="inkline" stroke-width="1.5"/>)svg"
             R"(<text x="-167" y="4" class="soft tiny">height or speed</text><path d="M-74 0h24" class="battery"/>)"
             R"(<text x="-45" y="4" class="soft tiny">battery</text></g>)",
             right_, bottom_ + 32.0);
  }

  /// What the script said, above the lanes: as many texts as there is room for in two rows.
  void draw_remarks() {
    constexpr std::size_t most_lines = 200;
    constexpr std::string_view prefix = "Program message: ";
    std::array<double, 2> free_from{left_, left_};
    for (auto const& remark : subject_.record.remarks | std::views::take(most_lines)) {
      double const x = x_of(remark.time);
      out_.add(R"(<path d="M{} {}V{}" class="said"/>)", x, top_ - 6.0, bottom_);
      std::string_view words = remark.text;
      if (words.starts_with(prefix)) words.remove_prefix(prefix.size());
      auto const text = fitted(words, 11.0, 260.0);
      double const width = text_width(text, 11.0);
      double const from = std::min(x, box_.right() - width);
      auto const row = std::ranges::find_if(free_from, [&](double free) { return from >= free; });
      if (row == free_from.end() || text.empty()) continue;
      *row = from + width + 14.0;
      out_.add(R"(<text x="{}" y="{}" class="soft small">{}</text>)", from,
               top_ - 10.0 - 14.0 * static_cast<double>(row - free_from.begin()), text);
    }
  }

  void draw_lane(std::size_t index, double y) {
    auto const& vehicle = subject_.record.vehicles[index];
    auto const& sums = subject_.analysis.vehicles[index];
    double const charge = vehicle.charge.empty() ? 1.0 : static_cast<double>(vehicle.charge.back().remaining);
    auto const figures = fmt::format("{}  ·  {} {}{}  ·  {:.2f} Wh  ·  battery {:.0f} % left", length_text(sums.path_m),
                                     clock_text(vehicle.under_way), rolls(vehicle) ? "in motion" : "in the air",
                                     rolls(vehicle) ? "" : fmt::format("  ·  up to {:.0f} m", sums.highest_m),
                                     sums.energy_wh, 100.0 * charge);
    out_.add(
        R"(<g class="{}"><text x="{}" y="{}" class="name">{}</text><text x="{}" y="{}" class="soft small">{}</text>)",
        colour_of(index), left_, y + 14.0, vehicle.name, left_ + text_width(vehicle.name, 14.0) + 14.0, y + 14.0,
        figures);
    for (auto const& span : vehicle.tasks) draw_task(span, y + name_height);
    draw_alarms(index, y + name_height);
    if (has_curves(subject_)) draw_curves(vehicle, y + lane_height(subject_) - lane_gap);
    out_.add("</g>");
  }

  void draw_task(TaskSpan const& span, double y) {
    double const from = x_of(span.begin);
    double const width = std::max(1.5, x_of(span.end) - from - 1.0);
    out_.add(R"(<g><title>{}: {} to {}, {}{}{}</title><rect x="{}" y="{}" width="{}" height="{}" class="bar" rx="4"/>)",
             span.name, clock_text(span.begin), clock_text(span.end), to_string(span.ending),
             span.reason.empty() ? "" : ": ", span.reason, from, y, width, bar_height);
    bool const ended_well = span.ending == TaskSpan::End::done;
    auto const name = fitted(span.name, 11.5, width - (ended_well ? 12.0 : 22.0));
    if (!name.empty()) out_.add(R"(<text x="{}" y="{}" class="onbar">{}</text>)", from + 6.0, y + 15.0, name);
    if (!ended_well)
      out_.add(R"(<path d="M{} {}h4v{}h-4Z" class="{}"/>)", from + width - 4.0, y, bar_height,
               span.ending == TaskSpan::End::failed ? "alarm" : "ink");
    out_.add("</g>");
  }

  /// When the vehicle was outside its fence, and when it was nearest to another.
  void draw_alarms(std::size_t index, double y) {
    for (auto const& [vehicle, breach] : subject_.analysis.breaches) {
      if (vehicle != index) continue;
      double const from = x_of(breach.begin);
      out_.add(R"(<rect x="{}" y="{}" width="{}" height="4" class="alarm"><title>outside the fence</title></rect>)",
               from, y + bar_height + 1.0, std::max(2.0, x_of(breach.end) - from));
    }
    if (subject_.analysis.pairs.empty()) return;
    auto const& nearest = subject_.analysis.pairs.front();
    if (nearest.first != index && nearest.second != index) return;
    out_.add(
        R"(<path d="M{0} {1}v{2}" class="alarmline" stroke-dasharray="3 2"/><circle cx="{0}" cy="{1}" r="3.5" class="alarm">)"
        R"(<title>closest approach between vehicles</title></circle>)",
        x_of(nearest.approach.time), y - 4.0, lane_height(subject_) - name_height - lane_gap + 4.0);
  }

  void draw_curves(VehicleRecord const& vehicle, double bottom) {
    constexpr double detail = 0.3;  // in pixels
    out_.add(R"(<path d="M{} {}H{}" class="axis"/>)", left_, bottom, right_);
    if (vehicle.track.empty()) return;
    double highest = 0.0;
    for (std::size_t i = 0; i < vehicle.track.size(); ++i) highest = std::max(highest, curve_value(vehicle, i));
    double const scale = curve_height / (1.15 * (highest > 0.05 ? highest : 1.0));
    Line curve;
    Line battery;
    for (std::size_t i = 0; i < vehicle.track.size(); ++i) {
      double const x = x_of(vehicle.track[i].time);
      curve.push_back({x, bottom - curve_value(vehicle, i) * scale});
      battery.push_back({x, bottom - static_cast<double>(vehicle.charge[i].remaining) * curve_height});
    }
    curve = simplified(curve, detail);
    out_.add(R"(<path d="{0}V{1}H{2}Z" class="area"/><path d="{0}" class="curve"><title>{3}</title></path>)", curve,
             bottom, curve.front().x, rolls(vehicle) ? "speed" : "height");
    out_.add(R"(<g class="soft tiny" text-anchor="end"><text x="{0}" y="{1}" class="soft">{2}</text>)"
             R"(<text x="{0}" y="{3}" class="soft">0</text></g>)",
             left_ - 6.0, bottom - highest * scale + 4.0,
             rolls(vehicle) ? fmt::format("{:.1f} m/s", highest) : fmt::format("{:.0f} m", highest), bottom);
    out_.add(R"(<path d="{}" class="battery"><title>battery</title></path><text x="{}" y="{}" class="tiny">{}</text>)",
             simplified(battery, detail), right_ + 6.0,
             std::clamp(battery.back().y + 4.0, bottom - curve_height + 8.0, bottom),
             fmt::format("{:.0f} %", 100.0 * static_cast<double>(vehicle.charge.back().remaining)));
  }

  Drawing& out_;
  Subject const& subject_;
  Box box_;
  double left_ = box_.at.x + 46.0;
  double right_ = box_.right() - 40.0;
  double top_ = box_.at.y + words_height(subject_);  ///< of the lanes
  double bottom_ = box_.bottom() - axis_height;
  double longest_s_ = std::max(1.0, to_seconds(subject_.record.duration));
};

}  // namespace

double time_line_height(Subject const& subject) {
  auto const lanes = std::min(subject.record.vehicles.size(), most_lanes);
  return words_height(subject) + lane_height(subject) * static_cast<double>(lanes) + axis_height;
}

void draw_time_line(Drawing& drawing, Subject const& subject, Box const& box) {
  TimeLine(drawing, subject, box).draw();
}

}  // namespace lapwing::dryrun::internal
