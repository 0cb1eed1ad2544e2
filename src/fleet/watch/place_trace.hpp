#pragma once

#include <optional>
#include <vector>

#include "base/time.hpp"
#include "fleet/watch/planned_places.hpp"

namespace lapwing::fleet {

/// Which places of a mission a vehicle has passed, by its track and not by what it says of its mission.
///
/// Between two positions the vehicle may have been wherever its speed allows. So a place that it may have passed while
/// nothing was heard counts as passed: bad links make no failures. Heights are not looked at.
class PlaceTrace {
 public:
  PlaceTrace(std::vector<PlannedPlace> places, vehicle::Family family);

  /// A position was heard, `since_last` after the one before; how many places were passed with it.
  int note(geo::Wgs84 place, double speed_m_s, base::Duration since_last);
  /// The vehicle says that it has reached the item. Believed when it is not far from there: autopilots have their own
  /// ways to call a place passed.
  void note_reached(int seq);

  /// Items whose places were not passed, when nothing has been heard for so long.
  [[nodiscard]] std::vector<int> unpassed(base::Duration silent_for) const;
  /// Of all the places.
  [[nodiscard]] std::size_t size() const { return seqs_.size(); }

 private:
  struct Open {
    int seq = 0;
    geo::Ned at;
    double radius_m = 0.0;
  };

  geo::LocalFrame frame_;
  std::vector<int> seqs_;  ///< of all places, rising
  std::vector<Open> open_;
  std::optional<geo::Ned> last_;
  double fastest_m_s_;
  double lag_s_;  ///< by which a vehicle at speed cuts a corner or overshoots it
};

/// "item 4", "items 4 to 13", "items 4 to 6, 9 and 11": for people.
[[nodiscard]] std::string items_text(std::vector<int> const& seqs);

}  // namespace lapwing::fleet
