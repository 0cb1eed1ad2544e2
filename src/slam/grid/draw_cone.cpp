#include "slam/grid/draw_cone.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace lapwing::slam {
namespace {

/// A cone is a metre wide there, and its arc says little of where something is.
constexpr double farthest_m = 4.0;
/// Of what a beam says of a cell. One sonar hears the same from many places on its way, mistakes included.
constexpr double free_share = 0.15;
/// Of an echo, in all cells of its arc together, in beams' worth.
constexpr double echo_beams = 3.0;
constexpr double silent_share = 0.03;
/// Of the half width; what is farther from the axis sends too little back to be counted on.
constexpr double hears = 0.8;

/// Calls `visit(index, ahead, off)` for each cell whose middle lies in the cone, `ahead` from its apex and `off` from
/// its axis as a share of its half width.
template <typename Visit>
void each_cell(Sheet const& sheet, Ray const& axis, double half_cone_rad, double end_m, Visit const& visit) {
  Eigen::Vector2d const apex = (axis.from - sheet.origin) / sheet.cell_m;
  double const end = end_m / sheet.cell_m;
  Eigen::Vector2d const left(-axis.direction.y(), axis.direction.x());
  double const half_width = end * std::tan(half_cone_rad);
  std::array<Eigen::Vector2d, 3> const corners{apex, apex + end * axis.direction + half_width * left,
                                               apex + end * axis.direction - half_width * left};
  auto const [low, high] = std::ranges::minmax(corners, {}, [](Eigen::Vector2d const& corner) { return corner.y(); });
  int const first = std::max(0, static_cast<int>(std::floor(low.y())));
  int const last = std::min(sheet.height - 1, static_cast<int>(std::floor(high.y())));
  for (int y = first; y <= last; ++y) {
    // The row of cells cuts two of the triangle's sides.
    double begin_x = std::numeric_limits<double>::infinity();
    double end_x = -begin_x;
    double const row = std::clamp(y + 0.5, low.y(), high.y());
    for (std::size_t i = 0; i < corners.size(); ++i) {
      auto const& a = corners[i];
      auto const& b = corners[(i + 1) % corners.size()];
      if (std::min(a.y(), b.y()) > row || std::max(a.y(), b.y()) < row) continue;
      double const share = a.y() == b.y() ? 0.0 : (row - a.y()) / (b.y() - a.y());
      double const x = a.x() + share * (b.x() - a.x());
      begin_x = std::min(begin_x, x);
      end_x = std::max(end_x, x);
    }
    for (int x = std::max(0, static_cast<int>(std::floor(begin_x)));
         x < std::min(sheet.width, static_cast<int>(end_x) + 1); ++x) {
      Eigen::Vector2d const to = Eigen::Vector2d(x + 0.5, y + 0.5) - apex;
      double const ahead = to.norm();
      if (ahead > end) continue;
      double const off_rad = std::abs(std::atan2(left.dot(to), axis.direction.dot(to)));
      // Next to its apex the cone is narrower than a cell.
      double const off = ahead < 2.0 ? 0.0 : off_rad / half_cone_rad;
      if (off < hears) visit(sheet.index(x, y), ahead * sheet.cell_m, off);
    }
  }
}

}  // namespace

void draw_cone(Sheet& sheet, Ray const& axis, double half_cone_rad, double range_m, BeamModel const& model) {
  double const noise_m = model.noise_m + model.noise_per_m * range_m;
  double const free_m = range_m - std::max(2.0 * noise_m, sheet.cell_m);
  bool const has_arc = range_m <= farthest_m;
  // So thick that no arc has holes, whichever way it lies on the cells.
  double const thick_m = std::max(noise_m, 0.75 * sheet.cell_m);
  double const cells_on_arc =
      std::max(1.0, range_m * half_cone_rad * 2.0 * thick_m * 2.0 / (sheet.cell_m * sheet.cell_m));
  double const taken = echo_beams * model.taken_log_odds / cells_on_arc;
  each_cell(sheet, axis, half_cone_rad, std::min(range_m + thick_m, farthest_m),
            [&](std::size_t index, double ahead_m, double off) {
              double const sure = 1.0 - off * off;
              if (ahead_m < free_m)
                sheet.add(index, static_cast<float>(free_share * sure * model.free_log_odds));
              else if (has_arc && std::abs(ahead_m - range_m) <= thick_m)
                sheet.add(index, static_cast<float>(sure * taken));
            });
}

void draw_silent_cone(Sheet& sheet, Ray const& axis, double half_cone_rad, double most_m, BeamModel const& model) {
  each_cell(sheet, axis, half_cone_rad, std::min(most_m, silence_m), [&](std::size_t index, double, double off) {
    sheet.add(index, static_cast<float>(silent_share * (1.0 - off * off) * model.free_log_odds));
  });
}

}  // namespace lapwing::slam
