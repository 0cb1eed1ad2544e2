#pragma once

#include <span>

#include "explore/lot/slots/picture_shift.hpp"

namespace lapwing::explore {

/// What is known of a slot when a picture comes.
struct SlotGuess {
  map::SitePoint middle;
  double half_width_m = 0.0;
  double taken_chance = 0.5;
};

/// About where a picture lies whose camera may be off by more than a slot is wide, so that the nearest slot may be the
/// neighbour: of all moves that bring one slot of the picture onto a known one, that which fits most slots, whose cars
/// agree best, and which is least unlikely of the camera. Not turned or stretched.
///
/// `last`: how the vehicle's picture before this one lay; errors of one flight are alike.
[[nodiscard]] PictureShift first_shift(LotSight const& sight, std::span<SlotGuess const> slots,
                                       PictureShift const& last);

}  // namespace lapwing::explore
