#include "autonomy/states/page.hpp"

#include <iterator>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "autonomy/states/transitions.hpp"

namespace lapwing::autonomy {

namespace {

constexpr std::string_view any_flight = "Flight";

/// The flight states, which share most rows, are one name.
std::vector<std::string_view> names_of(States states) {
  if (states == any_state) return {"any"};
  std::vector<std::string_view> names;
  bool const has_all_flight = (states | flight_states) == states;
  for (auto const state : all_states)
    if (states.has(state) && !(has_all_flight && flight_states.has(state))) names.push_back(to_string(state));
  if (has_all_flight) names.push_back(any_flight);
  return names;
}

std::string joined(std::vector<std::string_view> const& names) {
  return fmt::format("{}", fmt::join(names, ", "));
}

/// One arrow for all that leads from one state to another.
struct Arrow {
  std::string_view from;
  std::string_view to;
  std::string label;
};

void add(std::vector<Arrow>& arrows, std::string_view from, Transition const& row) {
  for (auto& arrow : arrows) {
    if (arrow.from != from || arrow.to != to_string(row.next)) continue;
    arrow.label += fmt::format(" / {}", to_string(row.event));
    return;
  }
  arrows.push_back({from, to_string(row.next), std::string(to_string(row.event))});
}

std::string diagram() {
  std::vector<Arrow> arrows;
  for (auto const& row : transition_table())
    if (row.from != any_state)
      for (auto const from : names_of(row.from)) add(arrows, from, row);
  std::string text = "```mermaid\nstateDiagram-v2\n  [*] --> Idle\n";
  auto const out = std::back_inserter(text);
  fmt::format_to(out, "  {} : any flight state\n", any_flight);
  // A colon would end the label.
  for (auto& arrow : arrows)
    for (auto at = arrow.label.find(':'); at != std::string::npos; at = arrow.label.find(':')) arrow.label.erase(at, 1);
  for (auto const& arrow : arrows) fmt::format_to(out, "  {} --> {} : {}\n", arrow.from, arrow.to, arrow.label);
  return text + "```\n";
}

std::string states_table() {
  std::string text = "| state | on entry | each frame |\n|---|---|---|\n";
  for (auto const state : all_states) {
    auto const& behaviour = behaviour_of(state);
    fmt::format_to(std::back_inserter(text), "| {} | {} | {} |\n", to_string(state), behaviour.on_entry,
                   behaviour.each_frame);
  }
  return text;
}

std::string rows_table() {
  std::string text = "| in | event | if | does | to |\n|---|---|---|---|---|\n";
  for (auto const& row : transition_table())
    fmt::format_to(std::back_inserter(text), "| {} | {} | {} | {} | {} |\n", joined(names_of(row.from)),
                   to_string(row.event), row.guard.words, row.action.words, to_string(row.next));
  return text;
}

}  // namespace

std::string states_page() {
  return fmt::format(
      "{}\n*Flight* is any of {}. Kill, which leads from every state to Idle, is left out of the drawing.\n\n{}\n{}",
      diagram(),
      [] {
        std::vector<std::string_view> names;
        for (auto const state : all_states)
          if (flight_states.has(state)) names.push_back(to_string(state));
        return joined(names);
      }(),
      states_table(), rows_table());
}

}  // namespace lapwing::autonomy
