#pragma once

#include <string>

#include "explore/lot/slots/slot_looks.hpp"

namespace lapwing::explore {

/// How the car park is drawn from what pictures tell. One set for all car parks; what each number does to the figures
/// stands in docs/reference/survey.md.
struct LotSettings {
  double cell_m = 0.5;

  // What a picture shows.
  double farthest_m = 80.0;  ///< ground farther from below the camera counts as unseen
  double coarsest_m = 0.12;  ///< and so does ground of which a pixel shows more than that
  double edge_m = 2.5;       ///< half a slot: so near to the picture's edge one may be cut off and is not missed
  double clear_m = 0.4;      ///< a slot whose corners are farther than that from the edge is wholly in it

  // How the detectors err, by their own figures (docs/reference/model-cars.md).
  double found_share = 0.9;     ///< of slots that are in the picture
  double false_share = 0.03;    ///< of places where none is
  double least_error = 0.01;    ///< no chance that they tell is surer than that
  double detector_prior = 0.5;  ///< of "taken" where their chances were calibrated
  Independence independence = {};

  // What is so anyway.
  double parking_share = 0.5;  ///< of the area's cells
  double slot_prior = 0.3;     ///< that a slot is there which was found for the first time, before its surety counts
  double confirmed = 0.8;      ///< from that chance on a slot is on the map
  double forgotten = 0.05;     ///< below it is taken for a mistake
  Turnover turnover = {};
  base::Duration layout_memory = std::chrono::hours(24 * 7);  ///< paint, kerbs and trees

  // Cars that pass.
  base::Duration stands_after = std::chrono::seconds(5);  ///< at one place for that time, a car stands there
  double stands_within_m = 1.0;
  double standing_chance = 0.7;  ///< that people park where a car stands

  std::string id_prefix = "slot";  ///< of new slots: "slot-17"; several mappers of a lot need one each
};

/// A look that says less than this share of something new is not counted at all.
inline constexpr double least_novelty = 0.1;

}  // namespace lapwing::explore
