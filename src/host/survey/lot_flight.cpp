#include "host/survey/lot_flight.hpp"

#include <algorithm>
#include <optional>
#include <utility>
#include <variant>

#include <fmt/format.h>

#include "autonomy/interface/said.hpp"
#include "geo/site.hpp"

namespace lapwing::host {

using autonomy::State;
using autonomy::States;
using base::ErrorKind;
using base::fail;
using namespace std::chrono_literals;

namespace {

constexpr base::Duration look_every = 200ms;
constexpr base::Duration arming_shows_within = 2s;
/// ArduPilot takes a minute or more until it knows where it is.
constexpr base::Duration longest_refusal = 2min;
/// The drone gives up by itself after 20 s.
constexpr base::Duration longest_arming = 25s;
/// By itself after 15 s and 2 s a metre.
constexpr base::Duration longest_climb = 5min;
constexpr base::Duration longest_return = 20min;
/// How far a survey is, a drone tells every few seconds.
constexpr base::Duration longest_silence = 60s;
constexpr base::Duration for_ever = 24h * 365;

constexpr States on_ground = State::idle | State::configure;
constexpr States moves = State::autonomous_move | State::compulsive_move;

std::optional<State> state_of(autonomy::report::Heartbeat const& heartbeat) {
  for (auto const state : autonomy::all_states)
    if (to_string(state) == heartbeat.state) return state;
  return std::nullopt;
}

std::string simple(std::string_view type) {
  return fmt::format(R"({{"Type":"{}"}})", type);
}

}  // namespace

LotFlight::LotFlight(base::Loop& loop, SurveyDesk& desk, std::string drone,
                     std::shared_ptr<autonomy::LotTask const> task, base::Duration patience)
    : loop_(loop), desk_(desk), drone_(std::move(drone)), task_(std::move(task)), patience_(patience) {}

base::Task<> LotFlight::fly() {
  for (auto const& step : task_->steps()) {
    record_->progress = to_text(step);
    auto carrying = carry_out(step);
    auto const carried = co_await carrying;
    if (carried) continue;
    record_->error = carried.error().message;
    record_->is_drone_at_fault = carried.error().kind == ErrorKind::lost;
    record_->outcome = LotRecord::Outcome::failed;
    co_return;
  }
  record_->outcome = LotRecord::Outcome::done;
}

base::Task<base::Result<>> LotFlight::carry_out(autonomy::Step step) {
  if (std::holds_alternative<autonomy::ComeHomeStep>(step)) {
    auto coming = come_home();
    co_return co_await coming;
  }
  auto climbing = take_off();
  if (auto flies = co_await climbing; !flies) co_return flies;
  record_->progress = to_text(step);
  if (auto const* const to = std::get_if<autonomy::MoveStep>(&step)) {
    auto moving = move(*to);
    co_return co_await moving;
  }
  if (auto const* const pause = std::get_if<autonomy::WaitStep>(&step)) {
    auto waiting = wait(base::from_seconds(pause->seconds));
    co_return co_await waiting;
  }
  auto exploring = explore();
  co_return co_await exploring;
}

/// A flight controller that was just switched on refuses for a while, some of them after their checks have passed.
base::Task<base::Result<>> LotFlight::arm() {
  record_->progress = "arm";
  auto const deadline = loop_.now() + longest_refusal;
  for (;;) {
    auto asking = ask(simple("Arm"), on_ground, State::arm, arming_shows_within);
    auto asked = co_await asking;
    if (asked) {
      auto arming = until([](Heartbeat const& drone) { return drone.is_armed && drone.mode == "GUIDED"; }, State::arm,
                          longest_arming, "arms");
      asked = co_await arming;
    }
    bool const may_go_well = !asked && (asked.error().kind == ErrorKind::timed_out || has_given_up_arming());
    if (!may_go_well || loop_.now() >= deadline) co_return asked;
    auto resting = until([](Heartbeat const& drone) { return !drone.is_armed; }, on_ground, arming_shows_within,
                         "does not come to rest, and");
    if (auto rests = co_await resting; !rests) co_return rests;
  }
}

base::Task<base::Result<>> LotFlight::take_off() {
  if (is_in(on_ground)) {
    auto arming = arm();
    if (auto armed = co_await arming; !armed) co_return armed;
  }
  if (is_in(State::arm)) {
    record_->progress = "take off";
    auto asking = ask(simple("Takeoff"), State::arm, State::takeoff | autonomy::flight_states);
    if (auto asked = co_await asking; !asked) co_return asked;
  }
  auto climbing = until([](Heartbeat const& drone) { return autonomy::flight_states.has(*state_of(drone)); },
                        State::takeoff | autonomy::flight_states, longest_climb, "takes off");
  co_return co_await climbing;
}

base::Task<base::Result<>> LotFlight::explore() {
  if (!is_in(State::autonomous_explore)) {
    auto const before = desk_.survey(drone_).value_or(autonomy::report::Survey{}).begun;
    auto asking = ask(simple("Autonomous Explore"), autonomy::flight_states, State::autonomous_explore);
    if (auto asked = co_await asking; !asked) co_return asked;
    // What it tells of the survey before is not about this one.
    auto beginning = until(
        [this, before](Heartbeat const&) {
          auto const survey = desk_.survey(drone_);
          return survey && survey->begun != before;
        },
        State::autonomous_explore, longest_silence, "tells nothing of its survey, and");
    if (auto begun = co_await beginning; !begun) co_return begun;
  }
  auto exploring = until([this](Heartbeat const&) { return desk_.survey(drone_)->is_over; }, State::autonomous_explore,
                         for_ever, "explores");
  co_return co_await exploring;
}

base::Task<base::Result<>> LotFlight::move(autonomy::MoveStep step) {
  auto const to = local_place(step.place);
  if (!to) co_return std::unexpected(to.error());
  auto const is_there = [to = *to](Heartbeat const& drone) {
    return state_of(drone) == State::hover && drone.local && geo::distance_m(*drone.local, to) <= arrived_m;
  };
  bool const was_there = desk_.heartbeat(drone_) && is_there(*desk_.heartbeat(drone_));
  if (was_there) co_return base::Result<>{};
  auto const type = step.is_anywhere ? "Compulsive Move" : "Autonomous Move";
  auto asking = ask(fmt::format(R"({{"Type":"{}","X":{:.3f},"Y":{:.3f}}})", type, to->x(), to->y()),
                    autonomy::flight_states, moves | State::desired_location_error);
  if (auto asked = co_await asking; !asked) co_return asked;
  auto moving = until([](Heartbeat const& drone) { return !moves.has(*state_of(drone)); }, autonomy::flight_states,
                      for_ever, "moves");
  if (auto moved = co_await moving; !moved) co_return moved;
  if (is_there(*desk_.heartbeat(drone_))) co_return base::Result<>{};
  auto const why =
      is_in(State::desired_location_error) ? "its map does not have the place in the lot" : "it does not move on";
  co_return fail(ErrorKind::refused, fmt::format("{}: {}{}", drone_, why, said()));
}

base::Task<base::Result<>> LotFlight::wait(base::Duration time) {
  auto const end = loop_.now() + time;
  auto waiting =
      until([this, end](Heartbeat const&) { return loop_.now() >= end; }, autonomy::flight_states, for_ever, "hovers");
  co_return co_await waiting;
}

base::Task<base::Result<>> LotFlight::come_home() {
  if (is_in(State::arm)) {
    auto asking = ask(simple("Disarm"), State::arm, on_ground);
    if (auto asked = co_await asking; !asked) co_return asked;
  } else if (is_in(State::takeoff | autonomy::flight_states)) {
    auto asking = ask(simple("Land"), State::takeoff | autonomy::flight_states, State::land | on_ground);
    if (auto asked = co_await asking; !asked) co_return asked;
  }
  auto landing = until([](Heartbeat const& drone) { return on_ground.has(*state_of(drone)) && !drone.is_armed; },
                       autonomy::any_state, longest_return, "comes home");
  co_return co_await landing;
}

base::Task<base::Result<>> LotFlight::ask(std::string command, States from, States into, base::Duration at_most) {
  told_at_ = loop_.utc_now();
  if (auto sent = desk_.order(drone_, command); !sent) co_return sent;
  auto turning = until([into](Heartbeat const& drone) { return into.has(*state_of(drone)); }, from | into, at_most,
                       "was told to do something else, and");
  co_return co_await turning;
}

base::Task<base::Result<>> LotFlight::until(Looks is_there, States states, base::Duration at_most,
                                            std::string_view what) {
  auto const deadline = loop_.now() + at_most;
  auto reached_at = loop_.now();
  for (;;) {
    bool const is_reached = desk_.is_connected(drone_);
    if (is_reached) reached_at = loop_.now();
    if (loop_.now() - reached_at > patience_) co_return fail(ErrorKind::lost, fmt::format("{} is lost", drone_));
    auto const heartbeat = desk_.heartbeat(drone_);
    auto const state = heartbeat ? state_of(*heartbeat) : std::nullopt;
    if (is_reached && state) {
      if (is_there(*heartbeat) && states.has(*state)) co_return base::Result<>{};
      if (!states.has(*state)) {
        bool const comes_down = autonomy::descents.has(*state);
        co_return fail(comes_down ? ErrorKind::lost : ErrorKind::refused,
                       fmt::format("{} is in {} now{}", drone_, heartbeat->state, said()));
      }
    }
    if (loop_.now() >= deadline)
      co_return fail(ErrorKind::timed_out, fmt::format("{} {} does not get on{}", drone_, what, said()));
    co_await desk_.heard().wait_until(loop_.now() + look_every);
  }
}

bool LotFlight::is_in(States states) const {
  auto const heartbeat = desk_.heartbeat(drone_);
  auto const state = heartbeat ? state_of(*heartbeat) : std::nullopt;
  return state && states.has(*state);
}

base::Result<geo::Point<autonomy::ArmingFrame>> LotFlight::local_place(geo::Wgs84 const& place) const {
  auto const heartbeat = desk_.heartbeat(drone_);
  if (!heartbeat || !heartbeat->position || !heartbeat->local)
    return fail(ErrorKind::refused, fmt::format("{} does not tell where it is", drone_));
  auto const here = geo::Site::make("here", *heartbeat->position);
  if (!here) return std::unexpected(here.error());
  auto const way = here->point_of(place);
  return geo::Point<autonomy::ArmingFrame>(heartbeat->local->x() + way.x(), heartbeat->local->y() + way.y());
}

std::vector<std::string> LotFlight::words_since_told() const {
  std::vector<std::string> words;
  for (auto const& drone : desk_.drones()) {
    if (drone.name != drone_) continue;
    for (auto const& [at, text] : drone.words)
      if (at >= told_at_) words.push_back(text);
  }
  return words;
}

std::string LotFlight::said() const {
  auto const words = words_since_told();
  return words.empty() ? std::string() : ": " + words.back();
}

bool LotFlight::has_given_up_arming() const {
  return std::ranges::any_of(words_since_told(),
                             [](auto const& text) { return text.starts_with(autonomy::arming_given_up); });
}

}  // namespace lapwing::host
