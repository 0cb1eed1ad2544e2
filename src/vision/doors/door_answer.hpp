#pragma once

#include <span>
#include <vector>

#include <opencv2/core.hpp>

#include "vision/detection.hpp"

namespace lapwing::vision {

/// Pixels a side of what the network sees, and of the part of it that each place of its answer speaks for.
inline constexpr int answer_input = 160;
inline constexpr int answer_step = 8;

/// A door in the square that the network sees.
struct AnsweredDoor {
  Box box;
  double surety = 0.0;  ///< the logit of the chance that it is one
};

/// What the network's answer (1 x 5 x 20 x 20: surety, and the way to the left, top, right and bottom edge in steps)
/// says, each door once: neighbouring places that mean the same one vote on its edges. Surest first, at most
/// `most` places are listened to.
[[nodiscard]] std::vector<AnsweredDoor> doors_of_answer(cv::Mat const& answer, std::size_t most = 60);

/// Found in the mirror image: back to where they are.
[[nodiscard]] std::vector<AnsweredDoor> mirrored_back(std::vector<AnsweredDoor> doors);

/// What the picture and its mirror image agree on has the mean of both; what one of them alone has is less sure.
[[nodiscard]] std::vector<AnsweredDoor> agreed(std::span<AnsweredDoor const> picture,
                                               std::span<AnsweredDoor const> mirror);

/// The chance that it is a door: what the network says is calibrated on photographs that it had not seen.
[[nodiscard]] double chance_of(double surety);

}  // namespace lapwing::vision
