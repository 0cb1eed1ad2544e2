#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "apps/slam/recorded_log.hpp"
#include "slam/pose2.hpp"

namespace lapwing::apps {

struct LocaliseOptions {
  std::filesystem::path map;         ///< a ROS map's .yaml; empty: a map is to be made
  std::optional<slam::Pose2> start;  ///< of the first scan on it; nothing: it is searched for
};

/// `x,y,heading`: metres and degrees, counterclockwise from the map's x axis. Error: invalid_input.
[[nodiscard]] base::Result<slam::Pose2> parse_start(std::string const& text);

/// Lays the scans of a log on a map that is there already and changes nothing in it: `trajectory.tum`, `fits.csv` and
/// `report.json` in that folder. Errors: invalid_input; io; lost: the robot was found nowhere on the map, after the
/// report was written.
[[nodiscard]] base::Result<> localise(RecordedLog recorded, std::vector<slam::Relation> const& relations,
                                      LocaliseOptions const& options, std::filesystem::path const& out);

}  // namespace lapwing::apps
