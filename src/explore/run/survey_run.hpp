#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "explore/lot/survey_planner.hpp"
#include "explore/simulated/car_park.hpp"

namespace lapwing::explore {

struct SurveyRunSettings {
  SurveySettings survey;
  LotSettings lot = {};
  double picture_s = 0.5;  ///< between pictures
  double flying_s = 1500.0;
  double most_s = 1500.0;
  bool keeps_track = false;
};

struct SurveyReport {
  std::optional<double> to_90_s = {};  ///< until nine tenths of the information were there
  double took_s = 0.0;                 ///< until it ended; the way home left out
  double information = 0.0;            ///< share, at the end
  double coverage = 0.0;               ///< share of the area that was seen
  double slots_found = 0.0;            ///< share of the slots that there are
  std::size_t wrong_slots = 0;         ///< on the map where none is
  double off_m = 0.0;                  ///< root mean square of how far the middles of the slots found are off
  double occupancy_right = 0.0;        ///< share of the slots found of which free or taken is told rightly
  double flown_m = 0.0;
  std::string_view ending = {};
  std::vector<AirPlace> track = {};
};

/// Surveys a simulated car park by the planner, with the drone's inertia. The same park and settings give the same run.
[[nodiscard]] base::Result<SurveyReport> fly_survey(CarPark const& park, SurveyRunSettings const& settings);

/// The same drone and camera on legs side by side along the area's narrowest way: the usual survey.
struct LawnMower {
  double height_m = 10.0;
  double sidelap = 0.3;  ///< share of a picture's width that neighbouring legs have in common
};
[[nodiscard]] base::Result<SurveyReport> fly_lawn_mower(CarPark const& park, SurveyRunSettings const& settings,
                                                        LawnMower const& mower);

}  // namespace lapwing::explore
