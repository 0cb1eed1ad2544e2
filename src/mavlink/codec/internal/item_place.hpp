#pragma once

#include "mavlink/codec/internal/fields.hpp"

/// Where a COMMAND_INT or a mission item points: x, y and z mean what its frame and command say.
namespace lapwing::mavlink::internal {

/// The wire's integers count 1e-7 degrees or 1e-4 m, its floats degrees or metres.
struct PlaceUnits {
  static double angle_rad(std::int32_t wire) { return radians_e7(wire); }
  static double angle_rad(float wire) { return static_cast<double>(wire) * degree; }
  static void put_angle(std::int32_t& wire, double angle_rad) { wire = degrees_e7(angle_rad); }
  static void put_angle(float& wire, double angle_rad) { wire = narrow(angle_rad / degree); }
  static constexpr double length_m(std::int32_t) { return 1e-4; }
  static constexpr double length_m(float) { return 1.0; }
};

inline constexpr auto item_place =
    Both{[](auto& m, auto const& w, Intake&) {
           auto& place = m.place;
           place.z_m = w.z;
           if (has_place(m.command) && is_global(m.frame)) {
             place.lat_rad = PlaceUnits::angle_rad(w.x);
             place.lon_rad = PlaceUnits::angle_rad(w.y);
           } else {
             auto const unit = has_place(m.command) && m.frame != MavFrame::mission ? PlaceUnits::length_m(w.x) : 1.0;
             place.x = static_cast<double>(w.x) * unit;
             place.y = static_cast<double>(w.y) * unit;
           }
         },
         [](auto const& m, auto& w) {
           auto const& place = m.place;
           w.z = narrow(place.z_m);
           if (has_place(m.command) && is_global(m.frame)) {
             PlaceUnits::put_angle(w.x, place.lat_rad);
             PlaceUnits::put_angle(w.y, place.lon_rad);
           } else {
             auto const unit = has_place(m.command) && m.frame != MavFrame::mission ? PlaceUnits::length_m(w.x) : 1.0;
             Plain::write(w.x, place.x / unit);
             Plain::write(w.y, place.y / unit);
           }
         }};

}  // namespace lapwing::mavlink::internal
