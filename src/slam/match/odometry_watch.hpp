#pragma once

#include "slam/log/scan_log.hpp"
#include "slam/pose2.hpp"

namespace lapwing::slam {

/// What speaks against odometry, beyond what it says itself.
enum class OdometryDoubt {
  none,
  has_leapt,   ///< it has moved as no robot does: counters that began anew, or a gap in the recording
  has_frozen,  ///< it says the same again and again while what is seen changes: it comes late, or its wheels are lifted
  has_spun,    ///< wheels have turned and what is seen has stayed: the robot stands, or nearly so
};

/// Whether that is next to nothing: what spinning wheels tell of a robot that slides, or noise.
[[nodiscard]] bool is_rest(Pose2 const& motion);

/// Watches what a robot's odometry says from scan to scan.
class OdometryWatch {
 public:
  /// `elapsed`: since the scan before.
  void follow(Pose2 const& odometry, LogTime elapsed);
  /// What is said next has nothing to do with what was said before.
  void begin_drive() { is_first_ = true; }
  /// A key frame was taken; what was seen until then is dealt with.
  void begin_key_frame() { has_leapt_ = false; }
  /// The robot was seen to stand, as odometry says. `is_sure`: else it is looked at again, ever less often.
  void found_still(bool is_sure);

  [[nodiscard]] bool has_leapt() const { return has_leapt_; }  ///< since the last key frame
  /// It has said the same for so long that it is worth a look whether the robot stands.
  [[nodiscard]] bool is_suspiciously_still() const;

 private:
  Pose2 odometry_;
  Pose2 rest_;             ///< what it said when it came to rest
  LogTime still_{0.0};     ///< since it moved, or was found to stand
  LogTime patience_{0.0};  ///< after which it is suspicious
  bool is_first_ = true;
  bool has_leapt_ = false;
};

}  // namespace lapwing::slam
