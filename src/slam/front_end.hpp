#pragma once

#include <optional>
#include <vector>

#include "slam/graph.hpp"
#include "slam/match/align.hpp"
#include "slam/match/local_grid.hpp"
#include "slam/match/odometry_noise.hpp"
#include "slam/match/odometry_watch.hpp"
#include "slam/match/wall_compass.hpp"

namespace lapwing::slam {

struct FrontEndOptions {
  double key_step_m = 0.2;     ///< a key frame after so many metres
  double key_turn_rad = 0.12;  ///< or after such a turn
  int grid_frames = 10;        ///< so many key frames are what a new one is matched with
  /// Of one matched point, 1 / m^2: a tenth of what a 2 cm laser has, as beams err together. With a tenth of this,
  /// odometry that is out of step in turns outweighed the scans of a small room.
  double point_information = 250.0;
  double odometry_spread = 1.0;  ///< times what is usual
  bool may_freeze = true;        ///< odometry that stands still while the scans do not is late or stuck
  bool may_slip = true;          ///< what fits clearly better farther along the way speaks against the wheels
  bool may_be_refuted = true;    ///< what fits clearly better than odometry ever errs speaks against it
  bool heads_by_walls = false;   ///< which run in few directions; for who sees too little to hold a heading by
  double edge_share =
      0.1;  ///< of a key frame's information that its edge to the last one has, as neighbours err together
};

/// Follows the robot from key frame to key frame: predicts by odometry, searches around that, aligns points to lines.
class FrontEnd {
 public:
  explicit FrontEnd(FrontEndOptions const& options) : options_(options) {}

  /// Whether the robot has moved enough since the last key frame.
  [[nodiscard]] bool wants(Pose2 const& odometry) const;

  struct SeenMotion {
    Pose2 motion;
    bool is_sure;  ///< false along a bare corridor, where nothing shows it
  };
  /// How far the robot has moved since the last key frame by what it sees, whatever odometry says.
  [[nodiscard]] SeenMotion seen_motion(std::vector<KeyFrame> const& frames, std::vector<Pose2> const& poses,
                                       Frame const& frame);
  /// Whether that is enough for another key frame.
  [[nodiscard]] bool is_a_step(Pose2 const& motion) const;

  struct Step {
    Pose2 pose;                            ///< of the new key frame, in the map
    std::optional<Constraint> constraint;  ///< to the last one; none for the first
  };
  /// `frames`, `poses`: of all key frames so far, as they are known by now; the new one is not among them.
  /// `doubt`: what speaks against odometry since the last one.
  [[nodiscard]] Step add(std::vector<KeyFrame> const& frames, std::vector<Pose2> const& poses, Frame const& frame,
                         Pose2 const& odometry, OdometryDoubt doubt = OdometryDoubt::none);

  /// What the walls say of where the robot headed at each key frame, if it heads by them.
  [[nodiscard]] std::vector<HeldHeading> headings(Graph const& graph) {
    return options_.heads_by_walls ? compass_.headings(graph.frames, graph.poses) : std::vector<HeldHeading>();
  }

  [[nodiscard]] OdometryNoise const& noise() const { return noise_; }

  /// What it must know to go on from its last key frame.
  struct Memory {
    std::optional<Pose2> last_odometry;  ///< of that key frame; none before the first
    Pose2 last_motion;                   ///< from the one before it
    OdometryNoise::Memory noise;
  };
  [[nodiscard]] Memory memory() const {
    return {.last_odometry = last_odometry_, .last_motion = last_motion_, .noise = noise_.memory()};
  }
  void remember(Memory const& memory);
  /// The next key frame is the first of another drive, and was taken there.
  void begin_at(Pose2 const& start);

 private:
  struct Guess {
    Pose2 pose;
    OdometryNoise::Spread spread;
  };
  struct Found {
    Pose2 pose;
    double fit;
    bool has_slipped;  ///< far from where odometry has it
  };
  void draw_last(std::vector<KeyFrame> const& frames, std::vector<Pose2> const& poses, Pose2 const& around);
  [[nodiscard]] Guess by_odometry(Pose2 const& last, Pose2 const& driven) const;
  [[nodiscard]] Guess by_walls(std::vector<KeyFrame> const& frames, std::vector<Pose2> const& poses, Frame const& frame,
                               Guess guess);
  /// Whether this step of odometry is better not looked at.
  [[nodiscard]] bool is_misleading(Pose2 const& driven, OdometryDoubt doubt, Frame const& last, Frame const& now);
  [[nodiscard]] Found search(Frame const& frame, Guess const& guess) const;
  [[nodiscard]] Alignment lay_on_last(std::vector<KeyFrame> const& frames, std::vector<Pose2> const& poses,
                                      Frame const& frame, Pose2 const& found, Guess const& guess) const;

  FrontEndOptions options_;
  OdometryNoise noise_;
  WallCompass compass_;
  double heading_sigma_rad_ = 0.0;  ///< against the building's walls: it grows from one that was seen to the next
  LocalGrid grid_;
  Pose2 last_motion_;       ///< of the key frame before last to the last
  bool is_frozen_ = false;  ///< odometry was, at the last key frame
  int distrusted_ = 0;      ///< for so many key frames, since odometry was found far wrong
  std::optional<Pose2> last_odometry_;
  std::optional<Pose2> start_;  ///< of a drive on a map that is there already
};

}  // namespace lapwing::slam
