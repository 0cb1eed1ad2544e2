#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "base/error.hpp"
#include "vision/detection.hpp"
#include "vision/image/flight.hpp"
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
  std::optional<double> metres_a_pixel{};
  std::vector<vision::Detection> detections;
};

/// What a detector made of a picture, in upright pixels.
struct Seen {
  std::vector<vision::Detection> detections;
  std::optional<double> metres_a_pixel{};  ///< of level ground seen from above
};

/// Finds things in the upright picture; `which`: in the order in which they were named.
using Detector = std::function<Seen(std::size_t which, cv::Mat const& upright, vision::FlightRecord const& flight)>;

struct Outcome {
  std::vector<Found> found;  ///< the pictures that could be read, in the order in which they were named
  int exit_code = 0;
};

/// Looks at each picture; writes an overlay for each, detections.json and, where places on Earth are known,
/// detections.geojson into the folder, and tells on standard output what was found. A picture that cannot be read is
/// named on standard error; the others are looked at all the same, and the exit code is that of bad usage.
[[nodiscard]] Outcome carry_out(CommonOptions const& options, Detector const& detector);

/// The content of a file of the checkout; empty if it is not there.
[[nodiscard]] std::string content_of(std::filesystem::path const& file);

/// Parts of `detect`.
void add_doors(CLI::App& detect, int& exit_code);
void add_cars(CLI::App& detect, int& exit_code);
void add_slots(CLI::App& detect, int& exit_code);

}  // namespace lapwing::apps::detect
