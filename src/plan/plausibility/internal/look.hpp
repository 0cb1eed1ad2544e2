#pragma once

#include <optional>
#include <string>
#include <vector>

#include "plan/mission.hpp"
#include "plan/plausibility/finding.hpp"
#include "plan/plausibility/settings.hpp"
#include "plan/plausibility/situation.hpp"

/// What the rules of plausibility share: the mission's places as the vehicle would take them, and words for people.
namespace lapwing::plan::plausibility::internal {

/// One item that has a place or a height.
struct Stop {
  std::size_t item = 0;
  mavlink::MavCmd command{};
  geo::Wgs84 place;             ///< as it stands; its altitude counts from whatever the item says
  bool is_here = false;         ///< no place of its own
  std::optional<double> up_m;   ///< above the ground from which it starts
  std::optional<double> sea_m;  ///< above sea level as it stands; nothing where it counts from home or terrain

  [[nodiscard]] bool lands() const;
  [[nodiscard]] bool takes_off() const;
};

/// A mission, looked at for one vehicle, or for none.
struct Look {
  Look(Mission const& looked_at, Situation const& known, Limits const& set, bool without_vehicle);

  Mission const& mission;
  Situation const& situation;
  Limits const& limits;
  bool is_alone;                    ///< no vehicle
  std::optional<geo::Wgs84> home;   ///< as it is while the mission is flown
  std::optional<double> ground_m;   ///< above sea level, where it starts
  std::optional<geo::Wgs84> start;  ///< where the vehicle is; alone: the mission's home, or its first place
  bool flies = false;
  std::vector<Stop> stops;
  std::string by_hand;  ///< what a person calls the one place of a command; empty for a mission

  [[nodiscard]] double farthest_m() const;
  /// "item 3", or what it is by hand
  [[nodiscard]] std::string text_of(std::size_t item) const;
};

/// How far from a vehicle of that family the places of a mission may be, and of a command by hand.
[[nodiscard]] double mission_distance_m(Limits const& limits, vehicle::Family family);
[[nodiscard]] double go_to_distance_m(Limits const& limits, vehicle::Family family);

void judge_where(Look const& look, Findings& out);
void judge_height(Look const& look, Findings& out);
void judge_sequence(Look const& look, Findings& out);
void judge_pads(Look const& look, Findings& out);
void judge_fence(Look const& look, Findings& out);
void judge_own_fence(Look const& look, Findings& out);
void judge_battery(Look const& look, Findings& out);

/// Latitude and longitude 0 are not meant; alone in the world, or with everything else far away from there.
[[nodiscard]] bool is_zero_place(geo::Wgs84 place, std::optional<geo::Wgs84> start);
/// What a place that is too far from `near` was probably meant to be; empty when nothing suggests itself.
[[nodiscard]] std::string probable_place(geo::Wgs84 place, geo::Wgs84 near, double within_m);
[[nodiscard]] std::optional<base::Duration> endurance(Situation const& situation, Limits const& limits);

/// "278 km", "16.8 m"
[[nodiscard]] std::string distance_text(double metres);
/// "41.17800, -8.59800"
[[nodiscard]] std::string place_text(geo::Wgs84 place);
/// "item 3"; items of missions count from 1, as everywhere
[[nodiscard]] std::string item_text(std::size_t item);
/// " (and 3 more)"; nothing for none
[[nodiscard]] std::string more_text(std::size_t others);

}  // namespace lapwing::plan::plausibility::internal
