#pragma once

#include <deque>
#include <vector>

#include "perceive/ties/ground_plan.hpp"

namespace lapwing::perceive {

/// Finds what a drone's pictures have in common with earlier ones: pieces of the ground with something to see on them,
/// laid onto the earlier picture by normalised cross-correlation (Lewis 1995, "Fast normalized cross-correlation"), of
/// which those count that agree with each other. What stands on the ground is left out: it lies elsewhere in a picture
/// from elsewhere, and drives away.
class TieFinder {
 public:
  /// Adds the tie points of the picture to its sight, and remembers the picture when it shows enough that is new.
  /// `seen`: the ground that it shows well; `standing`: 255 where something stands, of the ground picture's size.
  void tie(explore::LotSight& sight, GroundPicture const& ground, geo::Polygon<geo::SiteFrame> const& seen,
           cv::Mat const& standing);

 private:
  [[nodiscard]] std::vector<GroundPlan const*> partners(GroundPlan const& plan) const;

  std::deque<GroundPlan> plans_;
};

/// Tie points of a picture with an earlier one, whose plan is as coarse; none, or enough to be believed.
[[nodiscard]] std::vector<explore::TiePoint> tie_points(GroundPlan const& plan, GroundPlan const& earlier);

}  // namespace lapwing::perceive
