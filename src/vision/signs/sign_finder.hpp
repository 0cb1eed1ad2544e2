#pragma once

#include <memory>
#include <vector>

#include <opencv2/core.hpp>

#include "vision/detection.hpp"
#include "vision/signs/reader.hpp"

namespace lapwing::vision {

/// Signs that say which room is behind a door: rows of letters, seen from the front, read by each reader, who vote.
class SignFinder {
 public:
  explicit SignFinder(std::vector<std::unique_ptr<LineReader>> readers);

  /// `pixels`: BGR, upright. Each is a "sign" with `text` (the number) or `kind`, or both.
  [[nodiscard]] std::vector<Detection> find(cv::Mat const& pixels);

 private:
  std::vector<std::unique_ptr<LineReader>> readers_;
};

/// Doors get the text and the kind of the sign on them or beside them, at most a door's width away; each sign goes to
/// one door, the nearest.
void name_doors(std::vector<Detection>& detections);

}  // namespace lapwing::vision
