#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "base/time.hpp"
#include "fleet/mission/fleet_platform.hpp"
#include "host/car_park/lot_score.hpp"
#include "tasks/task_view.hpp"

namespace lapwing::host {

/// What a robot has mapped and driven.
struct RobotReport {
  struct Drive {
    std::string name = {};
    std::string outcome = {};  ///< "done", "failed", "stopped", "running"
    std::string error = {};
    std::string remark = {};  ///< what it is done without
  };
  double coverage = 0.0;  ///< 0..1, of what there seems to be
  double free_m2 = 0.0;
  int closures = 0;                     ///< loops that its map has closed
  std::optional<int> collisions = {};   ///< of a simulated one: how often it ran into something
  std::vector<std::string> signs = {};  ///< beside the doors that it has found: what is written on them, in order
  std::vector<Drive> drives = {};
};

struct VehicleReport {
  std::string id;
  int system_id = 0;
  std::string type;  ///< family: copter, plane, rover ...
  double track_m = 0.0;
  int pictures = 0;  ///< that it was heard to take
  std::vector<fleet::MissionReport> missions = {};
  std::optional<RobotReport> robot = {};  ///< of robots
};

/// What simulated drones have seen of a simulated car park, and how it compares with the truth.
struct CarParkReport {
  int pictures = 0;
  double coverage = 0.0;  ///< 0..1, of the slots and some metres round them
  int free = 0;           ///< slots on the map
  int taken = 0;
  int unknown = 0;
  std::optional<LotScore> score = {};
};

struct ErrorReport {
  std::string file;
  int line = 0;
  std::string message;
};

/// What `run` and `demo` write with --report: the contract of docs/reference/command-line.md.
struct RunReport {
  std::string script;
  std::string outcome;  ///< done, error, halted, interrupted
  base::UtcTime started{};
  base::UtcTime ended{};
  std::vector<VehicleReport> vehicles;
  std::optional<CarParkReport> car_park = {};  ///< where one was watched
  std::vector<tasks::TaskView> tasks;
  std::vector<ErrorReport> errors;
};

[[nodiscard]] std::string to_json(RunReport const& report);

}  // namespace lapwing::host
