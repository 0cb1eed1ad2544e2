#include "sim/guidance/return_home.hpp"

#include <algorithm>
#include <cmath>

#include "sim/guidance/rally.hpp"

namespace lapwing::sim {

using namespace std::chrono_literals;

Goal Landing::update(FlightContext const& context) {
  bool const still = context.body.ground_speed_m_s() < 0.5;
  if (!context.body.on_ground || !still) {
    grounded_at_.reset();
  } else if (!grounded_at_) {
    grounded_at_ = context.now;
  }
  finished_ = grounded_at_ && context.now - *grounded_at_ >= 1s;
  if (context.body.on_ground && still) return Idle{};
  return Descend{point_};
}

Goal ReturnHome::update(FlightContext const& context) {
  if (phase_ == Phase::start) return begin(context);
  return fly(context);
}

namespace {

/// Its way home has no climb before and no landing after.
bool stays_level(vehicle::Family family) {
  return family == vehicle::Family::rover || family == vehicle::Family::sub;
}

}  // namespace

Goal ReturnHome::begin(FlightContext const& context) {
  start_ = context.body.position_m;
  auto const goal = return_place(context);
  above_home_ = goal.point;
  using enum vehicle::Family;
  if (stays_level(context.family())) {
    above_home_.down = context.home.down;
    phase_ = Phase::travel;
  } else if (context.landed) {
    phase_ = Phase::land;
    landing_.emplace(start_);
  } else {
    double const height = context.home.down - context.tuning.rtl_height_m;
    double const wanted = goal.is_rally ? goal.point.down : height;
    above_home_.down = context.family() == plane ? wanted : std::min({start_.down, height, wanted});
    phase_ = context.family() == plane ? Phase::travel : Phase::climb;
  }
  return fly(context);
}

Goal ReturnHome::fly(FlightContext const& context) {
  auto const& body = context.body;
  if (phase_ == Phase::climb) {
    if (std::abs(body.position_m.down - above_home_.down) > 0.3) {
      return HoldAt{{start_.north, start_.east, above_home_.down}};
    }
    phase_ = Phase::travel;
  }
  if (phase_ == Phase::travel) {
    if (context.family() == vehicle::Family::plane) return HoldAt{above_home_};
    bool const arrived = has_reached(body, above_home_, above_home_, context.tuning.waypoint_radius_m);
    if (!arrived) return FlyTo{above_home_, start_, false};
    phase_ = stays_level(context.family()) ? Phase::done : Phase::wait;
    waiting_since_ = context.now;
  }
  if (phase_ == Phase::wait) {
    bool const over_home = has_reached(body, above_home_, above_home_, 0.3);
    if (context.now - waiting_since_ < context.tuning.rtl_loiter_time || !over_home) return HoldAt{above_home_};
    phase_ = Phase::land;
    landing_.emplace(geo::Ned{above_home_.north, above_home_.east, context.home.down});
  }
  if (phase_ == Phase::land) {
    Goal const goal = landing_->update(context);
    if (landing_->finished()) phase_ = Phase::done;
    return goal;
  }
  return stays_level(context.family()) ? Goal{HoldAt{above_home_}} : Goal{Idle{}};
}

Goal Retrace::update(FlightContext const& context) {
  auto const& here = context.body.position_m;
  bool const lands = !stays_level(context.family());
  if (!from_) from_ = here;
  if (landing_ || (lands && context.landed)) {
    if (!landing_) landing_.emplace(here);
    Goal const goal = landing_->update(context);
    finished_ = landing_->finished();
    return goal;
  }
  while (!left_.empty()) {
    auto next = left_.back();
    bool const is_last = left_.size() == 1;
    constexpr double landing_begins_m = 2.0;
    if (is_last && lands) next.down -= landing_begins_m;
    bool const is_near = has_reached(context.body, *from_, next, context.tuning.waypoint_radius_m) &&
                         (!lands || std::abs(here.down - next.down) < landing_begins_m);
    // It stops at every corner, so that it cuts none.
    if (!is_near) return FlyTo{next, *from_, false};
    from_ = next;
    if (is_last) break;
    left_.pop_back();
  }
  if (!lands) {
    finished_ = true;
    return HoldAt{left_.empty() ? here : left_.front()};
  }
  landing_.emplace(left_.empty() ? here : left_.front());
  return landing_->update(context);
}

}  // namespace lapwing::sim
