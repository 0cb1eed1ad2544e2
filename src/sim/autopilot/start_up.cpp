#include "sim/autopilot/start_up.hpp"

namespace lapwing::sim {

using namespace std::chrono_literals;

namespace {
constexpr std::uint16_t flags_without_position = 0xA7;  // attitude, velocities, height, constant position
constexpr std::uint16_t flags_doubtful = 0x25;
constexpr std::uint16_t flags_with_position = 0x33F;
constexpr base::Duration ekf_patience = 8s;
constexpr base::Duration doubt_time = 4s;
/// A receiver that was cut off needs some seconds for a fix, the estimator some more to trust it.
constexpr base::Duration reacquire_time = 3s;
constexpr base::Duration trust_time = 6s;
}  // namespace

BootTimeline realistic_boot() {
  return {.first_heartbeat = 500ms,
          .ready_text = 2200ms,
          .standby = 2800ms,
          .ekf_initialised = 4200ms,
          .gps_fix = 9600ms,
          .origin_set = 19800ms,
          .prearm_ok = 23300ms,
          .position_ok = 41100ms};
}

BootTimeline quick_boot() {
  return {.first_heartbeat = 100ms,
          .ready_text = 300ms,
          .standby = 500ms,
          .ekf_initialised = 800ms,
          .gps_fix = 1200ms,
          .origin_set = 1600ms,
          .prearm_ok = 2s,
          .position_ok = 2800ms};
}

void StartUp::lose_gps(base::Duration since_boot) {
  gps_lost_at_ = since_boot;
  gps_back_at_ = base::Duration::max();
}

void StartUp::restore_gps(base::Duration since_boot) {
  if (gps_lost_at_ != base::Duration::max()) gps_back_at_ = since_boot;
}

bool StartUp::estimate_lost(base::Duration since_boot) const {
  if (gps_lost_at_ == base::Duration::max() || since_boot - gps_lost_at_ < ekf_patience) return false;
  if (gps_back_at_ == base::Duration::max()) return true;
  bool const gave_up = gps_back_at_ - gps_lost_at_ >= ekf_patience;
  return gave_up && since_boot - gps_back_at_ < trust_time;
}

Navigation StartUp::at(base::Duration since_boot) const {
  Navigation nav;
  bool const receiver_up = since_boot >= timeline_.gps_fix;
  bool const cut_off = gps_lost_at_ != base::Duration::max() && since_boot >= gps_lost_at_ &&
                       (gps_back_at_ == base::Duration::max() || since_boot < gps_back_at_ + reacquire_time);
  if (receiver_up) {
    nav.fix_type = cut_off ? 1 : 6;
    nav.satellites = cut_off ? 3 : 10;
  }
  nav.position_known = receiver_up;
  nav.yaw_settled = since_boot >= timeline_.position_ok;
  nav.position_ok = since_boot >= timeline_.position_ok && !estimate_lost(since_boot);
  if (nav.position_ok) {
    nav.ekf_flags = flags_with_position;
  } else if (estimate_lost(since_boot) && since_boot - gps_lost_at_ < ekf_patience + doubt_time) {
    nav.ekf_flags = flags_doubtful;
  } else if (since_boot >= timeline_.ekf_initialised) {
    nav.ekf_flags = flags_without_position;
  }
  return nav;
}

}  // namespace lapwing::sim
