#pragma once

#include <memory>
#include <set>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "map/grid/occupancy_grid.hpp"
#include "robot/mapping/map_shift.hpp"
#include "slam/front_end.hpp"
#include "slam/grid/draw_grid.hpp"
#include "slam/loops/loop_closer.hpp"
#include "slam/prune/prune_options.hpp"
#include "slam/refine/joint.hpp"
#include "slam/scan/gather.hpp"

namespace lapwing::robot {

struct MappingOptions {
  slam::FrameOptions frame;
  /// Of logs nobody knows what their wheels are worth; a robot's own odometry is good to a few percent of the way. Held
  /// to less, or doubted where scans fit better elsewhere, somebody who walks along a corridor beside the robot,
  /// towards it, or before it while it waits, takes its place on the map with them. Sensors that are stuck and wheels
  /// that slip its watchdog names; wheels that spin on the spot are seen all around (`stands_still`).
  slam::FrontEndOptions front_end = {
      .odometry_spread = 0.25, .may_freeze = false, .may_slip = false, .may_be_refuted = false};
  bool leaves_out_who_walks = true;  ///< of what is laid on what: `without_who_walks`
  slam::LoopOptions loops;
  /// A robot that explores comes through a corridor again and again, and its nearest key frames are copies.
  slam::JointOptions joint = {.radius_m = 8.0, .apart_m = 1.5};
  /// Which of them are let go, so that a robot may drive about for days.
  slam::PruneOptions prune;
  /// Of a robot without a laser, with a few sonars or single rangers: what they saw on the way is joined to key frames.
  slam::GatherOptions gather;
  slam::BeamModel beam;
  /// Where the robot's map lies in its site. The map begins where the robot does, looking along x.
  geo::Transform<geo::SiteFrame, map::GridFrame> site_from_map = {};
  /// When loops have moved a key frame by more than that since it was drawn, the whole grid is drawn anew, which takes
  /// the longer the more there is of it: at once where it is far, else when the robot has got on by so much.
  double redraw_m = 0.04;
  double redraw_rad = 0.01;
  double far_m = 0.15;
  double far_rad = 0.04;
  double redraw_every_m = 5.0;
  /// All key frames are aligned at once when the robot has driven so much since, and such a share of its whole way:
  /// that takes the longer the more there are.
  double align_every_m = 30.0;
  double align_every_share = 0.3;
};

/// Where the robot is by its map.
struct Located {
  slam::Pose2 pose;
  /// Of x, y and yaw along the map's axes, in m^2 and rad^2: against the part of the map around it. What that part has
  /// drifted against the start since the last loop is not in it.
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
};

/// The map of one floor while a robot drives over it: each scan with the wheels' odometry in, where the robot is and
/// what is taken and free out. Nothing is known beforehand. Pure: the same scans give the same map.
///
/// A sensor of few beams sees too little at once to know a place by: what it sees over a metre or two of the way makes
/// a key frame (`slam::Gatherer`), and each scan is drawn.
class FloorMap {
 public:
  FloorMap(slam::Sensor sensor, MappingOptions options);

  /// Takes a scan in the order of time. Precondition: as many ranges as the sensor has beams.
  void add(slam::Scan scan);

  /// Whether it is time to align all key frames at once. `soon`: there is a reason to, if anything is new at all.
  [[nodiscard]] bool wants_alignment(bool soon) const;
  /// For what goes on beside this map. It counts as done from here on, and no key frame is let go until it is taken.
  [[nodiscard]] std::unique_ptr<slam::JointAlignment> begin_alignment();
  /// Takes what came of that; what was mapped meanwhile is carried along. Precondition: one pose each of the key frames
  /// that there were when it began.
  void take(std::vector<slam::Pose2> const& aligned);

  /// At the last scan; the origin before the first.
  [[nodiscard]] Located const& here() const { return here_; }
  /// Of the odometry of the last scan.
  [[nodiscard]] slam::Pose2 const& odometry() const { return odometry_; }
  [[nodiscard]] slam::Sensor const& sensor() const { return log_.sensors.front(); }
  [[nodiscard]] map::OccupancyGrid const& grid() const { return grid_; }
  /// The tiles that have changed since this was last asked.
  [[nodiscard]] std::vector<map::TileKey> take_changes();
  /// How it has moved since this was last asked, in the order in which it did.
  [[nodiscard]] std::vector<MapShift> take_shifts() { return std::exchange(shifts_, {}); }

  [[nodiscard]] slam::Graph const& graph() const { return graph_; }
  /// The way that it came, a few decimetres from place to place, as it is known by now.
  [[nodiscard]] std::vector<slam::Pose2> way() const;
  /// When a key frame's scan was taken.
  [[nodiscard]] slam::LogTime key_time(std::size_t frame) const { return key_times_[frame]; }
  [[nodiscard]] slam::LoopCounts loops() const { return loops_.counts(); }
  /// How often loops and alignments have made the grid be drawn anew.
  [[nodiscard]] int redrawn() const { return redrawn_; }

 private:
  void add_dense(slam::Scan scan);
  void add_sparse(slam::Scan scan);
  /// Precondition: the frame is what was seen at or before this scan, in the robot's frame at it.
  void add_key_frame(slam::Frame frame, slam::Scan scan, slam::OdometryDoubt doubt = slam::OdometryDoubt::none);
  void let_go_of_redundant();
  /// The scan is drawn from now on, from where it was taken beside the last key frame.
  void hold(slam::Scan scan);
  void draw_key_frame();
  void draw_last();
  [[nodiscard]] slam::Pose2 pose_of(std::size_t scan) const;
  [[nodiscard]] Located by_odometry(slam::Pose2 const& odometry) const;
  void redraw();
  [[nodiscard]] bool wants_redraw() const;

  MappingOptions options_;
  bool is_sparse_;
  slam::ScanLog log_;  ///< what the grid is drawn from: the key frames' scans, of sparse ones all that say anything new
  struct Hold {
    int frame;
    slam::Pose2 in_frame;
  };
  std::vector<Hold> holds_;              ///< of these scans: the key frame that each moves with
  std::size_t since_key_ = 0;            ///< the first of them that was taken after the last key frame
  std::vector<std::size_t> on_the_way_;  ///< of sparse ones: scans a key frame's usual step apart
  slam::Gatherer gatherer_;
  slam::FrontEnd front_end_;
  slam::LoopCloser loops_;
  slam::Graph graph_;
  std::vector<slam::LogTime> key_times_;
  slam::Pose2 key_odometry_;  ///< of the last key frame
  int key_frames_ = 0;        ///< that there ever were
  int until_let_go_ = 0;      ///< key frames, until it is looked for what can be let go
  bool is_aligning_ = false;
  double path_m_ = 0.0;
  double redrawn_at_m_ = 0.0;
  double aligned_at_m_ = 0.0;
  Eigen::Matrix3d key_covariance_ = Eigen::Matrix3d::Zero();
  std::vector<slam::Pose2> drawn_at_;
  map::OccupancyGrid grid_;
  std::set<map::TileKey> changed_;
  std::vector<MapShift> shifts_;
  Located here_;
  slam::Pose2 odometry_;
  int redrawn_ = 0;
};

}  // namespace lapwing::robot
