#pragma once

#include <deque>
#include <optional>

#include "base/time.hpp"
#include "video/camera/camera.hpp"

namespace lapwing::perceive {

/// Where the drone was in the last seconds, so that a picture counts from where it was taken and not from where the
/// drone is when it has been looked at.
class PoseTrack {
 public:
  /// What is no place, or not later than the one before, is left out; a clock that was set back begins anew.
  void add(base::UtcTime at, video::BodyPlace const& place);
  /// Between two poses: straight, and turned the shorter way. Nothing before the first and after the last, nor in a gap
  /// longer than half a second.
  [[nodiscard]] std::optional<video::BodyPlace> at(base::UtcTime time) const;
  /// Over the last third of a second.
  [[nodiscard]] double speed_m_s() const;

  struct Pose {
    base::UtcTime at;
    video::BodyPlace place;
  };
  /// Null before the first.
  [[nodiscard]] Pose const* newest() const { return poses_.empty() ? nullptr : &poses_.back(); }

 private:
  std::deque<Pose> poses_;
};

}  // namespace lapwing::perceive
