#pragma once

#include "map/live/live_map.hpp"
#include "robot/platform/robot_platform.hpp"
#include "station/feeds/whole_text_feed.hpp"

namespace lapwing::host {

/// What robots intend and know of their floor, for a layer of the map: the way ahead, the open frontiers, how sure each
/// is of its place (docs/reference/station-messages.md). Where they are is among the vehicles, their maps among the
/// grids.
class RobotsFeed final : public station::WholeTextFeed {
 public:
  /// Both outlive it.
  RobotsFeed(robot::RobotPlatform const& robots, ::lapwing::map::LiveMap const& map) : robots_(robots), map_(map) {}

  [[nodiscard]] std::string_view name() const override { return "robots"; }

 private:
  [[nodiscard]] std::string text() const override;

  robot::RobotPlatform const& robots_;
  ::lapwing::map::LiveMap const& map_;
};

}  // namespace lapwing::host
