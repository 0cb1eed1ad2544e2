#pragma once

#include <cstdint>
#include <string>

namespace lapwing::robot::rover {

/// A laser on ROS 2 beside the autopilot.
struct LaserOnRos {
  std::uint32_t domain = 0;
  std::string name_space = {};  ///< "/robot1", before `/scan`; empty: none
  bool is_local = true;         ///< its ROS is on this machine
  friend bool operator==(LaserOnRos const&, LaserOnRos const&) = default;
};

}  // namespace lapwing::robot::rover
