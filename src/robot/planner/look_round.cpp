#include "robot/planner/look_round.hpp"

#include <cmath>
#include <numbers>

#include "explore/floor/ray.hpp"

namespace lapwing::robot {

using explore::Cell;
using explore::Knowledge;

namespace {

constexpr int parts = 4;  ///< of a turn: fewer than three do not say which way round
constexpr double part_rad = 2.0 * std::numbers::pi / parts;
constexpr double turned_rad = 0.1;
constexpr double looks_m = 1.0;  ///< what is unknown farther off it will see on its way there
constexpr double much = 0.15;    ///< of all directions
constexpr double elsewhere_m = 0.5;

/// Of all directions, the share in which something is unknown before anything stands in the way.
double unknown_share(explore::KnownMap const& map, explore::Place const& from) {
  constexpr int rays = 72;
  int unknown = 0;
  for (int i = 0; i < rays; ++i) {
    double const yaw = i * 2.0 * std::numbers::pi / rays;
    bool is_unknown = false;
    explore::walk_line(from.x() / map.cell_m(), from.y() / map.cell_m(), std::cos(yaw), std::sin(yaw),
                       looks_m / map.cell_m(), [&](Cell cell, double) {
                         is_unknown = map.at(cell) == Knowledge::unknown;
                         return map.at(cell) == Knowledge::free;
                       });
    unknown += is_unknown ? 1 : 0;
  }
  return static_cast<double>(unknown) / rays;
}

}  // namespace

void LookRound::arrive(explore::KnownMap const& map, explore::Pose const& pose) {
  bool const was_here = looked_at_ && geo::distance_m(*looked_at_, pose.position) < elsewhere_m;
  if (turns_left_ > 0 || was_here || unknown_share(map, pose.position) < much) return;
  looked_at_ = pose.position;
  turns_left_ = parts;
  towards_rad_ = geo::wrap_pi(pose.yaw_rad + part_rad);
}

std::optional<double> LookRound::next(double yaw_rad) {
  if (turns_left_ == 0) return std::nullopt;
  if (std::abs(geo::wrap_pi(towards_rad_ - yaw_rad)) < turned_rad) {
    towards_rad_ = geo::wrap_pi(towards_rad_ + part_rad);
    --turns_left_;
  }
  return turns_left_ > 0 ? std::optional(towards_rad_) : std::nullopt;
}

}  // namespace lapwing::robot
