#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

namespace lapwing::autonomy {

/// What the drone is about. Exactly one at a time; who flies is always the flight controller, which is asked.
enum class State : std::uint8_t {
  idle,
  configure,
  arm,
  takeoff,
  hover,
  autonomous_explore,
  autonomous_move,
  compulsive_move,
  desired_location_error,
  no_parking_lot_detected,
  land,
  communication_lost,
  malfunction,
};
inline constexpr std::size_t state_count = 13;
/// As heartbeats and the topic `curr_state` name it: "AutonomousExplore".
[[nodiscard]] std::string_view to_string(State state);

/// Some of the states.
class States {
 public:
  constexpr States() = default;
  constexpr States(State one) : bits_(static_cast<std::uint16_t>(1U << static_cast<unsigned>(one))) {}
  [[nodiscard]] constexpr bool has(State state) const { return (bits_ & States(state).bits_) != 0; }
  friend constexpr States operator|(States a, States b) {
    States both;
    both.bits_ = static_cast<std::uint16_t>(a.bits_ | b.bits_);
    return both;
  }
  friend constexpr bool operator==(States, States) = default;

 private:
  std::uint16_t bits_ = 0;
};
constexpr States operator|(State a, State b) {
  return States(a) | States(b);
}

[[nodiscard]] consteval std::array<State, state_count> every_state() {
  std::array<State, state_count> all{};
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<State>(i);
  return all;
}
inline constexpr std::array<State, state_count> all_states = every_state();
inline constexpr States any_state = [] {
  States all;
  for (auto const state : all_states) all = all | state;
  return all;
}();
/// In which it is in the air to do something, and can be told to do something else.
inline constexpr States flight_states = State::hover | State::autonomous_explore | State::autonomous_move |
                                        State::compulsive_move | State::desired_location_error |
                                        State::no_parking_lot_detected;
/// In which it comes down, whatever anybody says but Kill.
inline constexpr States descents = State::land | State::communication_lost | State::malfunction;

/// What the operator got wrong, by its number on the wire.
enum class UserError : std::uint8_t {
  none = 0,
  desired_location_out_of_bounds = 1,
  no_lot_detected = 2,
  height_params_invalid = 3,
};
[[nodiscard]] std::string_view to_string(UserError error);

struct Health {
  bool is_healthy = true;
  std::string reason = {};  ///< empty when it is
  friend bool operator==(Health const&, Health const&) = default;
};
/// The reason when the operator is not heard.
inline constexpr std::string_view communication_lost = "CommunicationLost";

}  // namespace lapwing::autonomy
