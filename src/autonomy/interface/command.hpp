#pragma once

#include <cstddef>
#include <optional>
#include <string_view>
#include <variant>

#include "autonomy/interface/heights.hpp"
#include "geo/point.hpp"
#include "geo/position.hpp"

namespace lapwing::autonomy {

/// x east, y north, z up from where the drone was armed: the local position of MAVROS.
struct ArmingFrame {};

/// What the operator can want.
namespace command {

struct Configure {
  HoverHeights heights;
};
struct Arm {};
struct Disarm {};
struct Takeoff {};
struct Land {};
struct AutonomousExplore {};
/// Within the lot, by the map.
struct AutonomousMove {
  geo::Point<ArmingFrame> place;
  std::optional<double> yaw_rad = {};  ///< counterclockwise from east
};
/// Whatever the map says.
struct CompulsiveMove {
  std::variant<geo::Point<ArmingFrame>, geo::Wgs84> place;  ///< the altitude of the latter does not count
  std::optional<double> yaw_rad = {};
};
/// The motors stop at once, wherever the drone is.
struct Kill {};

}  // namespace command

using Command =
    std::variant<command::Kill, command::Configure, command::Arm, command::Disarm, command::Takeoff, command::Land,
                 command::AutonomousExplore, command::AutonomousMove, command::CompulsiveMove>;
inline constexpr std::size_t command_count = std::variant_size_v<Command>;

/// As the operator writes it, by its place among the alternatives: "Autonomous Explore".
[[nodiscard]] std::string_view command_name(std::size_t index);
[[nodiscard]] inline std::string_view name_of(Command const& command) {
  return command_name(command.index());
}

}  // namespace lapwing::autonomy
