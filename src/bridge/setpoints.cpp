#include "bridge/setpoints.hpp"

#include <cmath>

#include "bridge/frames.hpp"

namespace lapwing::bridge {

namespace {

/// Bits of POSITION_TARGET_TYPEMASK: velocity, acceleration and turning do not count.
constexpr std::uint16_t place_alone = 0b100111111000;
constexpr std::uint16_t without_yaw = 0b010000000000;
/// Local coordinates beyond are nobody's earnest.
constexpr double furthest_m = 1e5;

mavlink::SetPositionTargetGlobalInt target_at(geo::Wgs84 place, bus::Quaternion const& orientation) {
  auto const heading = heading_rad(orientation);
  mavlink::SetPositionTargetGlobalInt target;
  target.setpoint.frame = mavlink::MavFrame::global;
  target.setpoint.ignore = heading ? place_alone : place_alone | without_yaw;
  target.setpoint.lat_rad = place.lat_rad;
  target.setpoint.lon_rad = place.lon_rad;
  target.setpoint.alt_m = place.alt_m;
  target.setpoint.yaw_rad = heading.value_or(0.0);
  return target;
}

}  // namespace

base::Result<mavlink::SetPositionTargetGlobalInt> setpoint_of(bus::PoseStamped const& wanted, geo::Wgs84 origin) {
  auto const& place = wanted.pose.position;
  auto const is_sound = [](double metres) { return std::isfinite(metres) && std::abs(metres) <= furthest_m; };
  if (!is_sound(place.x) || !is_sound(place.y) || !is_sound(place.z))
    return base::fail(base::ErrorKind::invalid_input, "a local setpoint that is no place");
  return target_at(geo::LocalFrame(origin).place_at(ned_from(place)), wanted.pose.orientation);
}

base::Result<mavlink::SetPositionTargetGlobalInt> setpoint_of(bus::GeoPoseStamped const& wanted, double geoid_m) {
  auto const& place = wanted.pose.position;
  bool const is_sound = std::abs(place.latitude) <= 90.0 && std::abs(place.longitude) <= 180.0 &&
                        std::isfinite(place.altitude) && std::abs(place.altitude) <= furthest_m;
  if (!is_sound) return base::fail(base::ErrorKind::invalid_input, "a global setpoint that is no place on Earth");
  return target_at(geo::Wgs84::from_degrees(place.latitude, place.longitude, place.altitude - geoid_m),
                   wanted.pose.orientation);
}

}  // namespace lapwing::bridge
