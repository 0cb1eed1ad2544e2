#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "scans/bag_contents.hpp"
#include "slam/log/scan_log.hpp"
#include "slam/relations.hpp"

namespace lapwing::apps {

/// What a robot recorded, and what is to be told of the reading.
struct RecordedLog {
  slam::ScanLog log;
  std::string scan_topic = {};            ///< of a bag
  std::string odometry = {};              ///< of a bag: from where
  std::vector<std::string> remarks = {};  ///< what was left out or taken for granted
};

/// The whole file. Errors: io; invalid_input beyond 4 GB.
[[nodiscard]] base::Result<std::string> read_file(std::filesystem::path const& path);

/// The error with the file's name before it.
[[nodiscard]] std::unexpected<base::Error> in_file(std::filesystem::path const& path, base::Error error);

/// True relative poses; none where the path is empty.
[[nodiscard]] base::Result<std::vector<slam::Relation>> read_relations(std::filesystem::path const& path);

/// Of the content of a text file, which is let go before this returns.
[[nodiscard]] base::Result<RecordedLog> read_text_log(std::filesystem::path const& path, std::string text);
[[nodiscard]] base::Result<RecordedLog> read_bag_log(std::filesystem::path const& path, scans::BagChoice const& choice);

}  // namespace lapwing::apps
