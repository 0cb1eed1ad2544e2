#pragma once

#include "bus/messages/common.hpp"

/// geographic_msgs: places on the globe.
namespace lapwing::bus {

struct GeoPoint {
  double latitude = 0.0;   ///< degrees, as ROS has it
  double longitude = 0.0;  ///< degrees
  double altitude = 0.0;   ///< metres above the ellipsoid
  friend bool operator==(GeoPoint const&, GeoPoint const&) = default;
};
template <>
struct Description<GeoPoint> {
  static constexpr std::string_view name = "geographic_msgs/msg/GeoPoint";
  static constexpr auto fields =
      std::tuple{Field{"latitude", &GeoPoint::latitude}, Field{"longitude", &GeoPoint::longitude},
                 Field{"altitude", &GeoPoint::altitude}};
};

struct GeoPose {
  GeoPoint position = {};
  Quaternion orientation = {};  ///< in east, north, up
  friend bool operator==(GeoPose const&, GeoPose const&) = default;
};
template <>
struct Description<GeoPose> {
  static constexpr std::string_view name = "geographic_msgs/msg/GeoPose";
  static constexpr auto fields =
      std::tuple{Field{"position", &GeoPose::position}, Field{"orientation", &GeoPose::orientation}};
};

struct GeoPoseStamped {
  Header header = {};
  GeoPose pose = {};
  friend bool operator==(GeoPoseStamped const&, GeoPoseStamped const&) = default;
};
template <>
struct Description<GeoPoseStamped> {
  static constexpr std::string_view name = "geographic_msgs/msg/GeoPoseStamped";
  static constexpr auto fields =
      std::tuple{Field{"header", &GeoPoseStamped::header}, Field{"pose", &GeoPoseStamped::pose}};
};

}  // namespace lapwing::bus
