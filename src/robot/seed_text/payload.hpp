#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>

#include "base/error.hpp"
#include "robot/seed_text/line.hpp"
#include "robot/watch/module.hpp"

namespace lapwing::robot::seed_text {

// What the messages say, in SI units and radians; the seed's centimetres and degrees stand in the text alone.

/// `X:Y:Yaw` in whole centimetres and degrees. `X-Y-Yaw` and `X_Y_Yaw`, as the seed has it, are read, too.
struct Pose {
  double x_m = 0;
  double y_m = 0;
  double yaw_rad = 0;
};

/// `left:right:front` in whole centimetres, `-` for none.
struct Distances {
  std::optional<double> left_m;
  std::optional<double> right_m;
  std::optional<double> front_m;
};

/// `Stop`, `Low`, `Medium`, `High` or `Reverse`.
enum class Speed : std::uint8_t { stop, low, medium, high, reverse };

/// Degrees from 0 to 360, against the way the robot faced at its start; positive is to the left.
struct Angle {
  double rad = 0;
};

/// `Completed`: speed and angle are as the planner asked.
struct Completed {};

/// `Kill`; the seed's `e-Stop` is read, too.
struct Kill {};

/// What points of interest ask the planner for, besides a pose, and the command centre: `STOP`, `REVERSE` or
/// `CONTINUE`.
enum class Override : std::uint8_t { stop, reverse, go_on };

/// `"Door", "", 15, 20` or `"Name Tag", "221", 15, 20`: centimetres on the map.
struct PointOfInterest {
  enum class Kind : std::uint8_t { door, name_tag };
  Kind kind = Kind::door;
  std::string text;
  double x_m = 0;
  double y_m = 0;
};

/// `ready:302:1048576`: state, error code, bytes of memory.
struct LogEntry {
  ModuleState state = ModuleState::starting;
  std::uint16_t error_code = 0;
  std::uint64_t memory_bytes = 0;
};

using Payload = std::variant<Pose, Distances, Speed, Angle, Completed, Kill, Override, PointOfInterest, LogEntry>;

/// Error (invalid_input): a number beyond what the seed's variables hold (5 km), or a text longer than 200 characters.
[[nodiscard]] base::Result<std::string> write(Payload const& payload);

/// What `line` says, by who says it to whom (the seed's interfaces). Error (invalid_input): nothing that goes that way.
[[nodiscard]] base::Result<Payload> read_payload(Line const& line);

}  // namespace lapwing::robot::seed_text
