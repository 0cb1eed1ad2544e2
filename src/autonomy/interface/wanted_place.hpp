#pragma once

#include <optional>

#include "autonomy/interface/command.hpp"
#include "base/error.hpp"
#include "geo/polygon.hpp"

namespace lapwing::autonomy {

/// Where nobody wants it to go in earnest.
struct PlaceLimits {
  double furthest_m = 1'000.0;                          ///< from where it was armed
  double furthest_from_lot_m = 100.0;                   ///< of a move by the map
  std::optional<geo::Polygon<ArmingFrame>> fence = {};  ///< nothing: there is none
};

/// Whether it makes sense to go there. `lot`: how far the lot reaches, where that matters. Errors (invalid_input, with
/// a hint): no number, too far, outside the fence, too far from the lot.
[[nodiscard]] base::Result<> check_place(geo::Point<ArmingFrame> const& place, PlaceLimits const& limits,
                                         std::optional<geo::Box<ArmingFrame>> const& lot);
/// Whether it may fly so high. Errors (invalid_input): no number, below the lowest or above the highest height.
[[nodiscard]] base::Result<> check_height(double height_m, HoverHeights const& heights);

/// A place on the globe as seen from the drone, which knows where it is in both. Error (invalid_input): no place on
/// Earth.
[[nodiscard]] base::Result<geo::Point<ArmingFrame>> in_arming_frame(geo::Wgs84 place, geo::Wgs84 drone,
                                                                    geo::Point<ArmingFrame> const& drone_local);
/// The other way round, at the drone's altitude.
[[nodiscard]] geo::Wgs84 on_globe(geo::Point<ArmingFrame> const& place, geo::Wgs84 drone,
                                  geo::Point<ArmingFrame> const& drone_local);

}  // namespace lapwing::autonomy
