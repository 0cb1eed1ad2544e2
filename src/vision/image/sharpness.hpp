#pragma once

#include <opencv2/core.hpp>

namespace lapwing::vision {

/// Whether a picture is worth reading, or has to be taken again.
struct Sharpness {
  double laplacian_variance =
      0.0;  ///< of the picture's second derivative, per contrast: noise and blur apart, not light and dark
  double fine_share = 0.0;  ///< 0 to 1: the part of its spectrum's power that lies in details of less than eight pixels
};

/// Of a BGR or grey picture, or a part of one; of less than 8 pixels a side nothing can be said (both 0).
[[nodiscard]] Sharpness sharpness(cv::Mat const& pixels);
/// Letters of 60 pixels can be read: up to a blur of some 2 pixels, beyond which readers begin to fail.
/// (sharpness_test.cpp).
[[nodiscard]] bool is_sharp(Sharpness const& sharpness);

}  // namespace lapwing::vision
