#include "slam/match/local_grid.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace lapwing::slam {
namespace {

constexpr int reach = 3;  // cells around a point that it touches
constexpr int stamp_side = 2 * reach + 1;
constexpr double degree = std::numbers::pi / 180.0;

std::array<std::uint8_t, stamp_side * stamp_side> make_stamp() {
  constexpr double spread_m = 0.08;  // of the Gaussian: a laser's noise, and the walls' over a few metres of drift
  std::array<std::uint8_t, stamp_side * stamp_side> stamp{};
  for (int y = -reach; y <= reach; ++y) {
    for (int x = -reach; x <= reach; ++x) {
      auto const apart = static_cast<double>(x * x + y * y) * LocalGrid::cell_m * LocalGrid::cell_m;
      stamp[static_cast<std::size_t>(y + reach) * stamp_side + static_cast<std::size_t>(x + reach)] =
          static_cast<std::uint8_t>(255.0 * std::exp(-apart / (2.0 * spread_m * spread_m)));
    }
  }
  return stamp;
}

/// Mean over every `stride`-th point, 0 to 1.
double score(LocalGrid const& grid, Frame const& frame, Pose2 const& pose, std::size_t stride) {
  auto const cosine = static_cast<float>(std::cos(pose.yaw)) / LocalGrid::cell_m;
  auto const sine = static_cast<float>(std::sin(pose.yaw)) / LocalGrid::cell_m;
  auto const origin = grid.cells_of(place(pose));
  int sum = 0;
  int count = 0;
  for (std::size_t k = 0; k < frame.points.size(); k += stride, ++count) {
    auto const& p = frame.points[k];
    sum += grid.at(origin.x() + cosine * p.x() - sine * p.y(), origin.y() + sine * p.x() + cosine * p.y());
  }
  return count == 0 ? 0.0 : sum / (255.0 * count);
}

/// Every pose of the window, with about ninety of the points.
Pose2 coarse(LocalGrid const& grid, Frame const& frame, Pose2 const& guess, SearchWindow const& window) {
  constexpr double step_m = 0.1;
  constexpr double step_rad = degree;
  constexpr std::size_t enough_points = 90;
  auto const stride = std::max<std::size_t>(1, frame.points.size() / enough_points);
  auto const turns = static_cast<int>(std::ceil(window.reach_rad / step_rad));
  auto const shifts = static_cast<int>(std::ceil(window.reach_m / step_m));
  auto best = guess;
  auto best_score = -1.0;
  std::vector<Eigen::Vector2f> points;
  for (int a = -turns; a <= turns; ++a) {
    Pose2 const turned{guess.x, guess.y, guess.yaw + a * step_rad};
    Turn const turn(turned.yaw);
    points.clear();
    for (std::size_t k = 0; k < frame.points.size(); k += stride)
      points.push_back(grid.cells_of(place(turned) + turn * frame.points[k].cast<double>()));
    for (int u = -shifts; u <= shifts; ++u) {
      for (int v = -shifts; v <= shifts; ++v) {
        auto const x = static_cast<float>(u * step_m / LocalGrid::cell_m);
        auto const y = static_cast<float>(v * step_m / LocalGrid::cell_m);
        int sum = 0;
        for (auto const& p : points) sum += grid.at(p.x() + x, p.y() + y);
        auto const value = sum / (255.0 * static_cast<double>(points.size())) -
                           window.cost_per_m2 * step_m * step_m * (u * u + v * v) -
                           window.cost_per_rad2 * (a * step_rad) * (a * step_rad);
        if (value <= best_score) continue;
        best_score = value;
        best = {guess.x + u * step_m, guess.y + v * step_m, turned.yaw};
      }
    }
  }
  return best;
}

}  // namespace

void LocalGrid::move_to(Pose2 const& centre) {
  std::ranges::fill(cells_, std::uint8_t{0});
  origin_ = place(centre) - Eigen::Vector2d::Constant(0.5 * side * cell_m);
}

void LocalGrid::add(Frame const& frame, Pose2 const& pose) {
  static auto const stamp = make_stamp();
  Turn const turn(pose.yaw);
  for (auto const& point : frame.points) {
    auto const cell = cells_of(place(pose) + turn * point.cast<double>());
    auto const x = static_cast<int>(cell.x());
    auto const y = static_cast<int>(cell.y());
    if (x <= reach || y <= reach || x >= side - reach - 1 || y >= side - reach - 1) continue;
    auto* row = cells_.data() + static_cast<std::ptrdiff_t>(y - reach) * side + x - reach;
    if (row[reach * side + reach] == 255) continue;
    for (int j = 0; j < stamp_side; ++j, row += side)
      for (int i = 0; i < stamp_side; ++i)
        row[i] = std::max(row[i], stamp[static_cast<std::size_t>(j) * stamp_side + static_cast<std::size_t>(i)]);
  }
}

double fit(LocalGrid const& grid, Frame const& frame, Pose2 const& pose) {
  return score(grid, frame, pose, 1);
}

Correlation correlate(LocalGrid const& grid, Frame const& frame, Pose2 const& guess, SearchWindow const& window) {
  if (frame.points.empty()) return {guess, 0.0};
  auto best = coarse(grid, frame, guess, window);
  auto best_score = score(grid, frame, best, 1);
  constexpr int most_steps = 6;
  for (auto [step_m, step_rad] : {std::pair{0.05, 0.5 * degree}, {0.025, 0.25 * degree}}) {
    for (int round = 0; round < most_steps; ++round) {
      auto const centre = best;
      for (auto const& step :
           {Eigen::Vector3d(step_m, 0, 0), Eigen::Vector3d(-step_m, 0, 0), Eigen::Vector3d(0, step_m, 0),
            Eigen::Vector3d(0, -step_m, 0), Eigen::Vector3d(0, 0, step_rad), Eigen::Vector3d(0, 0, -step_rad)}) {
        auto const tried = stepped(centre, step);
        auto const value = score(grid, frame, tried, 1);
        if (value <= best_score) continue;
        best_score = value;
        best = tried;
      }
      if (best == centre) break;
    }
  }
  return {best, best_score};
}

std::optional<Correlation> correlate_along(LocalGrid const& grid, Frame const& frame, Correlation const& found) {
  constexpr double step_m = 0.1;
  constexpr int nearest = 3;  // steps; nearer ones were looked at
  constexpr int farthest = 15;
  constexpr double between_steps = 0.1;  // of the score may be lost
  constexpr double cost_per_m2 = 0.02;
  constexpr double clearly = 0.06;
  Pose2 best;
  auto best_value = found.score - between_steps;
  auto is_any = false;
  for (int i = -farthest; i <= farthest; ++i) {
    if (std::abs(i) < nearest) continue;
    auto const tried = found.pose * Pose2{i * step_m, 0.0, 0.0};
    auto const value = score(grid, frame, tried, 1) - cost_per_m2 * (i * step_m) * (i * step_m);
    if (value <= best_value) continue;
    best_value = value;
    best = tried;
    is_any = true;
  }
  if (!is_any) return std::nullopt;
  constexpr SearchWindow around{.reach_m = 0.1, .reach_rad = 0.05, .cost_per_m2 = 0.0, .cost_per_rad2 = 0.0};
  auto const refined = correlate(grid, frame, best, around);
  auto const apart = distance_m(refined.pose, found.pose);
  if (refined.score - cost_per_m2 * apart * apart < found.score + clearly) return std::nullopt;
  return refined;
}

}  // namespace lapwing::slam
