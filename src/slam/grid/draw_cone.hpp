#pragma once

#include "slam/grid/draw_grid.hpp"
#include "slam/grid/sheet.hpp"

namespace lapwing::slam {

/// What a sonar says of the cells in its cone: the nearest thing in it that sends sound back stands somewhere on the
/// arc at `range_m`, and nothing before it; the surer the nearer to the cone's axis (Moravec & Elfes 1985, section 3).
/// Beyond what a cone is too wide to draw anything by, only the near part of it is free.
void draw_cone(Sheet& sheet, Ray const& axis, double half_cone_rad, double range_m, BeamModel const& model);

/// Where a single sonar or ranger is silent, so far ahead is likelier to be free than not: a robot that stops there has
/// half a metre left before it, and other sensors have looked by then.
inline constexpr double silence_m = 1.5;

/// A cone from which nothing came back. Smooth walls are silent where they are met aslant, so that this is a hint for
/// the next step alone, `most_m` at most: what else is known counts more.
void draw_silent_cone(Sheet& sheet, Ray const& axis, double half_cone_rad, double most_m, BeamModel const& model);

}  // namespace lapwing::slam
