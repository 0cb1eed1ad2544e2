#pragma once

#include <set>
#include <string>
#include <vector>

#include "video/world/car_park.hpp"

namespace lapwing::video {

/// Slots side by side, as people mark them. They lie to the left of whoever goes along the row.
struct RowOfSlots {
  std::string name;  ///< before the number of each slot
  Spot at;           ///< the first corner of the first slot's mouth
  double heading_rad = 0.0;
  int count = 1;
  int first = 1;           ///< the number of the first one
  double width_m = 2.5;    ///< across a slot, square to its sides
  double length_m = 5.0;   ///< of its sides
  double slant_rad = 0.0;  ///< of its sides, from square to the row, towards where the row goes
  double gap_m = 0.0;      ///< between two slots
  double share = 0.6;
  std::set<int> taken = {};  ///< by the slots' numbers: always
  std::set<int> free = {};
  std::set<int> left_out = {};  ///< islands
  bool has_sides = true;        ///< what of the slots is painted
  bool has_heads = false;
  bool has_mouths = false;
  double line_m = 0.12;
  Colour colour = {0.92, 0.92, 0.91};
};

/// Puts the row's slots and lines into the car park.
void add_row(CarPark& park, RowOfSlots const& row);

}  // namespace lapwing::video
