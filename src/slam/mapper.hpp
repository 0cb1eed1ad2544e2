#pragma once

#include <functional>
#include <optional>
#include <string_view>

#include "slam/graph.hpp"
#include "slam/grid/draw_grid.hpp"
#include "slam/log/scan_log.hpp"
#include "slam/loops/loop_closer.hpp"
#include "slam/match/scan_odometry.hpp"
#include "slam/robot_kind.hpp"
#include "slam/state/saved_map.hpp"

namespace lapwing::slam {

/// What a log came to.
struct Mapping {
  Graph graph;
  std::vector<Pose2> trajectory;  ///< one a scan; of a mapping that went on, those of earlier drives before
  LoopCounts loops;               ///< of all drives
  std::vector<LoopRecord> loop_records;
  MapMemory memory;  ///< with which a further drive goes on
};

/// `share`: how much of the work is done, 0 to 1.
using Progress = std::function<void(std::string_view stage, double share)>;

/// A map that grows scan by scan. It knows no clock and no thread; who wants the answer of `follow` at once does
/// `close_loops` when there is time, on any thread, but never both at once.
class Mapper {
 public:
  Mapper(MapperOptions const& options, RobotKind const& kind, ForEach for_each);
  /// One that goes on; `begin_drive` comes next.
  Mapper(SavedMap saved, ForEach for_each);

  /// What follows is of a further drive. `start`: of its first scan, on the map; nothing: it goes on in the odometry
  /// of the last one. Precondition: something is mapped.
  void begin_drive(RobotKind const& kind, std::optional<Pose2> const& start);

  /// The robot's pose at that scan, by what is known now. Takes a few milliseconds however large the map is.
  Pose2 follow(Scan const& scan, Sensor const& sensor);
  /// Looks for places where the robot has been before, if there is reason to. True: a loop was closed, so that every
  /// pose has changed. Takes the longer the larger the map. Key frames of places that have been seen often enough since
  /// are let go, so that those of the graph have other numbers then.
  bool close_loops();

  [[nodiscard]] Pose2 pose() const;
  [[nodiscard]] Graph const& graph() const { return graph_; }
  [[nodiscard]] LoopCloser const& loops() const { return loops_; }
  /// What all key frames have seen, drawn from where they stand now.
  [[nodiscard]] map::OccupancyGrid grid(BeamModel const& model) const;
  /// The last scan's odometry: as it was told, or made of scans.
  [[nodiscard]] Pose2 const& odometry() const { return odometry_; }
  [[nodiscard]] MapperOptions const& options() const { return options_; }
  [[nodiscard]] RobotKind const& kind() const { return kind_; }
  /// Driven in the last drive, by its key frames.
  [[nodiscard]] double driven_m() const {
    return graph_.frames.empty() ? 0.0 : graph_.frames.back().path_m - began_at_m_;
  }
  /// Key frames that were let go, in order of their scans, and where they are by now.
  [[nodiscard]] std::vector<WayPoint> gone() const;

  /// After the last scan: what still can be closed, then all key frames aligned at once.
  void finish(Progress const& progress);
  /// With which another mapper goes on. `past` and `drives` are those of earlier drives: of the last one the caller
  /// knows more.
  [[nodiscard]] SavedMap take() &&;

 private:
  void add_key_frame(Frame frame, Scan const& scan, Sensor const& sensor, OdometryDoubt doubt);
  void hold_to_map();
  void let_go_of_redundant();
  [[nodiscard]] double path_to(Pose2 const& pose) const;

  MapMemory memory_;  ///< what an earlier drive left, and what a later one is to find
  MapperOptions options_;
  RobotKind kind_;
  ForEach for_each_;
  Graph graph_;
  FrontEnd front_end_;
  LoopCloser loops_;
  ScanOdometry scan_odometry_;
  OdometryWatch watch_;
  Gatherer gatherer_;
  ScanLog seen_;  ///< the key frames' scans
  int scans_ = 0;
  Pose2 odometry_;
  LogTime time_{0.0};
  bool begins_drive_ = false;  ///< the next key frame does, on a map that is there already
  Pose2 key_odometry_;
  bool is_new_ = false;  ///< the last key frame has not been looked for elsewhere
  struct Gone {
    int scan;
    int heir;
    Pose2 in_heir;
  };
  std::vector<Gone> gone_;   ///< key frames of this drive that were let go
  double began_at_m_ = 0.0;  ///< of the way, the last drive
  int until_let_go_ = 0;     ///< key frames, until it is looked for what else can be
};

/// Maps a log: follows the robot, closes loops as they come, then refines everything together. The same result on any
/// number of threads.
[[nodiscard]] Mapping map_log(ScanLog const& log, MapperOptions const& options, ForEach const& for_each,
                              Progress const& progress);

/// The same with a mapper that has just begun, or begun a further drive.
[[nodiscard]] Mapping map_drive(Mapper mapper, ScanLog const& log, ForEach const& for_each, Progress const& progress);

}  // namespace lapwing::slam
