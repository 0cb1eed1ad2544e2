#pragma once

#include <vector>

#include <opencv2/core.hpp>

#include "vision/image/rectify.hpp"

namespace lapwing::vision {

/// A row of what may be letters.
struct TextLine {
  Quadrilateral corners;
  double letter_height = 0.0;  ///< pixels
  int letters = 0;             ///< pieces that look like one

  /// Upright, round the corners.
  [[nodiscard]] cv::Rect2d box() const;
};

/// Rows of letters in a grey picture, of either polarity, level or slanted by up to half their height a letter; the
/// most regular ones first, not more than `most`. A proposal: bricks and leaves make rows as well, and only a reader
/// tells.
[[nodiscard]] std::vector<TextLine> find_text_lines(cv::Mat const& grey, std::size_t most = 24);

}  // namespace lapwing::vision
