#pragma once

#include <vector>

#include "slam/key_frame.hpp"

namespace lapwing::slam {

/// What has been mapped so far: key frames, where they stand, and what was measured between them.
struct Graph {
  std::vector<KeyFrame> frames;
  std::vector<Pose2> poses;
  std::vector<Constraint> constraints;

  [[nodiscard]] int size() const { return static_cast<int>(frames.size()); }
};

}  // namespace lapwing::slam
