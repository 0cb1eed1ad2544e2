#pragma once

#include <string>
#include <vector>

#include <opencv2/core.hpp>
#include <opencv2/dnn.hpp>

#include "base/error.hpp"
#include "vision/cars/car_answer.hpp"

namespace lapwing::vision {

/// What is seen of the ground from above.
struct Overhead {
  std::vector<SeenCar> cars;  ///< pixels of the picture; the surest first
  /// The chance that a vehicle is seen there: 32-bit numbers, `covered_scale` times as large as the picture.
  cv::Mat covered;
  double covered_scale = 0.0;
};

/// What the network is shown. The mirror image is a second opinion, for nearly twice the time.
enum class Views { picture, picture_and_mirror };

/// Finds vehicles from above by a small network that the project trains itself (training/cars, the model card in
/// docs/reference/model-cars.md).
class CarNetwork {
 public:
  /// `network`: the content of models/cars.onnx.
  [[nodiscard]] static base::Result<CarNetwork> load(std::string const& network);

  /// `pixels`: BGR. The network knows vehicles of one size, so what a pixel measures on the ground must be known.
  [[nodiscard]] Overhead look(cv::Mat const& pixels, double metres_a_pixel, double least_score,
                              Views views = Views::picture);
  /// At one scale, of a square of `car_input` pixels at most: for whoever does not know the scale.
  [[nodiscard]] std::vector<SeenCar> look_at_square(cv::Mat const& pixels, double least_score);

 private:
  explicit CarNetwork(cv::dnn::Net const& net) : net_(net) {}  // which is a handle
  [[nodiscard]] cv::Mat answer_to(cv::Mat const& square, Views views = Views::picture);

  cv::dnn::Net net_;
};

}  // namespace lapwing::vision
