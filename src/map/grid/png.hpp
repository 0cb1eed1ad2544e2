#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "map/grid/grid_pyramid.hpp"

namespace lapwing::map {

struct Colour {
  std::uint8_t red = 0;
  std::uint8_t green = 0;
  std::uint8_t blue = 0;
  std::uint8_t opacity = 0;
  friend bool operator==(Colour const&, Colour const&) = default;
};

/// One colour a shade.
using Palette = std::array<Colour, 256>;

/// As ROS's map_server writes and reads maps in mode "scale": white is free, black is taken, p = (255 - grey) / 255;
/// what was never seen is transparent.
[[nodiscard]] Palette const& scale_palette();
/// The same in mode "trinary", by its usual thresholds: taken above 0.65, free below 0.25, and grey (205) for what is
/// between.
[[nodiscard]] Palette const& trinary_palette();

/// Of a survey of a car park, where what is "taken" is ground on which nobody parks: slate there and white where one
/// does, as thin as glass, since slots are drawn on it and often a picture of the ground below.
[[nodiscard]] Palette const& parking_palette();
/// The one to show a grid of that name with, as `GridKey` has it.
[[nodiscard]] Palette const& palette_for(std::string_view grid);

/// A square picture as PNG, row by row from the top, with a palette; packed quickly rather than tightly, as it is
/// thrown away at the next change. Precondition: `side * side` shades, at least one.
[[nodiscard]] std::string png_of(std::span<Shade const> shades, int side, Palette const& palette);

}  // namespace lapwing::map
