#pragma once

#include <optional>
#include <vector>

#include "slam/key_frame.hpp"
#include "slam/pose2.hpp"

namespace lapwing::slam {

/// The direction in which most of a frame's walls run, or stand at right angles to.
struct WallDirection {
  double rad = 0.0;        ///< in the robot's frame, within an eighth of a turn of straight ahead
  double sigma_rad = 0.0;  ///< how sure it is
};
/// Nothing where they run in no common direction, or few are seen.
[[nodiscard]] std::optional<WallDirection> direction_of_walls(Frame const& frame);

/// A heading and how sure it is.
struct Heading {
  double yaw_rad = 0.0;
  double sigma_rad = 0.0;
};

/// The heading that a key frame is to have.
struct HeldHeading {
  int frame = 0;
  Heading heading;
};

/// Holds the heading of a robot that hears little at a time by the walls of a building, which run in few directions,
/// most often in two at right angles (a Manhattan world: Coughlan and Yuille, "Manhattan World: Compass Direction from
/// a Single Image by Bayesian Inference", 1999). A wing that stands at another angle has directions of its own.
///
/// A direction is learned when ten key frames have shown it, and stays: at first wheels and gyroscope know better where
/// a robot heads than the few walls that it has passed, and later everything may turn a little against where it began.
class WallCompass {
 public:
  /// What the walls say of where the robot heads that saw `frame` and was `expected` to head there; nothing where they
  /// say nothing. `frames`, `poses`: of all key frames so far, as they are known by now.
  /// Precondition, here and below: none was let go since.
  [[nodiscard]] std::optional<Heading> heading(std::vector<KeyFrame> const& frames, std::vector<Pose2> const& poses,
                                               Frame const& frame, Heading const& expected);
  /// What they say of all key frames.
  [[nodiscard]] std::vector<HeldHeading> headings(std::vector<KeyFrame> const& frames, std::vector<Pose2> const& poses);

 private:
  void learn(std::vector<KeyFrame> const& frames, std::vector<Pose2> const& poses);
  /// How far it is to the nearest known direction, if one is as near as that.
  [[nodiscard]] std::optional<double> nearest(double angle_rad, double within_rad) const;

  std::vector<std::optional<WallDirection>> known_;  ///< of the key frames so far
  std::vector<double> directions_;                   ///< of the building, as angles on the map
};

}  // namespace lapwing::slam
