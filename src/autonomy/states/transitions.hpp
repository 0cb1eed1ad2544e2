#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "autonomy/interface/state.hpp"
#include "autonomy/states/event.hpp"
#include "autonomy/states/situation.hpp"

namespace lapwing::autonomy {

/// What must hold for a transition.
struct Guard {
  std::string_view words = {};  ///< for the page
  /// Why it does not hold, for the operator; nothing when it does. Null: it always does.
  std::optional<std::string> (*objection)(Situation const&) = nullptr;
};

/// What is done between leaving one state and entering the next.
struct Action {
  std::string_view words = {};
  void (*act)(Situation&) = nullptr;  ///< null: nothing
};

/// One row of the table: in one of these states this event leads there.
struct Transition {
  States from;
  Event event;
  Guard guard;
  Action action;
  State next;
};

/// All of them. The machine runs them, and the reference page and its diagram are made from them. Of one state and
/// event there is one.
[[nodiscard]] std::span<Transition const> transition_table();
/// Null when the state does not take the event.
[[nodiscard]] Transition const* find_transition(State from, Event event);

/// What a state does when it begins, and in each frame.
struct Behaviour {
  State state;
  std::string_view on_entry;
  void (*enter)(Situation&);
  std::string_view each_frame;
  void (*process)(Situation&);
};
[[nodiscard]] Behaviour const& behaviour_of(State state);

/// Whether the event is the case in this frame. Commands never are: they are given.
[[nodiscard]] bool happens(Event event, Situation const& s);

}  // namespace lapwing::autonomy
