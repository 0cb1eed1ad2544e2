#pragma once

#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/async/loop.hpp"
#include "base/async/scope.hpp"
#include "bus/messages/navigation.hpp"
#include "bus/participant/topics.hpp"
#include "robot/platform/body.hpp"

namespace lapwing::robot::ros {

/// A map as ROS has it: -1 where nothing is known, else 0 free or 100 taken, as the robot's planner takes it (map
/// servers and costmaps take 65 and 100 for the least that is a wall). No larger than what was seen.
[[nodiscard]] bus::OccupancyGrid grid_message(map::OccupancyGrid const& grid);

/// What a robot has made of its floor, for those who look on with ROS 2, by the names that its mappers and planners
/// have: `map` (nav_msgs/OccupancyGrid, latched), `pose` (geometry_msgs/PoseWithCovarianceStamped), `plan`
/// (nav_msgs/Path), and on /tf the frame of its odometry in that of its map (REP 105), which begins where the robot
/// does. Stamps are those of its odometry, whatever clock that goes by. Thread-bound.
class RosShown {
 public:
  /// The bus outlives it. Errors: those of the topics.
  [[nodiscard]] static base::Result<std::unique_ptr<RosShown>> open(base::Loop& loop, bus::Bus& bus,
                                                                    std::string const& name_space);
  RosShown(RosShown const&) = delete;
  RosShown& operator=(RosShown const&) = delete;
  /// It follows no way any more.
  ~RosShown();

  /// As its odometry was told last; before that nothing is shown. The map's frame is called after it: robot1/map beside
  /// robot1/odom.
  void set_odometry(std::chrono::nanoseconds stamp, std::string const& frame);
  /// `tf_topic`: where its own frames are told.
  void show_pose(PoseOnMap const& here, std::string const& tf_topic);
  void show_map(map::OccupancyGrid const& grid) { grid_ = grid; }
  void show_way(std::vector<Place> const& points) { way_ = points; }

 private:
  RosShown(base::Loop& loop, bus::Bus& bus) : loop_(loop), bus_(bus), scope_(loop) {}
  [[nodiscard]] bus::Header header() const;
  base::Task<> keep_telling();
  void tell_way();

  base::Loop& loop_;
  bus::Bus& bus_;
  std::optional<bus::Publisher<bus::OccupancyGrid>> maps_;
  std::optional<bus::Publisher<bus::PoseWithCovarianceStamped>> poses_;
  std::optional<bus::Publisher<bus::Path>> ways_;
  std::optional<bus::Publisher<bus::TFMessage>> frames_;
  std::chrono::nanoseconds stamp_{};
  std::string odometry_frame_;
  std::string map_frame_;
  std::optional<map::OccupancyGrid> grid_;  ///< that has not been told
  std::vector<Place> way_;
  std::optional<std::vector<Place>> told_way_;
  base::TimePoint mapped_at_{};
  base::Scope scope_;
};

}  // namespace lapwing::robot::ros
