#include "vision/image/sharpness.hpp"

#include <algorithm>

#include <opencv2/imgproc.hpp>

namespace lapwing::vision {

namespace {

constexpr int least_side = 8;
/// Enough to tell, and quick.
constexpr int spectrum_side = 256;

cv::Mat grey(cv::Mat const& pixels) {
  cv::Mat single;
  if (pixels.channels() == 1) {
    single = pixels;
  } else {
    cv::cvtColor(pixels, single, cv::COLOR_BGR2GRAY);
  }
  cv::Mat values;
  single.convertTo(values, CV_32F, 1.0 / 255.0);
  return values;
}

double variance(cv::Mat const& values) {
  cv::Scalar mean;
  cv::Scalar deviation;
  cv::meanStdDev(values, mean, deviation);
  return deviation[0] * deviation[0];
}

/// Of the middle of the picture, at its own scale: a scaled one has another spectrum.
double fine_share(cv::Mat const& values) {
  cv::Size const size(std::min(values.cols, spectrum_side), std::min(values.rows, spectrum_side));
  cv::Mat const part = values(cv::Rect({(values.cols - size.width) / 2, (values.rows - size.height) / 2}, size));
  // Without a window the edges of the part would look like details.
  cv::Mat window;
  cv::createHanningWindow(window, size, CV_32F);
  cv::Mat const flat = (part - cv::mean(part)[0]).mul(window);
  cv::Mat spectrum;
  cv::dft(flat, spectrum, cv::DFT_COMPLEX_OUTPUT);
  double all = 0.0;
  double fine = 0.0;
  constexpr double least_cycles_a_pixel = 1.0 / 8.0;
  for (int y = 0; y < size.height; ++y) {
    double const v = std::min(y, size.height - y) / static_cast<double>(size.height);
    for (int x = 0; x < size.width; ++x) {
      double const u = std::min(x, size.width - x) / static_cast<double>(size.width);
      auto const& value = spectrum.at<cv::Vec2f>(y, x);
      double const power = double{value[0]} * value[0] + double{value[1]} * value[1];
      all += power;
      if (u * u + v * v >= least_cycles_a_pixel * least_cycles_a_pixel) fine += power;
    }
  }
  return all > 0.0 ? fine / all : 0.0;
}

}  // namespace

Sharpness sharpness(cv::Mat const& pixels) {
  if (std::min(pixels.cols, pixels.rows) < least_side) return {};
  auto const values = grey(pixels);
  cv::Mat second;
  cv::Laplacian(values, second, CV_32F);
  // A wall without contrast is neither sharp nor blurred; the constant keeps its noise from counting as detail.
  constexpr double least_contrast = 1e-4;
  return {.laplacian_variance = variance(second) / (variance(values) + least_contrast),
          .fine_share = fine_share(values)};
}

bool is_sharp(Sharpness const& sharpness) {
  return sharpness.laplacian_variance >= 0.004 && sharpness.fine_share >= 0.0003;
}

}  // namespace lapwing::vision
