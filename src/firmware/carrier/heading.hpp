#pragma once

#include "firmware/board.hpp"
#include "firmware/carrier/angles.hpp"
#include "firmware/carrier/tuning.hpp"

namespace lapwing::firmware {

/// Which way the body faces, from the way it faced when the first sample came; and how fast it turns.
class Heading {
 public:
  explicit Heading(Tuning const& tuning) : patience_(tuning.imu_patience) {}

  void feel(Time now, ImuSample const& sample) {
    float const yaw = yaw_of(sample.orientation);
    if (!has_start_) start_rad_ = yaw;
    has_start_ = true;
    heading_rad_ = wrapped(yaw - start_rad_);
    rate_rad_s_ = sample.rate_rad_s.z;
    heard_ = now;
  }
  [[nodiscard]] bool is_silent(Time now) const { return !has_start_ || now - heard_ > patience_; }
  [[nodiscard]] float heading_rad() const { return heading_rad_; }
  [[nodiscard]] float rate_rad_s() const { return rate_rad_s_; }

 private:
  Time patience_;
  Time heard_{};
  bool has_start_ = false;
  float start_rad_ = 0;
  float heading_rad_ = 0;
  float rate_rad_s_ = 0;
};

}  // namespace lapwing::firmware
