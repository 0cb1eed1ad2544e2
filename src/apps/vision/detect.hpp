#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "base/error.hpp"
#include "vision/detection.hpp"
#include "vision/image/image.hpp"

namespace lapwing::apps::detect {

/// What `detect` takes whatever it looks for.
struct CommonOptions {
  std::vector<std::string> pictures;
  std::filesystem::path out;
  bool as_json = false;
};

void add_common_options(CLI::App& part, CommonOptions& options);

/// A picture's file and what was found in it, in stored pixels.
struct Found {
  std::string picture;
  cv::Size size{};  ///< as stored
  std::vector<vision::Detection> detections;
};

/// Finds things in the upright picture, in upright pixels.
using Detector = std::function<std::vector<vision::Detection>(cv::Mat const& upright)>;

struct Outcome {
  std::vector<Found> found;  ///< the pictures that could be read, in the order in which they were named
  int exit_code = 0;
};

/// Looks at each picture; writes an overlay for each and detections.json into the folder, and tells on standard output
/// what was found. A picture that cannot be read is named on standard error; the others are looked at all the same, and
/// the exit code is that of bad usage.
[[nodiscard]] Outcome carry_out(CommonOptions const& options, Detector const& detector);

/// Parts of `detect`.
void add_doors(CLI::App& detect, int& exit_code);

}  // namespace lapwing::apps::detect
