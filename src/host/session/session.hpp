#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/log.hpp"
#include "fleet/control/fleet_control.hpp"
#include "fleet/control/fleet_parameters.hpp"
#include "fleet/mission/fleet_platform.hpp"
#include "host/car_park/lot_watch.hpp"
#include "host/eyes/looking_child.hpp"
#include "host/files/event_file.hpp"
#include "host/files/plans.hpp"
#include "host/links/equipment.hpp"
#include "host/links/forward.hpp"
#include "host/links/ground.hpp"
#include "host/links/recording.hpp"
#include "host/map/map_exports.hpp"
#include "host/map/station_map.hpp"
#include "host/map/track_writer.hpp"
#include "host/robots/robots.hpp"
#include "host/session/script_host.hpp"
#include "host/station/station_config.hpp"
#include "host/station/web_access.hpp"
#include "host/survey/survey_control.hpp"
#include "host/survey/survey_platform.hpp"
#include "map/live/live_map.hpp"
#include "plan/plausibility/settings.hpp"
#include "robot/old_parts/text_port.hpp"
#include "robot/platform/robot_control.hpp"
#include "robot/platform/robot_modules.hpp"
#include "robot/platform/robot_platform.hpp"
#include "route/router.hpp"
#include "sim/world/world.hpp"
#include "station/station.hpp"
#include "tasks/platforms.hpp"
#include "vehicle/joined/joined_control.hpp"
#include "vehicle/joined/joined_parameters.hpp"

namespace lapwing::host {

/// Everything that `run`, `demo` and `station` share: loop, log, ground side, script host, and the optional simulation
/// and map. Members end in reverse order: what talks ends before what it talks through.
class Session {
 public:
  struct Options {
    double speedup = 1.0;  ///< 0: as fast as the machine computes
    fleet::OnStop on_stop = fleet::OnStop::loiter;
    vehicle::StopAction emergency_action = vehicle::StopAction::hold;
    vehicle::BatteryLimits battery_limits = {};  ///< of alarms
    LoadedPlans plans = {};
    Equipment payload = {};
    plan::plausibility::Settings plausibility = {};
    EventFile const* events = nullptr;  ///< outlives the session
    base::LogLevel log_level = base::LogLevel::info;
    /// Of what scripts draw by lot; also sets the calendar to a fixed time, so that a run repeats.
    std::optional<std::uint64_t> seed = std::nullopt;
    std::optional<base::UtcTime> begins_at = std::nullopt;  ///< what the calendar shows at the start; empty: the wall's
    SigningSetup signing = {};
    bool listens_only = false;                    ///< asks vehicles for nothing
    std::vector<RobotCamera> robot_cameras = {};  ///< of robots that are no simulated ones
    std::filesystem::path pictures = {};          ///< folder for robots' photographs where no map is kept; empty: none
  };
  explicit Session(Options const& options);

  /// One more platform, beside the fleet: for scripts and, where it has them, with an operator's commands and
  /// parameters. Its vehicles are in `ground.registry`, and it asks `ground.authority` who commands them. Call it
  /// before anything is opened; they outlive the session. Error: invalid_input when its words have other meanings
  /// already.
  struct Joined {
    tasks::Platform& platform;
    vehicle::VehicleControl* control = nullptr;
    vehicle::VehicleParameters* parameters = nullptr;
  };
  [[nodiscard]] base::Result<> join(std::string const& name, Joined const& joined);

  /// Opens where the map is kept, so that robots that are added then stand in the site that is on it. Without this call
  /// `open_map` does it. Errors: those of `StationMap::open`.
  [[nodiscard]] base::Result<> open_store(MapContent const& content);

  /// Robots as `--robot` names them, in the site "default"; where that is not on the map yet, it is put there, at
  /// `anchor`. Call it before links and the map are opened. Errors: those of `make_robots` and `RobotPlatform::add`.
  [[nodiscard]] base::Result<> add_robots(std::vector<std::string> const& requests, geo::Wgs84 const& anchor);

  /// Joins old parts with robots, as `--old-parts` names both. Call it after `add_robots`. Errors: those of
  /// `parse_old_parts` and of opening a link; invalid_input: there is no such robot.
  [[nodiscard]] base::Result<> open_old_parts(std::vector<std::string> const& requests);

  /// Connects to survey drones and goes on trying; scripts fly them, and the station shows and commands them. Call it
  /// before the map is opened. Errors: those of `SurveyDesk::open`.
  [[nodiscard]] base::Result<> open_survey(std::vector<SurveyLink> links);

  [[nodiscard]] base::Result<> open_links(std::vector<std::string> const& urls);
  [[nodiscard]] base::Result<> simulate(sim::WorldOptions options);
  /// Has the simulated drones look down at a simulated car park, whose slots they then put on the map; call after
  /// `simulate`. Errors, invalid_input: there are no simulated vehicles; not_found: there is no such file.
  [[nodiscard]] base::Result<> watch_car_park(std::filesystem::path const& world_file);
  /// Joins other programs with the vehicles, for as long as the session lives; call after `open_links`. Errors:
  /// invalid_input for a network that no link belongs to, and those of `route::Router::open`.
  [[nodiscard]] base::Result<> forward(std::vector<Forward> programs);
  /// Keeps everything that goes over the links in a new file of this folder, from now on; call before `open_links`.
  /// Further networks have files of their own.
  [[nodiscard]] base::Result<> record(std::string const& folder);
  /// Serves the map and tells its addresses on standard error; the token is in them, and nowhere else.
  /// `script`: what the map shows and starts; null: the host's.
  /// Vehicles can be commanded from it, unless `script` is somebody else's.
  [[nodiscard]] base::Result<> open_map(WebAccess const& access, MapContent const& content,
                                        station::ScriptControl* script = nullptr);

  /// Runs the script that the host was given to its end; `timeout` (loop time) halts it. Ctrl-C stops it. Then every
  /// vehicle that still runs a mission of ours is made safe.
  void run_to_end(std::optional<base::Duration> timeout);
  /// Serves until Ctrl-C, whatever scripts end meanwhile; then, as at any end, every vehicle is made safe. True: a
  /// script was under way then. `by`: what stopped it, for people.
  bool serve(std::string const& by);
  /// Vehicles get the message rates back that they had before; for the very end, takes three seconds at most.
  void give_back_rates() { loop.run_until_done(ground.fleet.give_back_rates()); }
  [[nodiscard]] RunReport report() const;

  base::LogHub hub;
  base::Loop loop;
  base::Logger log;
  Ground ground;
  fleet::FleetPlatform platform;
  fleet::FleetControl control;                                ///< what operators do with the fleet's vehicles
  fleet::FleetParameters parameters;                          ///< of those, asked for when an operator asks
  lapwing::map::LiveMap live_map;                             ///< what lies on the map
  std::vector<std::unique_ptr<SimulatedBuilding>> buildings;  ///< in which simulated robots drive
  std::unique_ptr<LookingChild> looking;                      ///< at what robots' cameras see, where there are some
  robot::RobotPlatform robots;
  robot::RobotControl robot_control;   ///< what operators do with the robots
  robot::RobotModules robot_modules;   ///< how the robots' modules do
  SurveyPlatform survey;               ///< survey drones
  tasks::Platforms platforms;          ///< the fleet, the robots, survey drones and what has joined them, for scripts
  vehicle::JoinedControl all_control;  ///< the same for operators
  vehicle::JoinedParameters all_parameters;
  std::vector<std::unique_ptr<robot::TextPort>> old_parts;  ///< that speak the seed's lines with robots
  std::map<std::string, route::Router> forwarding;          ///< where others ride along, by network
  std::unique_ptr<Recording> recording;
  std::vector<std::unique_ptr<Recording>> network_recordings;
  std::unique_ptr<dolphin::Output> console;
  ScriptHost host;
  std::unique_ptr<sim::World> world;
  std::unique_ptr<LookingChild> overlook;  ///< shows simulated drones a simulated car park
  std::unique_ptr<LotWatch> lot_watch;
  std::unique_ptr<StationMap> station_map;  ///< where there is a station to show it
  std::unique_ptr<MapExports> map_exports;
  std::unique_ptr<SurveyControl> survey_control;  ///< the emergency stop of survey drones, where there are some
  std::unique_ptr<TrackWriter> tracks;            ///< where there is a station to show them
  std::unique_ptr<station::Station> map;
  std::unique_ptr<SigningTimeKeeper> signing_time;  ///< in real time only: other clocks run ahead of other stations'

 private:
  [[nodiscard]] base::Task<base::Result<std::string>> keep_picture(std::string jpeg);
  [[nodiscard]] base::Task<base::Result<std::string>> write_picture(std::string name, std::string jpeg);
  void interrupt(std::string const& by);
  base::Task<> finish(std::optional<base::Duration> timeout);
  base::Task<> tell_while_interrupted();
  base::Task<> tell_while_nobody_is_heard();
  [[nodiscard]] bool is_nobody_heard() const;
  [[nodiscard]] bool is_an_operator_there() const;
  [[nodiscard]] std::string links_text() const;
  void note(tasks::TaskEvent const& event);

  fleet::OnStop on_stop_;
  vehicle::StopAction emergency_action_;
  base::Notifier interrupted_;  ///< by Ctrl-C
  bool is_interrupted_ = false;
  EventFile const* events_;
  CamerasOfRobots cameras_;
  std::filesystem::path pictures_;
  bool is_real_time_;                  ///< time does not wait for what is worked out beside the loop
  std::optional<LotScore> lot_score_;  ///< once the script has ended
  std::string record_folder_;
  std::uint64_t seed_;
};

/// Values of --emergency-stop.
[[nodiscard]] base::Result<vehicle::StopAction> parse_emergency_stop(std::string const& text);
/// Values of --on-stop.
[[nodiscard]] base::Result<fleet::OnStop> parse_on_stop(std::string const& text);

}  // namespace lapwing::host
