#include "autonomy/operator/map_follower.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

namespace lapwing::autonomy {

MapFollower::Outcome MapFollower::take(report::Map whole) {
  revision_ = whole.revision;
  map_ = std::move(whole.map);
  return Outcome::shown;
}

MapFollower::Outcome MapFollower::take(report::MapChanges const& changes) {
  if (revision_ == 0) return Outcome::waits;
  auto const fits = [&](report::MapChanges::Run const& run) {
    return std::size_t{run.first} + run.cells.size() <= map_->cells.size();
  };
  if (changes.since != revision_ || !std::ranges::all_of(changes.runs, fits)) {
    revision_ = 0;
    return Outcome::missed;
  }
  for (auto const& run : changes.runs) std::ranges::copy(run.cells, std::next(map_->cells.begin(), run.first));
  revision_ = changes.revision;
  return Outcome::shown;
}

}  // namespace lapwing::autonomy
