#include "video/world/row_of_slots.hpp"

#include <cmath>
#include <numbers>

namespace lapwing::video {

namespace {

using Shift = geo::Vector<geo::SiteFrame>;

Shift towards(double heading_rad, double metres) {
  return {metres * std::cos(heading_rad), metres * std::sin(heading_rad)};
}

Slot::Habit habit_of(RowOfSlots const& row, int number) {
  if (row.taken.contains(number)) return Slot::Habit::taken;
  return row.free.contains(number) ? Slot::Habit::free : Slot::Habit::by_chance;
}

/// `is_next`: the slot before it has painted the side that both have.
void paint(CarPark& park, RowOfSlots const& row, std::array<Spot, 4> const& c, bool is_next) {
  auto const line = [&](Spot const& from, Spot const& to) {
    park.stripes.push_back({.points = {from, to}, .width_m = row.line_m, .colour = row.colour});
  };
  if (row.has_sides) {
    if (!is_next) line(c[0], c[3]);
    line(c[1], c[2]);
  }
  if (row.has_heads) line(c[3], c[2]);
  if (row.has_mouths) line(c[0], c[1]);
}

}  // namespace

void add_row(CarPark& park, RowOfSlots const& row) {
  double const pitch_m = row.width_m / std::cos(row.slant_rad);
  auto const along = towards(row.heading_rad, pitch_m);
  auto const deep = towards(row.heading_rad + std::numbers::pi / 2.0 - row.slant_rad, row.length_m);
  for (int i = 0; i < row.count; ++i) {
    int const number = row.first + i;
    if (row.left_out.contains(number)) continue;
    auto const at = row.at + towards(row.heading_rad, i * (pitch_m + row.gap_m));
    Slot const slot{.id = row.name + std::to_string(number),
                    .outline = {at, at + along, at + along + deep, at + deep},
                    .habit = habit_of(row, number),
                    .share = row.share};
    park.slots.push_back(slot);
    paint(park, row, slot.outline, i > 0 && row.gap_m <= 0.0 && !row.left_out.contains(number - 1));
  }
}

}  // namespace lapwing::video
