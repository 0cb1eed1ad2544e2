#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/time.hpp"
#include "plan/estimate.hpp"
#include "plan/track.hpp"
#include "tasks/platform.hpp"
#include "vehicle/family.hpp"

/// What a dry run saw. Times count from the script's start, places are in the local frame of the site.
namespace lapwing::dryrun {

/// The battery at a point of the track.
struct Charge {
  float remaining = 1.0F;  ///< 0..1
  float used_wh = 0.0F;    ///< since the start
};

/// One task on one vehicle, from the moment it was started (upload and arming included) to its end.
struct TaskSpan {
  enum class End { running, done, failed, stopped };
  std::string name;
  base::Duration begin{};
  base::Duration end{};
  End ending = End::running;
  std::string reason;                               ///< why, when failed
  std::shared_ptr<tasks::PlatformTask const> task;  ///< what it was, for its items
  std::optional<plan::Flown> flown;                 ///< beside the estimate; missions that began to move only
};
[[nodiscard]] std::string_view to_string(TaskSpan::End end);

struct ModeChange {
  base::Duration time{};
  std::string mode;  ///< the autopilot's own name, "AUTO"
};

struct VehicleRecord {
  std::string id;    ///< as scripts know it
  std::string name;  ///< "copter 1"
  vehicle::Family family = vehicle::Family::copter;
  plan::Track track;
  std::vector<Charge> charge;  ///< one for each point of the track
  std::vector<TaskSpan> tasks;
  std::size_t tasks_left_out = 0;  ///< beyond what is kept
  std::vector<ModeChange> modes;
  base::Duration under_way{};  ///< in the air; of a ground vehicle: in motion
  bool ends_in_the_air = false;
};

/// What the script said, and when.
struct Remark {
  base::Duration time{};
  std::string text;
};

struct FlightRecord {
  std::string script;
  std::string outcome;                   ///< done, error, halted, unfinished
  std::string reason;                    ///< why, unless done
  std::vector<std::string> waiting_for;  ///< what was still running when an unfinished flight was cut off
  geo::Wgs84 home;
  geo::Ned wind_m_s;      ///< where the air goes
  double gust_m_s = 0.0;  ///< standard deviation
  std::uint64_t seed = 1;
  base::Duration duration{};
  base::Duration sample_period{};
  double battery_wh = 0.0;  ///< a full pack
  std::vector<VehicleRecord> vehicles;
  std::vector<Remark> remarks;
};

}  // namespace lapwing::dryrun
