#pragma once

#include <cstdint>

#include "base/time.hpp"

namespace lapwing::sim {

/// When, counted from power-on, each stage of an autopilot's start is reached.
struct BootTimeline {
  base::Duration first_heartbeat{};
  base::Duration ready_text{};  ///< "ArduPilot Ready"
  base::Duration standby{};     ///< system status leaves its start value
  base::Duration ekf_initialised{};
  base::Duration gps_fix{};
  base::Duration origin_set{};  ///< home and origin are announced
  base::Duration prearm_ok{};
  base::Duration position_ok{};  ///< the EKF uses GPS: flags 0xA7 -> 0x33F
};

/// As timed on ArduCopter 4.6 in the loop: 41 s until the vehicle can be armed in GUIDED.
[[nodiscard]] BootTimeline realistic_boot();
/// The same stages in the same order within three seconds.
[[nodiscard]] BootTimeline quick_boot();

/// What the estimator and the GPS receiver say at one moment.
struct Navigation {
  std::uint8_t fix_type = 0;  ///< GPS_FIX_TYPE: 0 no GPS, 1 no fix, 6 RTK fixed
  std::uint8_t satellites = 0;
  std::uint16_t ekf_flags = 0;  ///< EKF_STATUS_FLAGS
  bool position_known = false;  ///< reports carry a real place (the receiver has or had a fix)
  bool position_ok = false;     ///< the estimator has an absolute position: may arm and fly by it
  bool yaw_settled = false;
};

/// The navigation part of an autopilot's life: start-up by the timeline, then GPS loss and recovery.
class StartUp {
 public:
  explicit StartUp(BootTimeline const& timeline) : timeline_(timeline) {}

  void lose_gps(base::Duration since_boot);
  void restore_gps(base::Duration since_boot);

  [[nodiscard]] BootTimeline const& timeline() const { return timeline_; }
  [[nodiscard]] Navigation at(base::Duration since_boot) const;
  /// The estimator has given up on the position: eight seconds after the GPS was lost.
  [[nodiscard]] bool estimate_lost(base::Duration since_boot) const;

 private:
  BootTimeline timeline_;
  base::Duration gps_lost_at_ = base::Duration::max();
  base::Duration gps_back_at_ = base::Duration::max();
};

}  // namespace lapwing::sim
