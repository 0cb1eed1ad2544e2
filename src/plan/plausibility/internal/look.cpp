#include "plan/plausibility/internal/look.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "plan/performance.hpp"

namespace lapwing::plan::plausibility::internal {

using mavlink::MavCmd;
using mavlink::MavFrame;
using mavlink::MissionItem;
using vehicle::Family;

namespace {

/// No two places of one field are further apart than a continent: what no vehicle of any kind is sent to by one script.
constexpr double farthest_alone_m = 1e6;

bool is_above_sea(MavFrame frame) {
  return frame == MavFrame::global || frame == MavFrame::global_int || frame == MavFrame::mission;
}

bool is_above_terrain(MavFrame frame) {
  return frame == MavFrame::global_terrain_alt || frame == MavFrame::global_terrain_alt_int;
}

bool is_take_off(MavCmd command) {
  return command == MavCmd::nav_takeoff || command == MavCmd::nav_vtol_takeoff;
}

bool is_landing(MavCmd command) {
  return command == MavCmd::nav_land || command == MavCmd::nav_vtol_land || command == MavCmd::nav_payload_place;
}

/// The ground under the vehicle: where it stands if that is its field, else where it took off.
std::optional<double> own_ground(Situation const& situation, std::optional<geo::Wgs84> home, double field_m) {
  auto const& at = situation.position;
  bool const stands = situation.on_ground.value_or(false) && at;
  if (!stands) return situation.home ? std::optional(situation.home->alt_m) : std::nullopt;
  bool const is_at_home = !home || geo::surface_distance_m(*at, *home) <= field_m;
  if (is_at_home || !situation.home) return at->alt_m;
  return std::min(at->alt_m, situation.home->alt_m);
}

/// Reads the items one after the other; a landing and a new home on the way change what the ground is.
class Reader {
 public:
  Reader(std::optional<double> home_m, std::optional<double> ground_m) : home_m_(home_m), ground_m_(ground_m) {}

  void read(Mission const& mission, std::vector<Stop>& stops) {
    for (std::size_t i = 0; i < mission.items.size(); ++i) {
      auto const& item = mission.items[i];
      if (item.command == MavCmd::do_change_altitude) add_change(i, item, stops);
      if (has_position(item)) add_place(i, item, stops);
    }
  }

 private:
  void add_place(std::size_t index, MissionItem const& item, std::vector<Stop>& stops) {
    auto const place = position_of(item);
    if (!std::isfinite(place.lat_rad) || !std::isfinite(place.lon_rad) || !std::isfinite(place.alt_m)) return;
    auto stop = at_height(item.frame, place.alt_m);
    stop.item = index;
    stop.command = item.command;
    stop.place = place;
    // Autopilots read 0, 0 as "here", and files are written so. Above sea level only scripts count, which say places.
    stop.is_here = place.lat_rad == 0.0 && place.lon_rad == 0.0 && !is_above_sea(item.frame);
    stops.push_back(stop);
    if (item.command == MavCmd::do_set_home || stop.lands()) {
      if (stop.sea_m) ground_m_ = stop.sea_m;
      if (item.command == MavCmd::do_set_home && stop.sea_m) home_m_ = stop.sea_m;
    }
  }

  void add_change(std::size_t index, MissionItem const& item, std::vector<Stop>& stops) const {
    auto const frame = frame_of_change(item);
    if (!frame) return;
    auto stop = at_height(*frame, static_cast<double>(item.params[0]));
    stop.item = index;
    stop.command = item.command;
    stop.is_here = true;
    stops.push_back(stop);
  }

  [[nodiscard]] Stop at_height(MavFrame frame, double z_m) const {
    Stop stop;
    if (is_above_terrain(frame)) {
      stop.up_m = z_m;
    } else if (is_above_sea(frame)) {
      stop.sea_m = z_m;
      if (ground_m_) stop.up_m = z_m - *ground_m_;
    } else {
      stop.up_m = z_m + (home_m_ && ground_m_ ? *home_m_ - *ground_m_ : 0.0);
    }
    return stop;
  }

  std::optional<double> home_m_;
  std::optional<double> ground_m_;
};

}  // namespace

bool Stop::lands() const {
  return is_landing(command);
}
bool Stop::takes_off() const {
  return is_take_off(command);
}

Look::Look(Mission const& looked_at, Situation const& known, Limits const& set, bool without_vehicle)
    : mission(looked_at), situation(known), limits(set), is_alone(without_vehicle) {
  home = mission.home ? mission.home : situation.home;
  auto const own = own_ground(situation, home, limits.home_moved_m);
  ground_m = own ? own : home ? std::optional(home->alt_m) : std::nullopt;
  Reader(home ? std::optional(home->alt_m) : std::nullopt, ground_m).read(mission, stops);
  bool const takes_off = std::ranges::any_of(stops, &Stop::takes_off);
  flies = situation.family == Family::unknown ? takes_off : plan::flies(situation.family);
  start = situation.position;
  if (start || !is_alone) return;
  auto const first = std::ranges::find(stops, false, &Stop::is_here);
  start = mission.home ? mission.home : first != stops.end() ? std::optional(first->place) : std::nullopt;
}

double Look::farthest_m() const {
  if (!is_alone) return mission_distance_m(limits, situation.family);
  return limits.distance_m ? std::max(*limits.distance_m, farthest_alone_m) : farthest_alone_m;
}

std::string Look::text_of(std::size_t item) const {
  return by_hand.empty() ? item_text(item) : by_hand;
}

double mission_distance_m(Limits const& limits, Family family) {
  if (limits.distance_m) return *limits.distance_m;
  switch (family) {
    case Family::plane:
    case Family::vtol:
    case Family::unknown: return 30'000.0;
    case Family::boat: return 20'000.0;
    case Family::copter:
    case Family::rover:
    case Family::sub:
    case Family::robot: return 11'000.0;
  }
  return 30'000.0;
}

double go_to_distance_m(Limits const& limits, Family family) {
  if (limits.go_to_m) return *limits.go_to_m;
  switch (family) {
    case Family::plane:
    case Family::vtol:
    case Family::unknown: return 20'000.0;
    case Family::boat: return 10'000.0;
    case Family::copter:
    case Family::rover:
    case Family::sub:
    case Family::robot: return 5'000.0;
  }
  return 20'000.0;
}

bool is_zero_place(geo::Wgs84 place, std::optional<geo::Wgs84> start) {
  constexpr double about_there_m = 1'000.0;
  constexpr double elsewhere_m = 100'000.0;
  constexpr geo::Wgs84 zero{};
  if (geo::surface_distance_m(place, zero) > about_there_m) return false;
  return !start || *start == place || geo::surface_distance_m(*start, zero) > elsewhere_m;
}

std::string probable_place(geo::Wgs84 place, geo::Wgs84 near, double within_m) {
  constexpr double quarter_rad = std::numbers::pi / 2.0;
  auto const is_near = [&](geo::Wgs84 other) { return geo::surface_distance_m(other, near) <= within_m; };
  if (std::abs(place.lon_rad) <= quarter_rad && is_near({place.lon_rad, place.lat_rad, 0.0}))
    return "latitude and longitude look swapped";
  if (is_near({place.lat_rad, -place.lon_rad, 0.0})) return "the longitude seems to lack its sign: west is negative";
  if (is_near({-place.lat_rad, place.lon_rad, 0.0})) return "the latitude seems to lack its sign: south is negative";
  if (is_near({-place.lat_rad, -place.lon_rad, 0.0})) return "both coordinates seem to lack their signs";
  return {};
}

std::optional<base::Duration> endurance(Situation const& situation, Limits const& limits) {
  if (situation.endurance) return situation.endurance;
  return limits.endurance_s ? std::optional(base::from_seconds(*limits.endurance_s)) : std::nullopt;
}

std::string distance_text(double metres) {
  if (metres < 100.0) return fmt::format("{:.1f} m", metres);
  if (metres < 2'000.0) return fmt::format("{:.0f} m", metres);
  return metres < 100'000.0 ? fmt::format("{:.1f} km", metres / 1e3) : fmt::format("{:.0f} km", metres / 1e3);
}

std::string place_text(geo::Wgs84 place) {
  return fmt::format("{:.5f}, {:.5f}", place.lat_deg(), place.lon_deg());
}

std::string item_text(std::size_t item) {
  return fmt::format("item {}", item + 1);
}

std::string more_text(std::size_t others) {
  return others == 0 ? "" : fmt::format(" (and {} more)", others);
}

}  // namespace lapwing::plan::plausibility::internal
