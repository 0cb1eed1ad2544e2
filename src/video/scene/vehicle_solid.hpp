#pragma once

#include <vector>

#include <Eigen/Core>

#include "video/scene/projector.hpp"
#include "video/world/car_park.hpp"

namespace lapwing::video {

/// Draws a vehicle as outlines at heights (body, belt, roof), the sides between them, and what is on them. As
/// training/cars/vehicles.py does, so that detectors meet what they know. `light`: 1 in the sun, less in a shadow.
void draw_vehicle(Projector const& projector, Vehicle const& vehicle, Sun const& sun, double light);

/// The outline of its shadow on level ground: convex.
[[nodiscard]] std::vector<Eigen::Vector3d> vehicle_shadow(Vehicle const& vehicle, Sun const& sun);
/// What of the ground it covers: convex.
[[nodiscard]] std::vector<Eigen::Vector3d> vehicle_foot(Vehicle const& vehicle);

[[nodiscard]] cv::Scalar bgr(Colour const& colour, double factor);

}  // namespace lapwing::video
