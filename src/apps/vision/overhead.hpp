#pragma once

#include <optional>
#include <string>

#include <CLI/CLI.hpp>

#include "base/error.hpp"
#include "vision/cars/car_network.hpp"
#include "vision/image/flight.hpp"

namespace lapwing::apps::detect {

/// What `detect cars` and `detect slots` take beside what `detect` takes.
struct GroundOptions {
  std::optional<double> metres_a_pixel;
  std::string method = "network";
};

void add_ground_options(CLI::App& part, GroundOptions& options);

/// The ground in a picture from above, and whether its scale was known.
struct Ground {
  vision::Overhead overhead;
  /// As told, as the flight says, or as long as cars are; none where nothing told it, and then nothing was looked for.
  std::optional<double> metres_a_pixel;
};

/// Looks at pictures from above, by the network or, where its file is not there, by contrast.
class GroundWatcher {
 public:
  [[nodiscard]] static base::Result<GroundWatcher> make(GroundOptions const& options);

  [[nodiscard]] Ground look(cv::Mat const& upright, vision::FlightRecord const& flight, double least_score,
                            vision::Views views);

 private:
  explicit GroundWatcher(GroundOptions options) : options_(std::move(options)) {}
  [[nodiscard]] std::optional<double> scale_of(cv::Mat const& upright, vision::FlightRecord const& flight);

  GroundOptions options_;
  std::optional<vision::CarNetwork> network_;
};

}  // namespace lapwing::apps::detect
