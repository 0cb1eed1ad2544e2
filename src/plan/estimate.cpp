#include "plan/estimate.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

namespace lapwing::plan {
namespace {

using mavlink::MavCmd;
using mavlink::MissionItem;

/// Flies a mission on paper.
class PaperFlight {
 public:
  PaperFlight(Mission const& mission, std::optional<geo::Wgs84> start, Speeds speeds)
      : mission_(mission), at_(start ? start : mission.home), speeds_(speeds) {}

  Estimate fly() {
    // Jumps inside jumps multiply: what is longer than this is endless to any vehicle.
    int constexpr most_items = 1'000'000;
    int flown = 0;
    while (next_ < mission_.items.size() && !is_endless_) {
      if (++flown > most_items) is_endless_ = true;
      auto const& item = mission_.items[next_++];
      if (has_position(item) && item.command != MavCmd::do_set_home) go_to(position_of(item));
      perform(item);
    }
    return {.path_m = path_m_, .duration = base::from_seconds(std::min(time_s_, 1e9)), .is_endless = is_endless_};
  }

 private:
  void go_to(geo::Wgs84 place) {
    auto const from = at_.value_or(place);
    double const level_m = geo::surface_distance_m(from, place);
    double const up_m = place.alt_m - from.alt_m;
    double const vertical_s = up_m > 0.0 ? up_m / speeds_.climb_m_s : -up_m / speeds_.descent_m_s;
    path_m_ += std::hypot(level_m, up_m);
    time_s_ += std::max(level_m / speeds_.cruise_m_s, vertical_s);
    at_ = place;
  }

  void perform(MissionItem const& item) {
    double const first = item.params[0];
    switch (item.command) {
      case MavCmd::nav_loiter_unlim: is_endless_ = true; break;
      case MavCmd::nav_loiter_turns: circle(first * 2.0 * std::numbers::pi * std::abs(item.params[2])); break;
      case MavCmd::nav_loiter_time: time_s_ += first; break;
      case MavCmd::nav_delay: time_s_ += first; break;
      case MavCmd::do_change_altitude: change_altitude(first); break;
      case MavCmd::do_change_speed: change_speed(static_cast<int>(first), item.params[1]); break;
      case MavCmd::do_jump: jump(static_cast<std::size_t>(first), static_cast<int>(item.params[1])); break;
      default: break;
    }
  }

  void circle(double length_m) {
    path_m_ += length_m;
    time_s_ += length_m / speeds_.cruise_m_s;
  }

  void change_altitude(double alt_m) {
    if (!at_) return;
    auto const above = geo::Wgs84{at_->lat_rad, at_->lon_rad, alt_m};
    go_to(above);
  }

  void change_speed(int type, double speed_m_s) {
    int constexpr climb = 2;
    int constexpr descent = 3;
    (type == climb ? speeds_.climb_m_s : type == descent ? speeds_.descent_m_s : speeds_.cruise_m_s) = speed_m_s;
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
  Speeds speeds_;
  std::size_t next_ = 0;
  std::map<std::size_t, int> jumped_;  ///< how often, by place of the jump
  double path_m_ = 0.0;
  double time_s_ = 0.0;
  bool is_endless_ = false;
};

}  // namespace

Estimate estimate(Mission const& mission, std::optional<geo::Wgs84> start, Speeds speeds) {
  return PaperFlight(mission, start, speeds).fly();
}

}  // namespace lapwing::plan
