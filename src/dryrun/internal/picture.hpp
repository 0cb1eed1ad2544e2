#pragma once

#include <string>

#include "dryrun/analysis.hpp"
#include "dryrun/internal/canvas.hpp"

/// The parts of the picture of a dry run: each draws into a box that it was given.
namespace lapwing::dryrun::internal {

/// What is drawn. References outlive it.
struct Subject {
  FlightRecord const& record;
  Analysis const& analysis;
  plan::Fence const& fence;
};

/// Class of everything that has the colour of that vehicle.
[[nodiscard]] std::string colour_of(std::size_t vehicle);
/// 1, 2 or 5 times a power of ten, at least `least`.
[[nodiscard]] double round_step(double least);

/// Height over width that suits the map of this flight.
[[nodiscard]] double map_shape(Subject const& subject);
void draw_map(Canvas& canvas, Subject const& subject, Box const& box);

[[nodiscard]] double time_line_height(Subject const& subject);
void draw_time_line(Canvas& canvas, Subject const& subject, Box const& box);

}  // namespace lapwing::dryrun::internal
