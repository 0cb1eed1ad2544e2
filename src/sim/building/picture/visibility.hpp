#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "sim/building/picture/camera.hpp"

namespace lapwing::sim::building {

/// How a camera divides space into pixels: x to the right and y down in the picture, both from its upper left corner.
struct View {
  Eigen::Vector3d at;
  Eigen::Vector3d right;
  Eigen::Vector3d down;
  Eigen::Vector3d forward;
  double focal_px = 1.0;
  int width = 0;
  int height = 0;

  [[nodiscard]] Eigen::Vector3d ray(double x, double y) const {
    return forward + right * ((x - width / 2.0) / focal_px) + down * ((y - height / 2.0) / focal_px);
  }
};

/// With `parts` by `parts` pixels for each of the camera's.
[[nodiscard]] View view_of(CameraPose const& pose, CameraSettings const& settings, int parts);

/// Which surface is seen in each pixel.
class Visibility {
 public:
  static constexpr std::uint32_t nothing = UINT32_MAX;

  explicit Visibility(View const& view);
  /// Draws what is nearer than what is there. Seen from behind it is not drawn.
  void draw(Surface const& surface, std::uint32_t number);
  [[nodiscard]] std::uint32_t at(int x, int y) const {
    return numbers_[static_cast<std::size_t>(y) * static_cast<std::size_t>(view_.width) + static_cast<std::size_t>(x)];
  }

 private:
  /// One over the distance along the view, which is linear over the picture.
  struct Nearness {
    double at_corner;
    double a_column;
    double a_row;
  };
  void fill(std::span<Eigen::Vector2d const> corners, Nearness const& nearness, std::uint32_t number);
  void fill_row(int y, double from_x, double to_x, Nearness const& nearness, std::uint32_t number);

  View view_;
  std::vector<float> nearness_;
  std::vector<std::uint32_t> numbers_;
};

}  // namespace lapwing::sim::building
