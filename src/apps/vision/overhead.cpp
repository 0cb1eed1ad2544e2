#include "apps/vision/overhead.hpp"

#include <cstdio>
#include <filesystem>

#include <fmt/format.h>

#include "apps/vision/detect.hpp"
#include "host/files/files.hpp"
#include "vision/cars/contrast_cars.hpp"
#include "vision/cars/ground_scale.hpp"

namespace lapwing::apps::detect {

void add_ground_options(CLI::App& part, GroundOptions& options) {
  constexpr double least = 0.001;
  constexpr double most = 1.0;
  part.add_option("--gsd", options.metres_a_pixel,
                  "What a pixel measures on the ground, in metres; else as EXIF and XMP say, or as long as cars are")
      ->check(CLI::Range(least, most));
  part.add_option("--method", options.method, "network: any vehicles; classic: what differs from the ground")
      ->check(CLI::IsMember({"network", "classic"}))
      ->capture_default_str();
}

base::Result<GroundWatcher> GroundWatcher::make(GroundOptions const& options) {
  GroundWatcher watcher(options);
  if (options.method != "network") return watcher;
  auto const file = host::home_directory() / "models/cars.onnx";
  if (!std::filesystem::exists(file)) {
    fmt::print(stderr, "{} is not there: cars are looked for by their contrast alone\n", file.string());
    return watcher;
  }
  auto network = vision::CarNetwork::load(content_of(file));
  if (!network) return std::unexpected(network.error());
  watcher.network_.emplace(*std::move(network));
  return watcher;
}

std::optional<double> GroundWatcher::scale_of(cv::Mat const& upright, vision::FlightRecord const& flight) {
  if (options_.metres_a_pixel) return options_.metres_a_pixel;
  if (auto const flown = vision::metres_a_pixel(flight, upright.size())) return flown;
  if (!network_) return std::nullopt;
  constexpr double least_score = 0.3;
  return vision::metres_a_pixel_by_cars(
      upright, [&](cv::Mat const& square) { return network_->look_at_square(square, least_score); });
}

Ground GroundWatcher::look(cv::Mat const& upright, vision::FlightRecord const& flight, double least_score,
                           vision::Views views) {
  Ground ground{.overhead = {}, .metres_a_pixel = scale_of(upright, flight)};
  if (!ground.metres_a_pixel) {
    fmt::print(stderr,
               "nothing tells what a pixel measures on the ground, so nothing is looked for: give it by --gsd\n");
    return ground;
  }
  if (network_) {
    ground.overhead = network_->look(upright, *ground.metres_a_pixel, least_score, views);
  } else {
    ground.overhead.cars = vision::cars_by_contrast(upright, *ground.metres_a_pixel);
    std::erase_if(ground.overhead.cars, [&](auto const& car) { return car.score < least_score; });
  }
  return ground;
}

}  // namespace lapwing::apps::detect
