#pragma once

#include <functional>
#include <string>
#include <vector>

#include "base/log.hpp"
#include "station/http/router.hpp"
#include "vehicle/survey_drones.hpp"

/// What is told of survey drones, and their HTTP face: "Survey drones" in docs/reference/station-messages.md.
namespace lapwing::station {

[[nodiscard]] std::string survey_message(std::vector<vehicle::SurveyDroneView> const& drones);

/// `drones` may be null: then there are none. It, `log` and what `now` needs outlive the router.
void add_survey_routes(Router& router, vehicle::SurveyDrones* drones, base::Logger const& log,
                       std::function<base::UtcTime()> now);

}  // namespace lapwing::station
