#include "sim/guidance/guided.hpp"

namespace lapwing::sim {

void Guided::set_velocity(geo::Ned velocity_m_s, base::Duration now) {
  goal_ = Cruise{velocity_m_s};
  velocity_set_at_ = now;
}

void Guided::steer(Steer const& wanted, base::Duration now) {
  goal_ = wanted;
  velocity_set_at_ = now;
}

void Guided::pause(geo::Ned here) {
  if (paused_) return;
  paused_ = goal_;
  goal_ = HoldAt{here};
}

void Guided::resume() {
  if (!paused_) return;
  goal_ = *paused_;
  paused_.reset();
}

Goal Guided::update(FlightContext const& context) {
  bool const is_renewed = std::holds_alternative<Cruise>(goal_) || std::holds_alternative<Steer>(goal_);
  if (is_renewed && context.now - velocity_set_at_ > context.tuning.guided_timeout) {
    goal_ = HoldAt{stopping_point(context.body, context.airframe, context.pace)};
  }
  if (auto const* take_off = std::get_if<TakeOff>(&goal_)) {
    bool const there = context.body.height_m() > take_off->height_m - 0.1;
    if (there) goal_ = HoldAt{{take_off->from.north, take_off->from.east, -take_off->height_m}};
  }
  if (auto const* way = std::get_if<FlyTo>(&goal_)) {
    // A plane circles the point once it is there; everything else stops at it by itself.
    bool const wing = context.family() == vehicle::Family::plane;
    if (wing && has_reached(context.body, way->point, way->point, 1.5 * context.pace.loiter_radius_m)) {
      goal_ = HoldAt{way->point};
    }
  }
  return goal_;
}

}  // namespace lapwing::sim
