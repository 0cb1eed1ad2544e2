#pragma once

#include <span>
#include <vector>

#include "vision/detection.hpp"

namespace lapwing::vision {

/// One picture: what was found, and what is there.
struct Judged {
  std::vector<Detection> found;  ///< of one category
  std::vector<Box> truth;
};

struct Figures {
  std::size_t pictures = 0;
  std::size_t there = 0;  ///< things that are in the pictures
  std::size_t right = 0;  ///< found, each thing once
  std::size_t wrong = 0;  ///< found where there is none, or a second time
  double average_precision = 0.0;

  [[nodiscard]] double precision() const;
  [[nodiscard]] double recall() const;
  [[nodiscard]] double wrong_a_picture() const;
};

/// What was found is right when it overlaps something that is there by `least_overlap` and nothing surer took that
/// already. Only what has at least `threshold` counts, except for the average precision, which counts everything: over
/// all thresholds, the precision at each recall being the best one at that recall or more.
[[nodiscard]] Figures evaluate(std::span<Judged const> pictures, double threshold, double least_overlap = 0.5);

}  // namespace lapwing::vision
