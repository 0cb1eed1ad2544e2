#include "plan/estimate.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include <fmt/format.h>

#include "plan/paper_motion.hpp"

namespace lapwing::plan {
namespace {

using mavlink::MavCmd;
using mavlink::MissionItem;

/// Flies a mission on paper.
class PaperFlight {
 public:
  PaperFlight(Mission const& mission, std::optional<geo::Wgs84> start, Performance const& performance,
              double heading_rad)
      : mission_(mission),
        at_(start          ? start
            : mission.home ? mission.home
                           : mission.planned_home),
        home_(mission.home ? mission.home : at_),
        performance_(performance),
        curves_(performance, heading_rad),
        frame_(at_.value_or(geo::Wgs84{})) {}

  Estimate fly() {
    // Jumps inside jumps multiply: what is longer than this is endless to any vehicle.
    int constexpr most_items = 1'000'000;
    double constexpr longest_s = 1e7;
    int flown = 0;
    while (next_ < mission_.items.size() && !is_endless_) {
      if (++flown > most_items || time_s_ > longest_s) is_endless_ = true;
      auto const& item = mission_.items[next_++];
      if (has_position(item) && !at_) start_at(place_for(item));
      if (!perform(item) && has_position(item)) {
        go_to(place_for(item), passes());
        time_s_ += circles() ? 0.0 : std::max(0.0F, item.params[0]);
      }
    }
    return {.path_m = path_m_, .duration = base::from_seconds(std::min(time_s_, 1e9)), .is_endless = is_endless_};
  }

 private:
  [[nodiscard]] bool circles() const { return performance_.turn_rate_rad_s > 0.0; }

  void start_at(geo::Wgs84 place) {
    at_ = place;
    if (!home_) home_ = place;
    frame_ = geo::LocalFrame(place);
  }

  /// The way goes on behind the item that is being flown, so there is no need to stop at it.
  [[nodiscard]] bool passes() const {
    if (mission_.items[next_ - 1].params[0] > 0.0F) return false;
    for (auto i = next_; i < mission_.items.size(); ++i) {
      auto const command = mission_.items[i].command;
      if (command == MavCmd::nav_waypoint || command == MavCmd::nav_spline_waypoint) return true;
      if (command == MavCmd::do_jump || has_position(mission_.items[i]) || command == MavCmd::nav_return_to_launch)
        return false;
    }
    return false;
  }

  void go_to(geo::Wgs84 place, bool passing) {
    if (!performance_.flies) place.alt_m = at_->alt_m;
    if (circles()) return curve_to(place, performance_.waypoint_radius_m);
    double const level_m = geo::surface_distance_m(*at_, place);
    double const up_m = place.alt_m - at_->alt_m;
    double const level_s = leg_time(place, level_m, passing);
    double const vertical_s = vertical_time_s(up_m, performance_);
    // Both ways begin together; what takes longer goes on alone.
    double const both_s = performance_.is_detailed() ? std::min(level_s, vertical_s) : std::max(level_s, vertical_s);
    double const level_share = level_s > 0.0 ? std::min(1.0, both_s / level_s) : 0.0;
    double const up_share = vertical_s > 0.0 ? std::min(1.0, both_s / vertical_s) : 0.0;
    path_m_ += std::hypot(level_share * level_m, up_share * up_m) + (1.0 - level_share) * level_m +
               (1.0 - up_share) * std::abs(up_m);
    time_s_ += std::max(level_s, vertical_s);
    at_ = place;
  }

  double leg_time(geo::Wgs84 place, double level_m, bool passing) {
    if (level_m < performance_.waypoint_radius_m) return 0.0;
    double const course_rad = geo::bearing_rad(*at_, place);
    double const turn_rad = course_rad_ ? std::abs(geo::wrap_pi(course_rad - *course_rad_)) : 0.0;
    double const entry_m_s = left_with_m_s_ * std::cos(turn_rad);
    swing_out(left_with_m_s_ * std::sin(turn_rad));
    left_with_m_s_ = passing ? performance_.pass_share * performance_.cruise_m_s : 0.0;
    course_rad_ = course_rad;
    return performance_.pivot_s_per_rad * turn_rad +
           leg_time_s(level_m - performance_.waypoint_radius_m, entry_m_s, left_with_m_s_, performance_);
  }

  /// What slides past a corner comes back.
  void swing_out(double sideways_m_s) {
    if (performance_.accel_m_s2 <= 0.0 || performance_.pivot_s_per_rad > 0.0) return;
    path_m_ += sideways_m_s * sideways_m_s / (2.0 * performance_.accel_m_s2);
    time_s_ += 0.5 * sideways_m_s / performance_.accel_m_s2;
  }

  void curve_to(geo::Wgs84 place, double radius_m) {
    auto goal = frame_.ned_from({place.lat_rad, place.lon_rad, frame_.anchor().alt_m});
    auto const leg = curves_.go_to(goal, radius_m);
    double const up_m = place.alt_m - at_->alt_m;
    double const climbed_m =
        std::clamp(up_m, -performance_.descent_m_s * leg.time_s, performance_.climb_m_s * leg.time_s);
    move_on(leg, climbed_m);
  }

  /// A wing has flown a stretch.
  void move_on(LegFlown const& leg, double up_m) {
    double const alt_m = at_->alt_m + up_m;
    time_s_ += leg.time_s;
    path_m_ += std::hypot(leg.path_m, up_m);
    at_ = frame_.place_at({curves_.place().north, curves_.place().east, 0.0});
    at_->alt_m = alt_m;
  }

  [[nodiscard]] geo::Wgs84 place_for(MissionItem const& item) const {
    return place_of(item, at_, home_ ? home_->alt_m : 0.0);
  }

  /// False when the item is nothing but a place to go to.
  bool perform(MissionItem const& item) {
    // Items of plan files may leave a parameter open (NaN) or say "as it was" (-1).
    double const first = item.params[0] > 0.0F ? item.params[0] : 0.0;
    double const third = std::isfinite(item.params[2]) ? item.params[2] : 0.0;
    switch (item.command) {
      case MavCmd::nav_takeoff: return take_off(place_for(item));
      case MavCmd::nav_land: return land(place_for(item));
      case MavCmd::nav_return_to_launch: return_home(); return true;
      case MavCmd::nav_loiter_unlim:
        go_to(place_for(item), false);
        is_endless_ = true;
        return true;
      case MavCmd::nav_loiter_turns: circle(place_for(item), first, third); return true;
      case MavCmd::nav_loiter_time: stay(place_for(item), first); return true;
      case MavCmd::nav_delay: time_s_ += first; return true;
      case MavCmd::do_set_home: home_ = place_for(item); return true;
      case MavCmd::do_change_altitude: change_altitude(item); return true;
      case MavCmd::do_change_speed: change_speed(static_cast<int>(std::min(first, 4.0)), item.params[1]); return true;
      case MavCmd::do_jump: jump(static_cast<std::size_t>(first), static_cast<int>(item.params[1])); return true;
      default: return false;
    }
  }

  /// Straight up from where it is; a wing along its nose.
  bool take_off(geo::Wgs84 place) {
    if (!performance_.is_detailed()) return false;
    if (!performance_.flies) return true;
    double const up_m = std::max(0.0, place.alt_m - at_->alt_m);
    time_s_ += performance_.spool_up_s;
    if (circles()) {
      move_on(curves_.straight(up_m / performance_.climb_m_s), up_m);
      return true;
    }
    time_s_ += vertical_time_s(up_m, performance_);
    path_m_ += up_m;
    at_->alt_m += up_m;
    return true;
  }

  bool land(geo::Wgs84 place) {
    if (!performance_.is_detailed()) return false;
    if (!performance_.flies) return true;
    double const height_m = std::max(0.0, at_->alt_m - place.alt_m);
    double const slow_m = std::min(height_m, performance_.landing_below_m);
    double const last_s = slow_m / performance_.landing_m_s + performance_.touch_down_s;
    if (circles()) {
      glide_to(place, height_m - slow_m);
    } else {
      go_to({place.lat_rad, place.lon_rad, at_->alt_m}, false);
      time_s_ += (height_m - slow_m) / performance_.descent_m_s;
      path_m_ += height_m - slow_m;
    }
    time_s_ += last_s;
    path_m_ += slow_m;
    at_ = place;
    return true;
  }

  /// A wing sinks all the way there, slower than it cruises.
  void glide_to(geo::Wgs84 place, double sunk_m) {
    constexpr double approach_share = 0.6;
    double const level_m = geo::surface_distance_m(*at_, place);
    double const glide_s =
        std::max(level_m / (approach_share * performance_.cruise_m_s), sunk_m / performance_.descent_m_s);
    time_s_ += glide_s;
    path_m_ += std::hypot(glide_s * approach_share * performance_.cruise_m_s, sunk_m);
  }

  void return_home() {
    if (!performance_.is_detailed() || !home_) return;
    if (circles()) {  // here a wing leaves its mission for the mode RTL, in which it would circle for ever
      next_ = mission_.items.size();
      return;
    }
    double const alt_m = std::max(at_->alt_m, home_->alt_m + performance_.return_height_m);
    if (performance_.flies) go_to({at_->lat_rad, at_->lon_rad, alt_m}, false);
    go_to({home_->lat_rad, home_->lon_rad, alt_m}, false);
    time_s_ += performance_.return_wait_s;
    (void)land(*home_);
  }

  void stay(geo::Wgs84 place, double seconds) {
    if (!circles()) {
      go_to(place, false);
      time_s_ += seconds;
      return;
    }
    curve_to(place, 1.2 * performance_.circle_radius_m);
    time_s_ += seconds;
    path_m_ += seconds * performance_.cruise_m_s;
  }

  void circle(geo::Wgs84 place, double turns, double wanted_radius_m) {
    double const radius_m = std::abs(wanted_radius_m != 0.0 ? wanted_radius_m : performance_.circle_radius_m);
    if (circles()) {
      curve_to(place, 1.2 * radius_m);
    } else {
      go_to(place, false);
    }
    double speed_m_s = performance_.cruise_m_s;
    if (performance_.circle_accel_m_s2 > 0.0)
      speed_m_s = std::min(speed_m_s, std::sqrt(performance_.circle_accel_m_s2 * std::max(1.0, radius_m)));
    double const length_m = turns * 2.0 * std::numbers::pi * radius_m;
    path_m_ += length_m;
    time_s_ += length_m / speed_m_s;
  }

  void change_altitude(MissionItem const& change) {
    auto const frame = frame_of_change(change);
    if (!at_ || !performance_.flies || !frame) return;
    bool const is_above_sea = *frame == mavlink::MavFrame::global || *frame == mavlink::MavFrame::global_int;
    double const alt_m = change.params[0] + (is_above_sea || !home_ ? 0.0 : home_->alt_m);
    double const up_m = alt_m - at_->alt_m;
    time_s_ += vertical_time_s(up_m, performance_);
    path_m_ += std::abs(up_m);
    at_->alt_m = alt_m;
  }

  void change_speed(int type, double speed_m_s) {
    if (!(speed_m_s > 0.0)) return;
    int constexpr climb = 2;
    int constexpr descent = 3;
    auto& p = performance_;
    (type == climb ? p.climb_m_s : type == descent ? p.descent_m_s : p.cruise_m_s) = speed_m_s;
    if (type != climb && type != descent) curves_.set_speed(speed_m_s);
  }

  void jump(std::size_t target, int repetitions) {
    if (repetitions < 0) {
      is_endless_ = true;
      return;
    }
    if (jumped_[next_]++ < repetitions) next_ = target - 1;
  }

  Mission const& mission_;
  std::optional<geo::Wgs84> at_;
  std::optional<geo::Wgs84> home_;
  Performance performance_;
  Curves curves_;
  geo::LocalFrame frame_;
  std::optional<double> course_rad_;  ///< of the last leg
  double left_with_m_s_ = 0.0;
  std::size_t next_ = 0;
  std::map<std::size_t, int> jumped_;  ///< how often, by place of the jump
  double path_m_ = 0.0;
  double time_s_ = 0.0;
  bool is_endless_ = false;
};

}  // namespace

Estimate estimate(Mission const& mission, std::optional<geo::Wgs84> start, Performance const& performance,
                  double heading_rad) {
  return PaperFlight(mission, start, performance, heading_rad).fly();
}

std::string to_text(Flown const& flown) {
  // Shares of next to nothing say nothing.
  constexpr double worth_comparing = 1.0;
  auto const more = [](double expected, double actual) {
    bool const is_comparable = expected >= worth_comparing && actual >= worth_comparing;
    return is_comparable ? fmt::format(" ({:+.0f} %)", 100.0 * (expected - actual) / actual) : "";
  };
  double const expected_s = base::to_seconds(flown.estimate.duration);
  double const actual_s = base::to_seconds(flown.duration);
  return fmt::format("{:.0f} s and {:.0f} m flown, {:.0f} s{} and {:.0f} m{} estimated", actual_s, flown.path_m,
                     expected_s, more(expected_s, actual_s), flown.estimate.path_m,
                     more(flown.estimate.path_m, flown.path_m));
}

}  // namespace lapwing::plan
