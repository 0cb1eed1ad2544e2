#pragma once

#include <functional>
#include <span>
#include <vector>

#include "sim/building/noise.hpp"
#include "sim/building/scene/solids.hpp"

namespace lapwing::sim::building {

/// The leaves of a building's doors, as they stand and move. A leaf that would touch somebody waits.
class Doors {
 public:
  Doors(std::span<DoorPlan const> plans, std::vector<DoorFrame> frames, std::uint64_t seed);

  /// `stands_in_way(ring)`: somebody stands where the leaf would be.
  void step(double seconds, std::function<bool(std::vector<Place> const&)> const& stands_in_way);
  /// Turns that door to an angle, now or as soon as nobody stands in its way, and keeps it there for good.
  void hold(std::size_t door, double angle_rad);

  [[nodiscard]] std::span<DoorFrame const> frames() const { return frames_; }
  [[nodiscard]] double angle_rad(std::size_t door) const { return states_[door].angle_rad; }
  /// The leaves' faces at any height below the lintels.
  [[nodiscard]] std::span<Face const> faces() const { return faces_; }
  /// Counts every time that a leaf moved.
  [[nodiscard]] std::uint64_t revision() const { return revision_; }

 private:
  struct State {
    double angle_rad = 0.0;
    double wanted_rad = 0.0;
    double most_rad = 0.0;  ///< how far it is opened
    std::optional<DoorHabit> habit;
    double changes_in_s = 0.0;
    Noise noise;
  };
  static constexpr double speed_rad_s = 0.9;
  void draw(std::size_t door);

  std::vector<DoorFrame> frames_;
  std::vector<State> states_;
  std::vector<Face> faces_;
  std::uint64_t revision_ = 0;
};

}  // namespace lapwing::sim::building
