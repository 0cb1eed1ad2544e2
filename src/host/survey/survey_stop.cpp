#include "host/survey/survey_stop.hpp"

#include <algorithm>
#include <array>
#include <span>
#include <string_view>

#include <fmt/format.h>

namespace lapwing::host {

namespace {

using autonomy::report::Heartbeat;
using vehicle::StopAction;

bool is_one_of(std::string_view state, std::span<std::string_view const> states) {
  return std::ranges::find(states, state) != states.end();
}

constexpr std::array<std::string_view, 3> hovering{"Hover", "DesiredLocationError", "NoParkingLotDetected"};
constexpr std::array<std::string_view, 3> moving{"AutonomousExplore", "AutonomousMove", "CompulsiveMove"};
constexpr std::array<std::string_view, 3> coming_home{"Land", "CommunicationLost", "Malfunction"};

SurveyStop come_home(Heartbeat const& drone) {
  if (is_one_of(drone.state, coming_home)) return {.is_done = true, .detail = "comes home"};
  return {.command = R"({"Type":"Land"})", .detail = "told to come home"};
}

SurveyStop stay(Heartbeat const& drone) {
  if (is_one_of(drone.state, hovering)) return {.is_done = true, .detail = "hovers"};
  if (is_one_of(drone.state, coming_home))
    return {.is_done = true, .detail = "comes home, and does not take a stop then but Kill"};
  if (!is_one_of(drone.state, moving) || !drone.local) return come_home(drone);
  return {.command = fmt::format(R"({{"Type":"Compulsive Move","X":{},"Y":{}}})", drone.local->x(), drone.local->y()),
          .detail = "told to stay where it is"};
}

}  // namespace

SurveyStop survey_stop(StopAction action, std::optional<Heartbeat> const& heartbeat) {
  bool const kills = action == StopAction::terminate;
  if (!heartbeat)
    return {.command = kills ? R"({"Type":"Kill"})" : R"({"Type":"Land"})", .detail = "has said nothing yet"};
  if (!heartbeat->is_armed) return {.is_done = true, .detail = "is disarmed"};
  if (kills) return {.command = R"({"Type":"Kill"})", .detail = "told to stop its motors"};
  bool const is_on_ground = heartbeat->state == "Arm" || heartbeat->state == "Idle";
  if (is_on_ground) return {.command = R"({"Type":"Disarm"})", .detail = "told to disarm"};
  return action == StopAction::hold ? stay(*heartbeat) : come_home(*heartbeat);
}

}  // namespace lapwing::host
