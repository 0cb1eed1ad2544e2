#include "robot/planner/home_charge.hpp"

#include <algorithm>

namespace lapwing::robot {

namespace {

/// Of its highest speed: who got on more slowly stood and looked, which the way home does not ask for.
constexpr double slowest = 0.25;

}  // namespace

void HomeCharge::note(Now const& now) {
  if (now.is_under_way && !was_under_way_) {
    set_out_at_ = now.at;
    set_out_m_ = now.driven_m;
  }
  was_under_way_ = now.is_under_way;
  auto const drain = meter_.add(now.charge, now.is_under_way, now.at);
  if (!now.charge || *now.charge > needed(now, drain)) {
    low_since_.reset();
  } else if (!low_since_) {
    low_since_ = now.at;
  }
  is_due_ = low_since_ && now.at - *low_since_ >= options_.sure_after;
}

double HomeCharge::needed(Now const& now, std::optional<vehicle::Drain> const& drain) const {
  if (!drain) return options_.when_unknown;
  double const out_s = std::max(base::to_seconds(now.at - set_out_at_), 1.0);
  double const pace_m_s = std::clamp((now.driven_m - set_out_m_) / out_s, slowest * speed_m_s_, speed_m_s_);
  double const way = drain->per_s * (1.0 + drain->error) * home_m_ / pace_m_s;
  return std::clamp(way + options_.margin, options_.least, 1.0);
}

}  // namespace lapwing::robot
