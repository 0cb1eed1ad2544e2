#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <numbers>

#include <fmt/format.h>

#include "base/async/scope.hpp"
#include "geo/position.hpp"
#include "station/station.hpp"
#include "station/testing/demo_control.hpp"
#include "station/testing/demo_map.hpp"
#include "station/testing/fake_alarms.hpp"
#include "station/testing/fake_parameters.hpp"

/// Test equipment for the browser app: a real station over made-up vehicles, so that web/e2e can show every state
/// (moving, lost, conflict, low battery) at will. usage: station_demo PORT WEB_FOLDER
namespace lapwing::station {
namespace {

using namespace std::chrono_literals;
using geo::Ned;
using geo::Wgs84;

constexpr Wgs84 origin = Wgs84::from_degrees(-35.363262, 149.165237, 584.0);

constexpr std::string_view example = R"(// Two copters survey the car park while the rover patrols its edge.
north = mission {
  home
  takeOff here, 20.m
  surveyArea (120.m, 80.m), 20.m, 70.percent
  returnHome
}
patrol = mission {
  move (0.m, 60.m, 0.m)
  move (90.m, 60.m, 0.m)
}

eye = pick { type 'UAV' payload 'Camera' }
cart = pick { type 'UGV' }

execute (north of eye) | (patrol of cart)
message 'survey done'
)";

/// One made-up vehicle that follows a closed path at constant speed.
struct Traveller {
  std::string id;
  vehicle::Family family;
  double speed_m_s;
  double alt_m;
  std::vector<Ned> path;
  double battery = 0.9;
};

std::vector<Ned> survey_path() {
  std::vector<Ned> path;
  for (int row = 0; row < 6; ++row) {
    double const north = 20.0 + row * 16.0;
    double const west = -10.0;
    double const east = 110.0;
    path.push_back({north, row % 2 ? east : west, 0});
    path.push_back({north, row % 2 ? west : east, 0});
  }
  return path;
}

std::vector<Ned> circle(Ned center, double radius_m) {
  std::vector<Ned> path;
  for (int i = 0; i < 24; ++i) {
    double const angle = i * std::numbers::pi / 12;
    path.push_back({center.north + radius_m * std::cos(angle), center.east + radius_m * std::sin(angle), 0});
  }
  return path;
}

std::vector<Traveller> travellers() {
  return {{"1", vehicle::Family::copter, 8.0, 20.0, survey_path(), 0.82},
          {"2", vehicle::Family::copter, 6.0, 30.0, circle({-40, 30, 0}, 45), 0.27},
          {"3", vehicle::Family::plane, 16.0, 80.0, circle({30, 60, 0}, 160), 0.64},
          {"4", vehicle::Family::rover, 2.0, 0.0, {{-10, -40, 0}, {120, -40, 0}, {120, -60, 0}, {-10, -60, 0}}, 0.55},
          {"5", vehicle::Family::rover, 0.0, 0.0, {{-30, -70, 0}, {-30, -69, 0}}, 0.97}};
}

struct Pose {
  Ned place;
  double heading_rad;
  std::size_t leg;
};

Pose pose_after(Traveller const& traveller, double travelled_m) {
  auto const& path = traveller.path;
  for (std::size_t leg = 0;; leg = (leg + 1) % path.size()) {
    auto const& from = path[leg];
    auto const& to = path[(leg + 1) % path.size()];
    double const north = to.north - from.north;
    double const east = to.east - from.east;
    double const length = std::hypot(north, east);
    if (travelled_m <= length) {
      double const share = travelled_m / length;
      return {
          {from.north + share * north, from.east + share * east, 0}, geo::wrap_two_pi(std::atan2(east, north)), leg};
    }
    travelled_m -= length;
  }
}

class DemoScript : public ScriptControl {
 public:
  DemoScript(base::Loop& loop, base::Logger log) : loop_(loop), log_(std::move(log)) {}

  [[nodiscard]] ScriptStatus status() const override { return status_; }
  [[nodiscard]] std::vector<tasks::TaskView> task_trees() const override {
    if (status_.state == ScriptState::idle && status_.message.empty()) return {};
    using enum tasks::TaskState;
    auto const active = status_.state == ScriptState::running ? running : stopped;
    int const item = static_cast<int>(base::to_seconds(loop_.now().time_since_epoch())) % 12;
    tasks::TaskView const north{
        3, "mission", "north", 2, active, vehicle::VehicleId{"1"}, fmt::format("item {}/12", item), {}};
    tasks::TaskView const patrol{4, "mission", "patrol", 8, active, vehicle::VehicleId{"4"}, "item 1/2", {}};
    return {{1,
             "sequence",
             "",
             16,
             active,
             {},
             "",
             {{2, "concurrent", "(north of eye) | (patrol of cart)", 16, active, {}, "", {north, patrol}},
              {5, "action", "message 'survey done'", 17, active == stopped ? stopped : waiting, {}, "", {}}}}};
  }
  [[nodiscard]] std::expected<void, StartFailure> start(std::string name, std::string source) override {
    if (status_.state == ScriptState::running || status_.state == ScriptState::stopping) {
      return std::unexpected(StartFailure{{base::ErrorKind::refused, "A script runs already.", "Stop it first."}, {}});
    }
    if (source.contains("takeOf ")) return std::unexpected(misspelt(name, source));
    status_ = {std::move(name), std::move(source), ScriptState::running, "", {}};
    log_.info("script started");
    return {};
  }
  void stop(std::string by) override {
    if (status_.state != ScriptState::running) return;
    stopped_by_ = std::move(by);
    status_.state = ScriptState::stopping;
    status_.message = "vehicles go into LOITER";
    log_.warn("script stops: vehicles go into LOITER");
    stopping_since_ = loop_.now();
  }
  void advance() {
    if (status_.state != ScriptState::stopping || loop_.now() - stopping_since_ < 1500ms) return;
    status_.state = ScriptState::stopped;
    status_.message = fmt::format("stopped by {}", stopped_by_);
  }

 private:
  static StartFailure misspelt(std::string const& name, std::string_view source) {
    auto const place = source.find("takeOf ");
    auto const line = static_cast<std::uint32_t>(1 + std::ranges::count(source.substr(0, place), '\n'));
    return {
        {base::ErrorKind::invalid_input, "The script does not check: 1 error.", "Mend it and start again."},
        {{name, {line, 3}, {line, 9}, "error", "takeOf is not defined", "did you mean takeOff?", {}, "unknown-name"}}};
  }

  base::Loop& loop_;
  base::Logger log_;
  ScriptStatus status_{.name = "survey.dolphin",
                       .source = std::string(example),
                       .state = ScriptState::running,
                       .message = {},
                       .diagnostics = {}};
  base::TimePoint stopping_since_{};
  std::string stopped_by_;
};

void update(vehicle::VehicleState& state, Traveller const& traveller, base::TimePoint now, bool holds) {
  auto const pose =
      pose_after(traveller, std::fmod(traveller.speed_m_s * base::to_seconds(now.time_since_epoch()), 100'000.0));
  auto const place = geo::displaced(origin, {pose.place.north, pose.place.east, -traveller.alt_m});
  bool const moves = traveller.speed_m_s > 0;
  state.system_id = std::atoi(traveller.id.c_str());
  state.name = fmt::format("{} {}", vehicle::to_string(traveller.family), traveller.id);
  state.family = traveller.family;
  state.autopilot = vehicle::Autopilot::ardupilot;
  state.links.used = "udpin://127.0.0.1:14550";
  state.links.heartbeat_heard = state.links.heard = now;
  state.mode.set(!moves ? "HOLD" : holds ? "LOITER" : "AUTO", now);
  state.arming.armed.set(moves, now);
  state.motion.landed.set(!moves || traveller.alt_m == 0, now);
  state.motion.position.set(place, now);
  state.motion.relative_alt_m.set(traveller.alt_m, now);
  state.motion.heading_rad.set(pose.heading_rad, now);
  state.motion.velocity_m_s.set(
      {traveller.speed_m_s * std::cos(pose.heading_rad), traveller.speed_m_s * std::sin(pose.heading_rad), 0}, now);
  state.power.battery.set({.remaining = traveller.battery - base::to_seconds(now.time_since_epoch()) / 3600,
                           .voltage_v = 15.2,
                           .current_a = 8.0},
                          now);
  state.arming.health.set({.position_ok = true, .prearm_ok = true}, now);
  state.motion.home.set(origin, now);
  state.mission.progress.set({static_cast<int>(pose.leg) + 1, static_cast<int>(traveller.path.size()), false}, now);
  state.motion.track_m = traveller.speed_m_s * base::to_seconds(now.time_since_epoch());
  if (!state.mission.planned_path.empty() || !moves) return;
  for (auto const& point : traveller.path) {
    state.mission.planned_path.push_back(geo::displaced(origin, {point.north, point.east, -traveller.alt_m}));
  }
}

/// What vehicle 1 tells beyond its position: it takes a picture every two seconds and has a camera that fell silent.
void update_health(vehicle::VehicleState& state, base::TimePoint now, base::TimePoint begun) {
  state.positioning.gps.set({.fix = 6, .satellites = 14, .hdop = 0.71}, now);
  state.positioning.estimator.set(
      {.velocity = 0.05, .position_horizontal = 0.04, .position_vertical = 0.02, .compass = 0.62}, now);
  state.motion.hud.set({.airspeed_m_s = 8.2, .climb_m_s = 0.1, .throttle = 0.46}, now);
  state.motion.wind.set({.from_rad = 4.1, .speed_m_s = 3.2}, now);
  state.links.remote_control.set({.is_lost = true, .channels = 0, .pulses_us = {}, .rssi = {}}, now);
  state.links.radio.set({.rssi = 182,
                         .remote_rssi = 176,
                         .noise = 41,
                         .remote_noise = 38,
                         .transmit_buffer_free = 0.96,
                         .receive_errors = 0},
                        now);
  state.mission.waypoint_distance_m.set(34.0, now);
  state.mission.progress.value->state = "active";
  state.payload.gimbal.set(
      {.roll_rad = 0.0, .pitch_rad = -std::numbers::pi / 2, .yaw_rad = 0.8, .yaw_is_from_north = true}, now);
  state.payload.components = {{.id = 100, .kind = "camera", .state = "standby", .model = "Maker M1", .heard = begun},
                              {.id = 191, .kind = "companion computer", .state = "active", .model = {}, .heard = now}};
  auto& battery = *state.power.battery.value;
  battery.consumed_ah = 1.31;
  battery.time_left = std::chrono::seconds(static_cast<int>(battery.remaining * 1200.0));
  battery.time_left_error = *battery.time_left / 5;
  battery.time_left_is_estimate = true;
  battery.in_flight = vehicle::Endurance{*battery.time_left, battery.time_left_error};
  auto pictures = state.payload.pictures.value.value_or(vehicle::Pictures{});
  if (state.motion.position.value && (!state.payload.pictures.known() || now - state.payload.pictures.heard >= 2s)) {
    pictures.recent.push_back({++pictures.taken, *state.motion.position.value, 20.0});
    state.payload.pictures.set(std::move(pictures), now);
  }
  if (state.recent_texts.empty())
    state.recent_texts = {{.severity = 6, .text = "Mission: 1 Takeoff", .heard = begun},
                          {.severity = 4, .text = "EKF3 compass variance", .heard = begun}};
}

void update_link(vehicle::VehicleState& state) {
  state.links.all = {{.name = "udpin://127.0.0.1:14550",
                      .loss = 0.0,
                      .messages_per_s = 20,
                      .bytes_per_s = 900,
                      .round_trip = {},
                      .is_alive = true,
                      .is_used = true}};
}

/// The rover that goes away: heard for 2.5 s, silent from 5 s on and lost from 7 s on.
void let_go(vehicle::VehicleState& state, testing::FakeAlarms& alarms, base::TimePoint now, base::Logger const& log) {
  auto const since = now.time_since_epoch();
  if (since > 5s && !std::exchange(state.links.is_silent, true)) {
    alarms.raise(vehicle::AlarmKind::silent, state.id.text, state.links.heard);
    alarms.list.back().words = "rover 5 silent, last known disarmed";
  }
  if (since <= 7s || std::exchange(state.links.connection, vehicle::Connection::lost) == vehicle::Connection::lost)
    return;
  alarms.clear(vehicle::AlarmKind::silent, state.id.text);
  alarms.raise(vehicle::AlarmKind::lost, state.id.text, state.links.heard);
  alarms.list.back().words = "rover 5 lost: silent for 5 s";
  log.error("rover 5 lost: silent for 5 s");
}

/// Moves everything ten times a second.
base::Task<void> animate(base::Loop& loop, vehicle::Registry& registry, DemoScript& script,
                         testing::DemoControl& control, testing::FakeAlarms& alarms, base::Logger log) {
  for (auto const* id : {"1", "4"}) registry.edit({id}).control.commander = "script";
  auto const all = travellers();
  auto const begun = loop.now();
  for (;;) {
    auto const now = loop.now();
    for (auto const& traveller : all) {
      vehicle::VehicleId const id{traveller.id};
      auto& state = registry.edit(id);
      bool const is_heard = id.text != "5" || now.time_since_epoch() < 2500ms;
      if (is_heard)
        update(state, traveller, now, script.status().state != ScriptState::running);
      else
        let_go(state, alarms, now, log);
      if (id.text == "1") update_health(state, now, begun);
      if (id.text == "5") update_link(state);
      registry.touch(id);
    }
    script.advance();
    control.advance();
    co_await loop.sleep(100ms);
  }
}

int run(int port, std::filesystem::path const& web_folder, std::string token) {
  base::Loop loop;
  base::LogHub hub;
  hub.add_sink(base::standard_error_sink(base::LogLevel::info));
  base::Logger const log(hub, "demo");
  vehicle::Registry registry(loop);
  DemoScript script(loop, log.named("script"));
  testing::DemoControl control(loop, registry);
  testing::FakeParameters parameters(loop, 4s);
  testing::FakeAlarms alarms;
  alarms.raise(vehicle::AlarmKind::battery_low, "2", loop.now());
  alarms.list.back().words = "copter 2 battery low: 27 % left";
  map::LiveMap live_map([&loop] { return loop.utc_now(); });
  testing::DemoMap const content(live_map, origin, loop.utc_now());
  Station::Options options;
  options.map = &live_map;
  options.alarms = &alarms;
  options.control = &control;
  options.parameters = &parameters;
  options.http.port = port;
  options.http.static_root = web_folder;
  options.program_version = "0.1.0";
  options.http.token = std::move(token);
  options.site = {"demo field", origin};
  options.scripts = web_folder / "../../examples";
  auto const station = Station::open(loop, registry, script, hub, std::move(options));
  if (!station) {
    fmt::print(stderr, "{} {}\n", station.error().message, station.error().hint);
    return 3;
  }
  fmt::print("{}\n", (*station)->url());
  std::fflush(stdout);
  log.info("five vehicles found");
  log.named("vehicle 2").warn("battery at 27 %");
  base::Scope scope(loop);
  scope.spawn(animate(loop, registry, script, control, alarms, log));
  loop.run();
  return 0;
}

}  // namespace
}  // namespace lapwing::station

int main(int argc, char** argv) {
  if (argc != 3 && argc != 4) {
    fmt::print(stderr, "usage: station_demo PORT WEB_FOLDER [TOKEN]\n");
    return 2;
  }
  return lapwing::station::run(std::atoi(argv[1]), argv[2], argc == 4 ? argv[3] : "");
}
