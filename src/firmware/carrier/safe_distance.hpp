#pragma once

#include "firmware/board_time.hpp"
#include "firmware/carrier/surroundings.hpp"
#include "firmware/carrier/tuning.hpp"

namespace lapwing::firmware {

/// The speed along the way that is safe, whatever was asked for (the seed's CAR_MR_04).
///
/// Towards a thing at clearance c the speed stays at what lets the body stand at s, the safe distance and a little
/// more: the v with v t + v²/(2a) = c - s for reaction t and braking a, so v = a (√(t² + 2(c - s)/a) - t). Nearer than
/// the safe distance, and asked to go towards the thing, the body goes the opposite way until it is farther than s.
class SafeDistance {
 public:
  SafeDistance(Tuning const& tuning, float braking_m_s2) : tuning_(tuning), braking_m_s2_(braking_m_s2) {}

  struct Answer {
    float speed_m_s = 0;
    bool rules = false;  ///< the body stands or goes back because something is too near
    bool has_gone_back_too_far = false;
  };
  /// `wanted_m_s`: by the command. `way_m`: how far the body has gone.
  [[nodiscard]] Answer limit(Time now, float wanted_m_s, Clearance const& clearance, float way_m);
  /// No command: what was too near is forgotten.
  void rest();

 private:
  enum class Away { none, back, ahead };
  [[nodiscard]] float allowed(float clearance_m) const;
  [[nodiscard]] bool is_believed(Time now, bool is_near);
  [[nodiscard]] Answer go_away(Clearance const& clearance, float way_m);

  Tuning tuning_;
  float braking_m_s2_;
  Away away_ = Away::none;
  float began_at_m_ = 0;
  bool is_near_ = false;
  bool is_held_ = false;
  Time near_since_{};
};

}  // namespace lapwing::firmware
