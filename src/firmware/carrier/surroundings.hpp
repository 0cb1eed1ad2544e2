#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>

#include "firmware/board.hpp"
#include "firmware/carrier/tuning.hpp"
#include "firmware/frames/description.hpp"

namespace lapwing::firmware {

/// No sensor sees anything on the way: however far the body goes on, nothing comes nearer.
float constexpr nothing_near_m = std::numeric_limits<float>::infinity();

/// How far the hull can go straight on before it touches what is seen; below zero where that is inside of it.
struct Clearance {
  float ahead_m = nothing_near_m;
  float back_m = nothing_near_m;
};

/// What sonars and laser see, as the way that is free.
///
/// A sonar's echo may come from anywhere on the arc of its cone: the arc's middle is taken for a thing, and so is the
/// place on it that is most in the way. Its outer end is not: a wall ahead would seem nearer by it than it is.
class Surroundings {
 public:
  Surroundings(Description const& description, Tuning const& tuning);

  void hear(std::span<std::uint16_t const> echoes_us);
  /// `way_m`: how far the body has gone until the scan. What is ahead comes nearer as it goes on.
  void see(LaserScan const& scan, float way_m);
  [[nodiscard]] Clearance clearance(float way_m) const;

 private:
  [[nodiscard]] bool is_inside(float x_m, float y_m) const;
  void narrow(Clearance& clearance, float x_m, float y_m) const;

  Description description_;
  float half_path_m_;
  Clearance by_sonar_;
  Clearance by_laser_;
  float scanned_at_m_ = 0;
};

}  // namespace lapwing::firmware
