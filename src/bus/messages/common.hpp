#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "bus/messages/description.hpp"

/// What the other messages are made of: builtin_interfaces, std_msgs and geometry_msgs.
namespace lapwing::bus {

/// Since the epoch of whoever's clock it is: UTC, or that of a simulation.
struct Time {
  std::int32_t sec = 0;
  std::uint32_t nanosec = 0;
  friend bool operator==(Time const&, Time const&) = default;
};
template <>
struct Description<Time> {
  static constexpr std::string_view name = "builtin_interfaces/msg/Time";
  static constexpr auto fields = std::tuple{Field{"sec", &Time::sec}, Field{"nanosec", &Time::nanosec}};
};

struct Header {
  Time stamp = {};
  std::string frame_id = {};
  friend bool operator==(Header const&, Header const&) = default;
};
template <>
struct Description<Header> {
  static constexpr std::string_view name = "std_msgs/msg/Header";
  static constexpr auto fields = std::tuple{Field{"stamp", &Header::stamp}, Field{"frame_id", &Header::frame_id}};
};

struct Bool {
  bool data = false;
  friend bool operator==(Bool const&, Bool const&) = default;
};
template <>
struct Description<Bool> {
  static constexpr std::string_view name = "std_msgs/msg/Bool";
  static constexpr auto fields = std::tuple{Field{"data", &Bool::data}};
};

struct String {
  std::string data = {};
  friend bool operator==(String const&, String const&) = default;
};
template <>
struct Description<String> {
  static constexpr std::string_view name = "std_msgs/msg/String";
  static constexpr auto fields = std::tuple{Field{"data", &String::data}};
};

struct Float64 {
  double data = 0.0;
  friend bool operator==(Float64 const&, Float64 const&) = default;
};
template <>
struct Description<Float64> {
  static constexpr std::string_view name = "std_msgs/msg/Float64";
  static constexpr auto fields = std::tuple{Field{"data", &Float64::data}};
};

struct Point {
  double x = 0.0;
  double y = 0.0;
  double z = 0.0;
  friend bool operator==(Point const&, Point const&) = default;
};
template <>
struct Description<Point> {
  static constexpr std::string_view name = "geometry_msgs/msg/Point";
  static constexpr auto fields = std::tuple{Field{"x", &Point::x}, Field{"y", &Point::y}, Field{"z", &Point::z}};
};

struct Vector3 {
  double x = 0.0;
  double y = 0.0;
  double z = 0.0;
  friend bool operator==(Vector3 const&, Vector3 const&) = default;
};
template <>
struct Description<Vector3> {
  static constexpr std::string_view name = "geometry_msgs/msg/Vector3";
  static constexpr auto fields = std::tuple{Field{"x", &Vector3::x}, Field{"y", &Vector3::y}, Field{"z", &Vector3::z}};
};

struct Quaternion {
  double x = 0.0;
  double y = 0.0;
  double z = 0.0;
  double w = 1.0;
  friend bool operator==(Quaternion const&, Quaternion const&) = default;
};
template <>
struct Description<Quaternion> {
  static constexpr std::string_view name = "geometry_msgs/msg/Quaternion";
  static constexpr auto fields = std::tuple{Field{"x", &Quaternion::x}, Field{"y", &Quaternion::y},
                                            Field{"z", &Quaternion::z}, Field{"w", &Quaternion::w}};
};

struct Pose {
  Point position = {};
  Quaternion orientation = {};
  friend bool operator==(Pose const&, Pose const&) = default;
};
template <>
struct Description<Pose> {
  static constexpr std::string_view name = "geometry_msgs/msg/Pose";
  static constexpr auto fields =
      std::tuple{Field{"position", &Pose::position}, Field{"orientation", &Pose::orientation}};
};

/// The covariances of poses and twists are 6 x 6, row by row: x, y, z and the rotations about these axes.
using Covariance = std::array<double, 36>;

struct PoseWithCovariance {
  Pose pose = {};
  Covariance covariance = {};
  friend bool operator==(PoseWithCovariance const&, PoseWithCovariance const&) = default;
};
template <>
struct Description<PoseWithCovariance> {
  static constexpr std::string_view name = "geometry_msgs/msg/PoseWithCovariance";
  static constexpr auto fields =
      std::tuple{Field{"pose", &PoseWithCovariance::pose}, Field{"covariance", &PoseWithCovariance::covariance}};
};

struct PoseWithCovarianceStamped {
  Header header = {};
  PoseWithCovariance pose = {};
  friend bool operator==(PoseWithCovarianceStamped const&, PoseWithCovarianceStamped const&) = default;
};
template <>
struct Description<PoseWithCovarianceStamped> {
  static constexpr std::string_view name = "geometry_msgs/msg/PoseWithCovarianceStamped";
  static constexpr auto fields =
      std::tuple{Field{"header", &PoseWithCovarianceStamped::header}, Field{"pose", &PoseWithCovarianceStamped::pose}};
};

struct PoseStamped {
  Header header = {};
  Pose pose = {};
  friend bool operator==(PoseStamped const&, PoseStamped const&) = default;
};
template <>
struct Description<PoseStamped> {
  static constexpr std::string_view name = "geometry_msgs/msg/PoseStamped";
  static constexpr auto fields = std::tuple{Field{"header", &PoseStamped::header}, Field{"pose", &PoseStamped::pose}};
};

/// A speed: ahead along x, to the left along y, upwards along z, and the rotations about them.
struct Twist {
  Vector3 linear = {};
  Vector3 angular = {};
  friend bool operator==(Twist const&, Twist const&) = default;
};
template <>
struct Description<Twist> {
  static constexpr std::string_view name = "geometry_msgs/msg/Twist";
  static constexpr auto fields = std::tuple{Field{"linear", &Twist::linear}, Field{"angular", &Twist::angular}};
};

struct TwistStamped {
  Header header = {};
  Twist twist = {};
  friend bool operator==(TwistStamped const&, TwistStamped const&) = default;
};
template <>
struct Description<TwistStamped> {
  static constexpr std::string_view name = "geometry_msgs/msg/TwistStamped";
  static constexpr auto fields =
      std::tuple{Field{"header", &TwistStamped::header}, Field{"twist", &TwistStamped::twist}};
};

struct TwistWithCovariance {
  Twist twist = {};
  Covariance covariance = {};
  friend bool operator==(TwistWithCovariance const&, TwistWithCovariance const&) = default;
};
template <>
struct Description<TwistWithCovariance> {
  static constexpr std::string_view name = "geometry_msgs/msg/TwistWithCovariance";
  static constexpr auto fields =
      std::tuple{Field{"twist", &TwistWithCovariance::twist}, Field{"covariance", &TwistWithCovariance::covariance}};
};

struct Transform {
  Vector3 translation = {};
  Quaternion rotation = {};
  friend bool operator==(Transform const&, Transform const&) = default;
};
template <>
struct Description<Transform> {
  static constexpr std::string_view name = "geometry_msgs/msg/Transform";
  static constexpr auto fields =
      std::tuple{Field{"translation", &Transform::translation}, Field{"rotation", &Transform::rotation}};
};

/// Where the frame `child_frame_id` lies in that of the header.
struct TransformStamped {
  Header header = {};
  std::string child_frame_id = {};
  Transform transform = {};
  friend bool operator==(TransformStamped const&, TransformStamped const&) = default;
};
template <>
struct Description<TransformStamped> {
  static constexpr std::string_view name = "geometry_msgs/msg/TransformStamped";
  static constexpr auto fields =
      std::tuple{Field{"header", &TransformStamped::header}, Field{"child_frame_id", &TransformStamped::child_frame_id},
                 Field{"transform", &TransformStamped::transform}};
};

struct TFMessage {
  std::vector<TransformStamped> transforms = {};
  friend bool operator==(TFMessage const&, TFMessage const&) = default;
};
template <>
struct Description<TFMessage> {
  static constexpr std::string_view name = "tf2_msgs/msg/TFMessage";
  static constexpr auto fields = std::tuple{Field{"transforms", &TFMessage::transforms}};
};

}  // namespace lapwing::bus
