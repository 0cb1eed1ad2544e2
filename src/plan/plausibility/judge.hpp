#pragma once

#include <optional>

#include "plan/mission.hpp"
#include "plan/plausibility/finding.hpp"
#include "plan/plausibility/settings.hpp"
#include "plan/plausibility/situation.hpp"

/// Whether what somebody wants a vehicle to do makes sense, asked before anything is sent. Pure: the one place that a
/// check of a script, a dry run, a flight, an upload and an operator's command ask.
namespace lapwing::plan::plausibility {

/// Of a mission that is about to be flown, or held, by the vehicle of the situation. What refuses comes first.
[[nodiscard]] Findings judge(Mission const& mission, Situation const& situation, Settings const& settings);

/// Of a mission about which nothing is known but itself: no vehicle, no field. Only what cannot be meant anywhere.
[[nodiscard]] Findings judge_alone(Mission const& mission, Settings const& settings);

/// Of two missions that one vehicle flies one after the other, whatever vehicle that is.
[[nodiscard]] Findings judge_order(Mission const& first, Mission const& second, Settings const& settings);

/// An operator's command by hand.
struct GoTo {
  geo::Wgs84 place;                ///< its altitude does not count
  std::optional<double> height_m;  ///< above home; nothing: as it is
};
[[nodiscard]] Findings judge(GoTo const& command, Situation const& situation, Settings const& settings);
/// To a height above the ground.
[[nodiscard]] Findings judge_take_off(double height_m, Situation const& situation, Settings const& settings);
/// The start of whatever mission the vehicle holds; `held` is that mission, if it is known.
[[nodiscard]] Findings judge_start(std::optional<Mission> const& held, Situation const& situation,
                                   Settings const& settings);

/// Where the mission lands the vehicle: landing items, and home for those that return there. For what others are told
/// of it.
[[nodiscard]] std::vector<geo::Wgs84> landing_places(Mission const& mission, std::optional<geo::Wgs84> vehicle_home);

}  // namespace lapwing::plan::plausibility
