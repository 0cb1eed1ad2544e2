#pragma once

#include <optional>
#include <string>

#include <opencv2/core.hpp>

#include "base/error.hpp"
#include "explore/lot/lot_settings.hpp"
#include "explore/lot/lot_sight.hpp"
#include "perceive/ties/tie_finder.hpp"
#include "vision/cars/car_network.hpp"

namespace lapwing::perceive {

/// Looks at pictures of the ground from above: which slots and vehicles there are, and where they lie on the ground.
class LotEye {
 public:
  /// `network`: the content of models/cars.onnx; empty: vehicles are looked for by their contrast alone. Errors: those
  /// of `CarNetwork::load`.
  [[nodiscard]] static base::Result<LotEye> make(std::string const& network, explore::LotSettings settings);

  /// From now on tells what of the ground earlier pictures showed, too. For who looks at one vehicle's pictures, in the
  /// order in which they were taken.
  void tie_pictures() { ties_.emplace(); }

  /// Nothing when no ground is seen well enough.
  [[nodiscard]] std::optional<explore::LotSight> look(cv::Mat const& picture, geo::GroundView const& view,
                                                      base::UtcTime at);

 private:
  explicit LotEye(explore::LotSettings settings) : settings_(std::move(settings)) {}
  [[nodiscard]] vision::Overhead vehicles(cv::Mat const& pixels, double metres_a_pixel);

  explore::LotSettings settings_;
  std::optional<vision::CarNetwork> network_;
  std::optional<TieFinder> ties_;
};

/// Why a picture cannot show anything ("it is black"); nothing for one that can.
[[nodiscard]] std::optional<std::string> picture_fault(cv::Mat const& picture);

}  // namespace lapwing::perceive
