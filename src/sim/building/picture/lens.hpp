#pragma once

#include <vector>

#include "sim/building/noise.hpp"
#include "sim/building/picture/camera.hpp"
#include "sim/building/picture/shading.hpp"

namespace lapwing::sim::building {

/// What comes through the lens, before the sensor.
struct LightField {
  int width = 0;
  int height = 0;
  std::vector<Light> light;  ///< row by row from the top
};

/// Out of focus: a Gaussian of that standard deviation, in pixels.
void defocus(LightField& field, double deviation_px);
/// Every point becomes a level line of that length, in pixels: the camera turned meanwhile.
void smear(LightField& field, double length_px);
/// Dimmed, darker in the corners, with the sensor's noise, in 8 bits.
[[nodiscard]] Picture expose(LightField const& field, CameraSettings const& settings, Noise noise);

}  // namespace lapwing::sim::building
