#pragma once

#include <chrono>
#include <numbers>

#include "explore/lot/lot_map.hpp"

/// Pictures of a car park for tests: a camera that looks straight down, slots and cars where one wants them.
namespace lapwing::explore::testing {

inline constexpr base::UtcTime noon = base::UtcTime(std::chrono::sys_days(std::chrono::year(2026) / 11 / 20));

inline base::UtcTime after(double seconds) {
  return noon + std::chrono::duration_cast<base::UtcTime::duration>(std::chrono::duration<double>(seconds));
}

/// At 20 m it sees 24 m to the right and left of north, and 13.5 m along it.
inline geo::GroundView view_at(double x, double y, double up_m = 20.0) {
  constexpr double across_rad = 1.08;
  return {.lens = geo::pinhole(1280, 720, across_rad),
          .site_from_camera = geo::camera_at({x, y, up_m}, std::numbers::pi / 2.0, 0.0)};
}

/// 2.5 m from west to east, 5 m from south to north, about a middle.
inline Corners slot_at(double x, double y) {
  return {{{x - 1.25, y - 2.5}, {x + 1.25, y - 2.5}, {x + 1.25, y + 2.5}, {x - 1.25, y + 2.5}}};
}

/// A picture from above (x, y) at a time, in seconds after noon, which shows nothing yet.
inline LotSight sight_at(double x, double y, double seconds) {
  return {.vehicle = "drone 1", .at = after(seconds), .view = view_at(x, y)};
}

inline geo::Polygon<geo::SiteFrame> rectangle(double width_m, double height_m) {
  return {{{{0.0, 0.0}, {width_m, 0.0}, {width_m, height_m}, {0.0, height_m}}}};
}

inline LotMap lot_map(LotSettings const& settings = {}) {
  return LotMap::make(rectangle(60.0, 40.0), settings).value();
}

}  // namespace lapwing::explore::testing
