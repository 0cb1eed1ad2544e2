#pragma once

#include <optional>
#include <string>

#include "autonomy/operator/report_reader.hpp"
#include "vehicle/control.hpp"

namespace lapwing::host {

/// What an emergency stop has to say to a survey drone now.
struct SurveyStop {
  std::optional<std::string> command = {};  ///< nothing: it does what it shall
  bool is_done = false;                     ///< by its own account
  std::string detail = {};                  ///< what it does
};

/// By what the drone said last; of one that has said nothing, the command that it takes in every state that fits. Its
/// operation states have no word for staying in place: in flight it is told to move to where it is, and hovers there.
/// On a climb or on its way home it does not take that; then it comes home.
[[nodiscard]] SurveyStop survey_stop(vehicle::StopAction action,
                                     std::optional<autonomy::report::Heartbeat> const& heartbeat);

}  // namespace lapwing::host
