#pragma once

#include <vector>

#include "host/car_park/car_park_look.hpp"
#include "map/features/contents.hpp"

namespace lapwing::host {

/// How the map of a simulated car park compares with what is true of it.
struct LotScore {
  int true_slots = 0;
  int found = 0;       ///< of them, on the map with their middle within a metre: surely that slot and no other
  int told = 0;        ///< of those, called free or taken
  int right = 0;       ///< of those, rightly
  int invented = 0;    ///< slots on the map that are more than 1.5 m from any
  double off_m = 0.0;  ///< how far those that were found lie from where they are, in the mean
  friend bool operator==(LotScore const&, LotScore const&) = default;
};

/// A true slot counts once, whatever else on the map lies where it does.
[[nodiscard]] LotScore score_of(std::vector<map::Slot> const& found, CarParkTruth const& truth);

}  // namespace lapwing::host
