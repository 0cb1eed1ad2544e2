#pragma once

#include <optional>
#include <string>

#include "base/time.hpp"

namespace lapwing::fleet {

/// How the last navigation item of a mission ends.
enum class MissionEnding {
  at_place,   ///< a waypoint or a limited loiter: done when reached
  on_ground,  ///< LAND or RTL: done when down
  never,      ///< an unlimited loiter, or a jump at the end: only the autopilot's word or a stop ends it
};

/// What the completion rules need to know of a mission. Sequence numbers as on the vehicle.
struct MissionShape {
  int last_nav_seq = 0;
  MissionEnding ending = MissionEnding::at_place;
};

/// What the vehicle tells about its mission run, gathered since AUTO was confirmed.
struct MissionSight {
  base::Duration since_start{};
  bool mode_is_auto = true;
  bool mode_is_return = false;  ///< RTL or one of its relatives
  std::string mode = {};        ///< name, for people
  base::Duration mode_for{};    ///< how long it has been in that mode
  bool armed = true;
  base::Duration disarmed_for{};
  bool was_active = false;  ///< the autopilot called the mission anything but complete since the start
  bool reports_complete = false;
  std::optional<int> current_seq = {};               ///< the highest seen
  std::optional<int> reached_seq = {};               ///< the highest seen
  std::optional<base::Duration> on_ground_for = {};  ///< nothing while flying, or unknown
  std::string failsafe = {};                         ///< the autopilot's text when it has just announced a failsafe
  base::Duration reason_wait{};  ///< after a change of mode: so long its reason may still be on the way
  bool sinks = false;            ///< too fast for one that stands on the ground
  bool fell = false;             ///< as only what has lost its motors in the air does
};

/// What becomes of a vehicle whose mission has failed.
enum class Aftermath {
  none,       ///< somebody else has it, or nothing moves any more
  stop_mode,  ///< nobody has taken it over, and it is still in its mission mode
  hold,       ///< the same, and it must not go anywhere: for that it would have to know where it is
};

struct MissionVerdict {
  enum class Kind { running, done, failed };
  Kind kind = Kind::running;
  std::string reason = {};
  Aftermath aftermath = Aftermath::none;
};

/// Whether the mission is over, by the language specification's rules (5.4, phase 7): completion by the autopilot's
/// word, by the last item reached, by a landing, by the autopilot's own return after the last item; and everything else
/// that takes the vehicle out of AUTO is somebody else's decision. Near the end that is decided seconds later, since
/// the news of the end may have been lost and are repeated. By what the vehicle says alone: whether it was at the
/// places is `FlightWatch`'s to know.
[[nodiscard]] MissionVerdict judge(MissionShape const& shape, MissionSight const& sight);

}  // namespace lapwing::fleet
