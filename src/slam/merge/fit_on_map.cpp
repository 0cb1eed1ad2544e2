#include "slam/merge/fit_on_map.hpp"

#include "slam/grid/draw_grid.hpp"
#include "slam/known/known_map.hpp"
#include "slam/known/lay_on_map.hpp"
#include "slam/refine/overlap.hpp"

namespace lapwing::slam {

FitOnMap fit_on_map(ScanLog const& seen, std::vector<Pose2> const& poses, Graph const& graph,
                    std::vector<int> const& frames) {
  auto const known = KnownMap::make(draw_grid(seen, poses, {}));
  if (!known) return {};
  constexpr double near_m = 1.0;
  constexpr double good_fit = 0.7;
  PlaceIndex const index(poses, near_m);
  FitOnMap fit;
  for (auto const k : frames) {
    if (index.near(graph.poses[k], -1, 1).empty()) continue;
    ++fit.met;
    fit.fitting += fit_of(*known, graph.frames[k].frame, graph.poses[k]) >= good_fit ? 1 : 0;
  }
  return fit;
}

}  // namespace lapwing::slam
