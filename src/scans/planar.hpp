#pragma once

#include <map>
#include <optional>
#include <string>

#include "bus/messages/common.hpp"
#include "slam/pose2.hpp"

/// What a robot on a floor needs of three-dimensional frames.
namespace lapwing::scans {

/// A frame in the plane of another: where it lies, and whether it hangs upside down, so that what turns to the left in
/// it turns to the right in the other.
struct PlanarFrame {
  slam::Pose2 pose = {};
  bool is_upside_down = false;
  friend bool operator==(PlanarFrame const&, PlanarFrame const&) = default;
};

/// The heading of the x axis, counterclockwise from that of the frame around it.
[[nodiscard]] double yaw_of(bus::Quaternion const& rotation);
/// The rotation that turns to that heading.
[[nodiscard]] bus::Quaternion rotation_to(double yaw_rad);
[[nodiscard]] PlanarFrame planar(bus::Transform const& transform);

/// The frames that do not move against each other, as /tf_static tells them.
class StaticFrames {
 public:
  void take(bus::TFMessage const& message);
  /// Where `frame` lies in `base`; nothing while no chain of parents leads from one to the other.
  [[nodiscard]] std::optional<PlanarFrame> find(std::string const& frame, std::string const& base) const;
  [[nodiscard]] bool knows(std::string const& frame) const { return links_.contains(frame); }
  /// The last of the chain of its parents; the frame itself where it has none.
  [[nodiscard]] std::string root_of(std::string frame) const;

 private:
  struct Link {
    std::string parent;
    PlanarFrame in_parent;
  };
  std::map<std::string, Link> links_;
};

}  // namespace lapwing::scans
