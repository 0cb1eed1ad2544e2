#pragma once

#include <filesystem>
#include <span>
#include <string_view>

#include "apps/vision/detect.hpp"
#include "base/error.hpp"
#include "vision/evaluate.hpp"

namespace lapwing::apps::detect {

/// How what was found compares with what people marked.
struct Evaluation {
  vision::Figures things;       ///< of one category; everything that was found counts, whatever its score
  std::size_t signs = 0;        ///< pictures whose number is known
  std::size_t right_signs = 0;  ///< and was found exactly
};

/// `folder` has for each picture NAME.txt with a line for each thing, `class x y width height` relative to the picture
/// (YOLO's; class 0 is the category), or a labels.csv with the text of each picture's sign (`image,text`), or both.
/// Pictures that neither speaks of do not count.
[[nodiscard]] base::Result<Evaluation> evaluate_with(std::filesystem::path const& folder, std::span<Found const> found,
                                                     std::string_view category);

}  // namespace lapwing::apps::detect
