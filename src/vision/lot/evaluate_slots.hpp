#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include <opencv2/core.hpp>

namespace lapwing::vision {

/// A slot as somebody marked it, or as it was found; pixels.
struct JudgedSlot {
  std::array<cv::Point2d, 4> corners;
  /// Marked: 1 or 0, or none where nobody could tell; found: the chance.
  std::optional<double> occupied{};

  [[nodiscard]] cv::Point2d middle() const { return 0.25 * (corners[0] + corners[1] + corners[2] + corners[3]); }
};

struct SlotFigures {
  std::size_t pictures = 0;
  std::size_t there = 0;
  std::size_t found = 0;
  std::size_t right = 0;       ///< a slot's middle within the distance of one's that is there, each once
  std::size_t told = 0;        ///< of the right ones: whether it is taken is known and was told
  std::size_t untold = 0;      ///< known, and not told
  std::size_t agreed = 0;      ///< of those told: rightly, with a half as the border
  double squared_error = 0.0;  ///< of the chances, summed over those told

  [[nodiscard]] double precision() const;
  [[nodiscard]] double recall() const;
  [[nodiscard]] double f1() const;
  [[nodiscard]] double accuracy() const;
  /// Brier's score: 0 is the best, 0.25 says nothing.
  [[nodiscard]] double brier() const;
};

/// Adds one picture. `metres_a_pixel` makes pixels of the distance of `within_m`.
void add(SlotFigures& figures, std::span<JudgedSlot const> found, std::span<JudgedSlot const> truth,
         double metres_a_pixel, double within_m = 0.5);

}  // namespace lapwing::vision
