#include "video/world/vehicle_look.hpp"

#include <algorithm>

namespace lapwing::video {

namespace {

struct Paint {
  double share;
  std::array<int, 3> rgb;
};

/// What cars are painted with, and how often.
constexpr std::array<Paint, 19> paints = {{{16, {232, 233, 234}},
                                           {10, {245, 245, 243}},
                                           {14, {28, 29, 31}},
                                           {10, {45, 47, 50}},
                                           {9, {120, 123, 126}},
                                           {10, {165, 168, 171}},
                                           {9, {195, 198, 200}},
                                           {5, {150, 22, 28}},
                                           {3, {110, 15, 20}},
                                           {4, {25, 50, 110}},
                                           {4, {40, 75, 130}},
                                           {3, {70, 105, 140}},
                                           {2, {30, 70, 60}},
                                           {2, {90, 80, 60}},
                                           {3, {170, 150, 120}},
                                           {1, {200, 180, 60}},
                                           {1, {210, 110, 40}},
                                           {1, {80, 130, 120}},
                                           {1, {90, 30, 60}}}};

/// The element at which the shares before it, summed, reach `chance` of all.
template <class List>
auto const& by_share(List const& list, double chance) {
  double sum = 0.0;
  for (auto const& element : list) sum += element.share;
  double left = chance * sum;
  for (auto const& element : list) {
    left -= element.share;
    if (left < 0.0) return element;
  }
  return list.back();
}

double between(Dice& dice, std::array<double, 2> const& limits) {
  return dice.uniform(limits[0], limits[1]);
}

}  // namespace

VehicleLook drawn_vehicle(Dice& dice, double longest_m) {
  VehicleLook look;
  look.kind = &by_share(vehicle_kinds, dice.uniform());
  if (look.kind->length_m[0] > longest_m) look.kind = &vehicle_kinds[1];  // the shortest
  look.length_m = std::min(between(dice, look.kind->length_m), std::max(longest_m, look.kind->length_m[0]));
  look.width_m = between(dice, look.kind->width_m);
  look.height_m = between(dice, look.kind->height_m);
  auto rgb = by_share(paints, dice.uniform()).rgb;
  constexpr double white_vans = 0.7;
  if (look.kind->is_box && dice.happens(white_vans)) rgb = paints[0].rgb;
  double const lighter = 9.0 * dice.gaussian();
  auto const tone = [&](int value) { return std::clamp(value + lighter + 2.5 * dice.gaussian(), 8.0, 250.0) / 255.0; };
  look.paint.red = tone(rgb[0]);
  look.paint.green = tone(rgb[1]);
  look.paint.blue = tone(rgb[2]);
  look.glass = dice.uniform(0.6, 1.7);
  look.has_skylight = dice.happens(0.3);
  look.has_rails = dice.happens(0.3);
  return look;
}

VehicleKind const* vehicle_kind(std::string_view name) {
  auto const* const found = std::ranges::find(vehicle_kinds, name, &VehicleKind::name);
  return found == vehicle_kinds.end() ? nullptr : found;
}

}  // namespace lapwing::video
