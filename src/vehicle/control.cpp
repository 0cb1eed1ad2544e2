#include "vehicle/control.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace lapwing::vehicle {

namespace {

template <class Enum, std::size_t count>
std::string_view word_of(std::array<std::pair<Enum, std::string_view>, count> const& words, Enum value) {
  auto const found = std::ranges::find(words, value, &std::pair<Enum, std::string_view>::first);
  return found == words.end() ? std::string_view() : found->second;
}

template <class Enum, std::size_t count>
std::optional<Enum> value_of(std::array<std::pair<Enum, std::string_view>, count> const& words, std::string_view word) {
  auto const found = std::ranges::find(words, word, &std::pair<Enum, std::string_view>::second);
  return found == words.end() ? std::nullopt : std::optional(found->first);
}

constexpr std::array<std::pair<Action, std::string_view>, 11> actions{{{Action::arm, "arm"},
                                                                       {Action::disarm, "disarm"},
                                                                       {Action::take_off, "take_off"},
                                                                       {Action::land, "land"},
                                                                       {Action::return_home, "rtl"},
                                                                       {Action::hold, "hold"},
                                                                       {Action::go_to, "go_to"},
                                                                       {Action::set_mode, "set_mode"},
                                                                       {Action::start_mission, "start_mission"},
                                                                       {Action::pause_mission, "pause_mission"},
                                                                       {Action::resume_mission, "resume_mission"}}};

constexpr std::array<std::pair<CommandState, std::string_view>, 9> states{{{CommandState::waiting, "waiting"},
                                                                           {CommandState::accepted, "accepted"},
                                                                           {CommandState::under_way, "under_way"},
                                                                           {CommandState::confirmed, "confirmed"},
                                                                           {CommandState::refused, "refused"},
                                                                           {CommandState::timed_out, "timed_out"},
                                                                           {CommandState::expired, "expired"},
                                                                           {CommandState::superseded, "superseded"},
                                                                           {CommandState::cut_short, "cut_short"}}};

constexpr std::array<std::pair<StopAction, std::string_view>, 4> stops{{{StopAction::hold, "hold"},
                                                                        {StopAction::land, "land"},
                                                                        {StopAction::return_home, "rtl"},
                                                                        {StopAction::terminate, "terminate"}}};

}  // namespace

std::string_view to_string(Action action) {
  return word_of(actions, action);
}
std::optional<Action> action_from(std::string_view word) {
  return value_of(actions, word);
}

bool is_stop(Action action) {
  return action == Action::hold || action == Action::land || action == Action::return_home ||
         action == Action::disarm || action == Action::pause_mission;
}

std::string_view to_string(CommandState state) {
  return word_of(states, state);
}
bool is_over(CommandState state) {
  return state != CommandState::waiting && state != CommandState::accepted && state != CommandState::under_way;
}

void make_room(std::deque<CommandRecord>& records) {
  constexpr std::size_t most = 12;
  constexpr std::size_t most_with_open_ones = 60;
  if (records.size() < most) return;
  auto const is_closed = [](CommandRecord const& record) {
    return std::ranges::all_of(record.outcomes, [](auto const& outcome) { return is_over(outcome.state); });
  };
  auto const closed = std::ranges::find_if(records, is_closed);
  if (closed != records.end()) {
    records.erase(closed);
  } else if (records.size() >= most_with_open_ones) {
    records.pop_front();
  }
}

std::string_view to_string(StopAction action) {
  return word_of(stops, action);
}
std::optional<StopAction> stop_action_from(std::string_view word) {
  return value_of(stops, word);
}

}  // namespace lapwing::vehicle
