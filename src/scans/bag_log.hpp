#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "scans/bag_contents.hpp"
#include "slam/log/scan_log.hpp"

namespace lapwing::scans {

/// A recording of ROS 2 as a log of scans.
struct BagLog {
  slam::ScanLog log;
  std::string scan_topic;
  std::string odometry;              ///< the topic, or "/tf (odom to base_link)"; empty: there is none
  std::vector<std::string> remarks;  ///< what was left out or taken for granted, each a sentence
};

/// Reads the laser's scans of a bag (docs/reference/slam.md), with the odometry at their moments and from where the
/// laser sits, as a robot on ROS is read while it drives: `path` is a file of either storage or a folder. Errors:
/// invalid_input, with the topics to choose from where there are several; not_found; io.
[[nodiscard]] base::Result<BagLog> read_bag(std::filesystem::path const& path, BagChoice const& choice);

/// The same of what was gathered already, which is used up.
[[nodiscard]] base::Result<BagLog> log_of(BagContents& contents);

}  // namespace lapwing::scans
