#pragma once

#include <string>

#include "dryrun/analysis.hpp"
#include "dryrun/internal/drawing.hpp"

/// The parts of the picture of a dry run: each draws into a box that it was given.
namespace lapwing::dryrun::internal {

/// What is drawn. References outlive it.
struct Subject {
  FlightRecord const& record;
  Analysis const& analysis;
  plan::Fence const& fence;
};

/// Class of a group that has the colour of that vehicle.
[[nodiscard]] std::string colour_of(std::size_t vehicle);

/// Height over width that suits the map of this flight.
[[nodiscard]] double map_shape(Subject const& subject);
void draw_map(Drawing& drawing, Subject const& subject, Box const& box);

[[nodiscard]] double time_line_height(Subject const& subject);
void draw_time_line(Drawing& drawing, Subject const& subject, Box const& box);

}  // namespace lapwing::dryrun::internal
