#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "apps/verb.hpp"
#include "apps/vision/detect.hpp"
#include "apps/vision/overhead.hpp"
#include "apps/vision/truth.hpp"

namespace lapwing::apps::detect {

namespace {

struct CarOptions {
  CommonOptions common;
  GroundOptions ground;
  double least_score = 0.5;
  std::filesystem::path truth;
};

vision::Detection told(vision::SeenCar const& car, cv::Size const& picture) {
  return {.category = "car",
          .box = vision::upright_box(car.box, picture),
          .score = car.score,
          .corners = vision::corners_of(car.box)};
}

int judge(CarOptions const& options, Outcome const& outcome) {
  auto const evaluation = evaluate_with(options.truth, outcome.found, "car");
  if (!evaluation) return host::refuse(evaluation.error());
  auto const& cars = evaluation->things;
  double const both = cars.precision() + cars.recall();
  // Beside the JSON of standard output.
  fmt::print(options.common.as_json ? stderr : stdout,
             "cars: {} pictures, {} cars: F1 {:.3f}, precision {:.3f}, recall {:.3f}, {:.2f} false a picture, average "
             "precision {:.3f}\n",
             cars.pictures, cars.there, both > 0.0 ? 2.0 * cars.precision() * cars.recall() / both : 0.0,
             cars.precision(), cars.recall(), cars.wrong_a_picture(), cars.average_precision);
  return outcome.exit_code;
}

int cars(CarOptions const& options) {
  auto watcher = GroundWatcher::make(options.ground);
  if (!watcher) return host::refuse(watcher.error());
  auto const outcome =
      carry_out(options.common, [&](std::size_t, cv::Mat const& upright, vision::FlightRecord const& flight) -> Seen {
        auto const ground = watcher->look(upright, flight, options.least_score, vision::Views::picture_and_mirror);
        Seen seen{.detections = {}, .metres_a_pixel = ground.metres_a_pixel};
        for (auto const& car : ground.overhead.cars) seen.detections.push_back(told(car, upright.size()));
        return seen;
      });
  return options.truth.empty() ? outcome.exit_code : judge(options, outcome);
}

}  // namespace

void add_cars(CLI::App& detect, int& exit_code) {
  auto const options = std::make_shared<CarOptions>();
  auto* const part = detect.add_subcommand("cars", "Vehicles, seen from above");
  add_common_options(*part, options->common);
  add_ground_options(*part, options->ground);
  part->add_option("--least-score", options->least_score, "Cars that are less sure are not told, 0.01 to 0.99")
      ->check(CLI::Range(0.01, 0.99))
      ->capture_default_str();
  part->add_option("--truth", options->truth, "Folder with what people marked in these pictures: says how good it is")
      ->check(CLI::ExistingDirectory);
  part->callback([options, &exit_code] { exit_code = cars(*options); });
}

}  // namespace lapwing::apps::detect
