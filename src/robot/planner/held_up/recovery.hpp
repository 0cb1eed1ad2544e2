#pragma once

#include <optional>
#include <span>

#include "robot/planner/room.hpp"
#include "robot/planner/way.hpp"

namespace lapwing::robot {

/// What a robot does that is held up though its way is free, one step at each call for help: back a little, back along
/// the way that it came, out to where its laser shows the most room; then the same again, farther.
class Recovery {
 public:
  struct Now {
    double time_s = 0.0;
    slam::Pose2 pose = {};
    Room const& room;
    std::span<slam::Pose2 const> driven = {};
    double radius_m = 0.0;
  };
  void begin(Now const& now);
  /// It gets on again: the next time begins with the first step.
  void rest() { *this = {}; }
  /// How often since it got on.
  [[nodiscard]] int tried() const { return tried_; }

  /// What to do now; nothing when the step is over.
  [[nodiscard]] std::optional<Way> way(Now const& now);

 private:
  [[nodiscard]] Way along_track(Now const& now) const;
  [[nodiscard]] Way into_the_open(Now const& now) const;

  int tried_ = 0;
  std::optional<Way> way_;
  double until_s_ = 0.0;
  double far_m_ = 0.0;
  Place from_ = {};
};

}  // namespace lapwing::robot
