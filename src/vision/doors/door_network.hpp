#pragma once

#include <memory>
#include <string>
#include <vector>

#include <opencv2/core.hpp>
#include <opencv2/dnn.hpp>

#include "base/error.hpp"
#include "vision/detection.hpp"

namespace lapwing::vision {

/// Finds doors of any colour by a small network that the project trains itself (training/doors, the model card in
/// docs/reference/model-doors.md).
class DoorNetwork {
 public:
  /// `network`: the content of models/doors.onnx.
  [[nodiscard]] static base::Result<DoorNetwork> load(std::string const& network);

  /// `pixels`: BGR, upright. Each is a "door", surest first; the score is the chance that it is one, as photographs
  /// showed that the network had not seen.
  [[nodiscard]] std::vector<Detection> find(cv::Mat const& pixels, double least_score);

 private:
  explicit DoorNetwork(cv::dnn::Net const& net) : net_(net) {}  // which is a handle

  cv::dnn::Net net_;
};

}  // namespace lapwing::vision
