#pragma once

#include <optional>
#include <string>

#include "geo/point.hpp"

namespace lapwing::geo {

/// Frame of a camera: x right, y down, z ahead, from the middle of its lens (OpenCV's).
struct CameraFrame {};

/// A place in a picture, in pixels: x to the right, y down, from its upper left corner, so that the middle of the first
/// pixel is (0.5, 0.5). (OpenCV's calibration counts from that middle: its principal point is half a pixel less.)
struct Pixel {
  double x = 0.0;
  double y = 0.0;
  friend constexpr bool operator==(Pixel const&, Pixel const&) = default;
};

/// How a camera makes pixels of directions: a pinhole and a lens that bends (Brown 1971: radial k1 to k3, tangential p1
/// and p2, as OpenCV, Kalibr and ROS's `plumb_bob` have them).
struct Lens {
  int width_px = 0;
  int height_px = 0;
  double focal_x_px = 0.0;
  double focal_y_px = 0.0;
  Pixel middle = {};  ///< the principal point
  double k1 = 0.0;
  double k2 = 0.0;
  double k3 = 0.0;
  double p1 = 0.0;
  double p2 = 0.0;

  [[nodiscard]] bool contains(Pixel const& pixel) const {
    return pixel.x >= 0.0 && pixel.y >= 0.0 && pixel.x <= width_px && pixel.y <= height_px;
  }
};

/// One that does not bend, with its principal point in the middle. Precondition: `across_rad` in (0, pi).
[[nodiscard]] Lens pinhole(int width_px, int height_px, double across_rad);

/// Why it is no lens ("its focal length is 0 px"); nothing for a sound one. A lens that folds its own picture, so that
/// two directions are one pixel in it, is none.
[[nodiscard]] std::optional<std::string> lens_fault(Lens const& lens);

/// The direction from which a pixel is seen, with z = 1. Nothing where the lens shows no direction: Newton's method
/// finds none that the lens would draw there.
[[nodiscard]] std::optional<Vector3<CameraFrame>> ray_of(Lens const& lens, Pixel const& pixel);

/// Where something is drawn, which may be outside of the picture; nothing for what is behind the lens, or so far aside
/// that the polynomial of the lens folds back there.
[[nodiscard]] std::optional<Pixel> pixel_of(Lens const& lens, Point3<CameraFrame> const& place);

}  // namespace lapwing::geo
