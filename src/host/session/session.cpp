#include "host/session/session.hpp"

#include <algorithm>
#include <cstdio>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/assert.hpp"
#include "base/async/pool.hpp"
#include "base/files/replace_file.hpp"
#include "host/files/files.hpp"
#include "host/robots/old_parts.hpp"
#include "host/robots/robots_feed.hpp"
#include "host/session/console.hpp"
#include "host/session/metrics.hpp"
#include "host/session/signals.hpp"
#include "host/simulation/simulation.hpp"
#include "mavlink/connection/connection_link.hpp"
#include "robot/watch/codes.hpp"

namespace lapwing::host {

namespace {

/// A script's own words are on standard output; standard error need not repeat them.
base::LogHub::Sink terminal_sink(base::LogLevel lowest) {
  return [sink = base::standard_error_sink(lowest)](base::LogRecord const& record) {
    if (record.source != script_source) sink(record);
  };
}

fleet::Fleet::Options fleet_options(Session::Options const& options) {
  fleet::Fleet::Options fleet{.battery_limits = options.battery_limits, .payload = options.payload};
  fleet.asks_for_messages = !options.listens_only;
  // The faster time runs, the more of it passes while a busy machine is late by a moment.
  constexpr base::Duration moment = std::chrono::milliseconds(300);
  fleet.silence = std::max(fleet.silence, base::from_seconds(base::to_seconds(moment) * options.speedup));
  return fleet;
}

base::Loop::Pace pace_of(Session::Options const& options) {
  auto pace = pace_for(options.speedup, options.seed);
  if (options.begins_at) pace.begins_at = options.begins_at;
  return pace;
}

std::vector<DroneInTheAir> drones_in_the_air(sim::World const& world) {
  std::vector<DroneInTheAir> drones;
  for (auto const& vehicle : world.vehicles()) {
    if (!vehicle->running() || vehicle->autopilot().body().on_ground) continue;
    drones.push_back({.vehicle = {std::to_string(vehicle->options().system_id)},
                      .place = vehicle->place(),
                      .heading_rad = vehicle->autopilot().body().attitude.yaw_rad});
  }
  return drones;
}

/// `program`: the one that looks.
LookingChild::Settings looking_settings(base::ChildProgram program, bool is_real_time) {
  LookingChild::Settings settings{.program = std::move(program)};
  if (is_real_time) {
    settings.takes = std::nullopt;
  } else {
    settings.program.niceness = 0;  // time waits for it
  }
  return settings;
}

base::Result<> put_into_folder(std::string path, std::string content) {
  std::error_code error;
  auto const folder = std::filesystem::path(path).parent_path();
  if (!folder.empty()) std::filesystem::create_directories(folder, error);
  if (error) return base::fail(base::ErrorKind::io, fmt::format("{}: {}", folder.string(), error.message()));
  return base::replace_file(path, content);
}

/// What a service prints lies in its journal: a token that has a file of its own stays there.
void tell_where_the_map_is(WebAccess const& access, int port, std::string const& token) {
  bool const is_in_file = !access.token_file.empty();
  fmt::print(stderr, "\n");
  for (auto const& address : map_addresses(access.bind, port, is_in_file ? std::string() : token))
    fmt::print(stderr, "    map  {}\n", address);
  if (is_in_file) fmt::print(stderr, "    its token is in {}; the map asks for it\n", access.token_file);
  fmt::print(stderr, "\n");
}

}  // namespace

base::Result<fleet::OnStop> parse_on_stop(std::string const& text) {
  if (auto const on_stop = fleet::on_stop_from(text)) return *on_stop;
  return base::fail(base::ErrorKind::invalid_input, fmt::format("--on-stop {} is not known", text),
                    "use loiter (hold in place, the default), rtl (return to launch) or land");
}

base::Result<vehicle::StopAction> parse_emergency_stop(std::string const& text) {
  if (auto const action = vehicle::stop_action_from(text)) return *action;
  return base::fail(base::ErrorKind::invalid_input, fmt::format("--emergency-stop {} is not known", text),
                    "use hold (stay in place, the default), land, rtl or terminate (motors off at once)");
}

Session::Session(Options const& options)
    : loop(pace_of(options)),
      log(hub, "lapwing"),
      ground(loop, log, fleet_options(options), options.signing),
      platform(ground.fleet,
               {.run = {.on_stop = options.on_stop, .plausibility = options.plausibility},
                .plan_library = options.plans.library},
               log.named("fleet")),
      control(ground.fleet, platform, {.stop_action = options.emergency_action, .plausibility = options.plausibility},
              log),
      parameters(ground.fleet, parameter_cache(), log),
      live_map([this] { return loop.utc_now(); }),
      robots({loop, ground.registry, ground.authority, live_map}, log.named("robots")),
      robot_control(robots, {loop, ground.authority}, log),
      robot_modules(robots),
      survey(loop, log.named("survey")),
      platforms(loop, log.named("platforms")),
      console(make_console(loop, log)),
      host(
          loop, platforms, *console, log, [this](tasks::TaskEvent const& event) { note(event); },
          options.seed.value_or(1)),
      on_stop_(options.on_stop),
      emergency_action_(options.emergency_action),
      interrupted_(loop),
      events_(options.events),
      cameras_{.cameras = options.robot_cameras,
               .shooter = looking_settings(LookingChild::program_beside_us("lapwing-perceive", "shoot"), true)},
      pictures_(options.pictures),
      is_real_time_(options.speedup == 1.0),
      seed_(options.seed.value_or(1)) {
  hub.add_sink(terminal_sink(options.log_level));
  auto const fleet_fits = join("MAVLink", {platform, &control, &parameters});
  // Their words are there without robots and survey drones, too: a script that waits for one checks.
  auto const robots_fit = join("robots", {robots});
  auto const survey_fits = join("survey drones", {survey});
  LAPWING_ASSERT(fleet_fits && robots_fit && survey_fits);  // no word of one is a word of the other
  control.set_on_latched([this](std::string const& reason) { host.halt_for_operator(reason); });
  host.set_bar([this] { return ground.authority.barred(); });
  bool const is_real_time = options.speedup == 1.0 && !options.seed && !options.begins_at;
  if (is_real_time)
    signing_time = std::make_unique<SigningTimeKeeper>(
        loop, [this] { return ground.signed_until(); }, options.signing.time_file, log.named("signing"));
  auto const plans = log.named("plans");
  for (auto const& note : options.plans.notes) plans.info(note);
  for (auto const& mistake : options.plans.mistakes) plans.warn(mistake.message);
}

base::Result<> Session::join(std::string const& name, Joined const& joined) {
  if (auto fits = platforms.add(name, joined.platform); !fits) return fits;
  if (joined.control) all_control.add(name, *joined.control);
  if (joined.parameters) all_parameters.add(name, *joined.parameters);
  return {};
}

base::Result<> Session::add_robots(std::vector<std::string> const& requests, geo::Wgs84 const& anchor) {
  if (requests.empty()) return {};
  auto const* known = live_map.site("default");
  auto made = make_robots(loop, requests, "default", known ? known->anchor() : anchor, seed_, cameras_, buildings, log);
  if (!made) return std::unexpected(made.error());
  all_control.add("robots", robot_control);
  for (auto& robot : *made) {
    if (!live_map.site(robot.spec.site)) {
      auto site = geo::Site::make(robot.spec.site, robot.anchor);
      if (!site) return std::unexpected(site.error());
      live_map.put_site(*std::move(site));
    }
    auto added = robots.add(std::move(robot.spec), std::move(robot.body));
    if (!added) return std::unexpected(added.error());
    if (!robot.eyes) continue;
    if (!looking) {
      auto program = LookingChild::program_beside_us("lapwing-vision", "look");
      looking = std::make_unique<LookingChild>(loop, looking_settings(std::move(program), is_real_time_), log);
    }
    auto eyes = robot.eyes(*looking);
    eyes.keep = [this](std::string jpeg) { return keep_picture(std::move(jpeg)); };
    if (!pictures_.empty())
      eyes.write_file = [this](std::string name, std::string jpeg) {
        return write_picture(std::move(name), std::move(jpeg));
      };
    robots.open_eyes(**added, std::move(eyes));
  }
  return {};
}

base::Result<> Session::open_old_parts(std::vector<std::string> const& requests) {
  for (auto const& text : requests) {
    auto const parts = parse_old_parts(text);
    if (!parts) return std::unexpected(parts.error());
    auto* const robot = robots.robot({parts->robot});
    if (!robot)
      return base::fail(base::ErrorKind::invalid_input,
                        fmt::format("--old-parts {}: there is no robot '{}'", text, parts->robot),
                        "name one with --robot; they are called robot1, robot2 and so on");
    auto link = link::open(loop, parts->url);
    if (!link) return std::unexpected(link.error());
    old_parts.push_back(std::make_unique<robot::TextPort>(
        robot::TextPort::Surroundings{
            .loop = loop, .robot = *robot, .control = all_control, .authority = ground.authority, .live_map = live_map},
        *std::move(link), log.named(parts->robot)));
  }
  if (!requests.empty())
    robots.set_communication(
        [this] { return is_an_operator_there() ? robot::code::none : robot::code::operator_away; });
  return {};
}

bool Session::is_an_operator_there() const {
  bool const is_viewed = map && map->viewers() > 0;
  return is_viewed || std::ranges::any_of(old_parts, [](auto const& port) { return port->has_listener(); });
}

base::Task<base::Result<std::string>> Session::keep_picture(std::string jpeg) {
  if (!station_map) co_return base::fail(base::ErrorKind::refused, "there is no map that is kept");
  auto keeping = station_map->store().keep(std::move(jpeg), "image/jpeg");
  co_return co_await std::move(keeping);
}

/// Beside the loop, since a disk may take its time and a robot drives on its readings.
base::Task<base::Result<std::string>> Session::write_picture(std::string name, std::string jpeg) {
  std::ranges::replace(name, ':', '-');
  auto path = pictures_ / name;
  auto const written = co_await loop.on_pool(&put_into_folder, path.string(), std::move(jpeg));
  if (!written) co_return std::unexpected(written.error());
  co_return path.string();
}

base::Result<> Session::open_survey(std::vector<SurveyLink> links) {
  if (links.empty()) return {};
  auto opened = SurveyDesk::open(loop, live_map, log.named("survey"), std::move(links));
  if (!opened) return std::unexpected(opened.error());
  survey.open(*std::move(opened));
  survey_control = std::make_unique<SurveyControl>(loop, *survey.desk(), emergency_action_, log.named("survey"));
  all_control.add("survey drones", *survey_control);
  return {};
}

base::Result<> Session::simulate(sim::WorldOptions options) {
  auto started = start_simulation(ground, std::move(options), log);
  if (!started) return std::unexpected(started.error());
  world = std::move(*started);
  return {};
}

base::Result<> Session::watch_car_park(std::filesystem::path const& world_file) {
  using base::ErrorKind;
  if (!world)
    return base::fail(ErrorKind::invalid_input, "a car park is shown to simulated vehicles, and there are none");
  std::error_code error;
  auto const file = std::filesystem::canonical(world_file, error);
  if (error) return base::fail(ErrorKind::not_found, fmt::format("{}: {}", world_file.string(), error.message()));
  auto program = LookingChild::program_beside_us("lapwing-perceive", "overlook");
  overlook =
      std::make_unique<LookingChild>(loop, looking_settings(std::move(program), is_real_time_), log.named("car park"));
  lot_watch =
      std::make_unique<LotWatch>(loop, live_map,
                                 LotWatch::Setup{.world = file,
                                                 .ask =
                                                     [this](LookFrame request) {
                                                       return overlook->ask([request = std::move(request)]() mutable {
                                                         return std::move(request);
                                                       });
                                                     },
                                                 .drones = [this] { return drones_in_the_air(*world); }},
                                 log.named("car park"));
  return {};
}

base::Result<> Session::open_links(std::vector<std::string> const& urls) {
  if (auto opened = ground.open(urls); !opened) return opened;
  if (record_folder_.empty()) return {};
  for (auto& [name, network] : ground.networks) {
    if (name.empty()) continue;  // `record` began it
    auto begun = Recording::begin(record_folder_, network, log.named("recording"));
    if (!begun) return std::unexpected(begun.error());
    log.info(fmt::format("recording network {} to {}", name, (*begun)->file().string()));
    network_recordings.push_back(std::move(*begun));
  }
  return {};
}

base::Result<> Session::forward(std::vector<Forward> programs) {
  std::map<std::string, std::vector<route::EndpointOptions>> endpoints;
  for (auto& program : programs) endpoints[program.network].push_back(std::move(program.endpoint));
  for (auto& [name, of_network] : endpoints) {
    auto const network = ground.network(name);
    if (!network) return std::unexpected(network.error());
    auto& router = forwarding.try_emplace(name, loop, route::Router::Options{}, log.named("forward")).first->second;
    // Packet by packet: each is looked at, held back or sent by itself, and counted so.
    router.add({.name = name.empty() ? "vehicles" : fmt::format("vehicles of {}", name), .coalesces = false},
               mavlink::as_link(**network));
    if (auto opened = router.open(std::move(of_network)); !opened) return opened;
  }
  return {};
}

base::Result<> Session::record(std::string const& folder) {
  record_folder_ = folder;
  auto begun = Recording::begin(folder, ground.connection, log.named("recording"));
  if (!begun) return std::unexpected(begun.error());
  recording = std::move(*begun);
  log.info(fmt::format("recording to {}", recording->file().string()));
  return {};
}

base::Result<> Session::open_store(MapContent const& content) {
  auto kept = StationMap::open(loop, live_map, content.store, log.named("map"));
  if (!kept) return std::unexpected(kept.error());
  station_map = *std::move(kept);
  if (content.home && live_map.sites().empty())
    if (auto site = geo::Site::make("default", *content.home)) live_map.put_site(*std::move(site));
  tracks = std::make_unique<TrackWriter>(loop, ground.registry, live_map);
  return {};
}

base::Result<> Session::open_map(WebAccess const& access, MapContent const& content, station::ScriptControl* script) {
  auto token = token_for(access);
  if (!token) return std::unexpected(token.error());
  station::Station::Options options;
  options.http.address = access.bind;
  options.http.port = access.port;
  options.http.token = *token;
  options.http.host_names = access.host_names;
  options.http.static_root = home_directory() / "web/dist";
  options.program_version = LAPWING_VERSION;
  options.site = {content.site_name, content.home, content.tiles};
  options.scripts = content.scripts;
  options.base_maps = content.base_maps;
  options.control = script ? nullptr : &all_control;
  options.alarms = &ground.fleet.alarms();
  options.parameters = script ? nullptr : &all_parameters;
  if (content.past) {
    options.store = content.past->store;
    options.looks_back = content.past->session;
  } else if (!station_map) {
    if (auto opened = open_store(content); !opened) return opened;
  }
  if (station_map) {
    options.store = &station_map->store();
    map_exports = std::make_unique<MapExports>(loop, *options.store, station_map->address());
    options.exporter = map_exports.get();
  }
  options.map = &live_map;
  options.survey = survey.desk();
  if (!robots.robots().empty()) {
    options.feeds.push_back(std::make_unique<RobotsFeed>(robots, live_map));
    options.modules = &robot_modules;
  }
  options.metrics = [this] { return metrics_of(ground.registry, ground.link_reports(), forwarding, loop.now()); };
  auto opened = station::Station::open(loop, ground.registry, script ? *script : host, hub, std::move(options));
  if (!opened) return std::unexpected(opened.error());
  map = std::move(*opened);
  robots.set_communication([this] { return is_an_operator_there() ? robot::code::none : robot::code::operator_away; });
  robots.set_map_keeping([this] { return !station_map || station_map->store().health().is_writing; });
  tell_where_the_map_is(access, map->port(), *token);
  if (!std::filesystem::exists(home_directory() / "web/dist/index.html")) {
    log.warn("the browser app is not built, so the map shows nothing: ./lapwing build builds it");
  }
  return {};
}

void Session::run_to_end(std::optional<base::Duration> timeout) {
  StopSignals const signals(loop, [this] { interrupt("an interrupt"); });
  auto const stall = host.halt_when_time_stands_still();
  loop.run_until_done(finish(timeout));
}

bool Session::serve(std::string const& by) {
  bool was_running = false;
  StopSignals const signals(loop, [&] {
    was_running = host.status().state == station::ScriptState::running;
    interrupt(by);
    loop.stop();
  });
  loop.run();
  auto const stall = host.halt_when_time_stands_still();
  loop.run_until_done(finish(std::nullopt));
  return was_running;
}

void Session::interrupt(std::string const& by) {
  is_interrupted_ = true;
  host.stop(by);
  interrupted_.notify_all();
}

base::Task<> Session::finish(std::optional<base::Duration> timeout) {
  base::Scope scope(loop);
  if (timeout) scope.spawn(host.halt_after(*timeout));
  scope.spawn(tell_while_interrupted());
  scope.spawn(tell_while_nobody_is_heard());
  co_await host.ended();
  bool const is_alone = is_nobody_heard();
  bool const is_done = host.outcome() && host.outcome()->kind == dolphin::Outcome::Kind::done;
  if (is_alone && !is_done) log.error(fmt::format("no vehicle was heard on {}", links_text()));
  robots.end_drives("the program ends");
  co_await platform.make_safe(on_stop_);
  co_await robots.settle();
  co_await survey.settle();
  if (!lot_watch) co_return;
  auto judging = lot_watch->judge();
  if (auto const score = co_await std::move(judging)) lot_score_ = *score;
}

bool Session::is_nobody_heard() const {
  return ground.registry.all().empty() && survey.vehicles().empty();
}

std::string Session::links_text() const {
  std::string text;
  for (auto const& link : ground.link_reports())
    text += fmt::format("{}{}{}", text.empty() ? "" : ", ", link.name,
                        link.last_error.empty() ? "" : fmt::format(" ({})", link.last_error));
  return text;
}

base::Task<> Session::tell_while_nobody_is_heard() {
  using namespace std::chrono_literals;
  auto const since = loop.now();
  for (base::Duration wait = 3s;; wait = 10s) {
    co_await loop.sleep(wait);
    if (!is_nobody_heard()) co_return;
    log.info(
        fmt::format("no vehicle heard yet for {:.0f} s on {}", base::to_seconds(loop.now() - since), links_text()));
  }
}

/// A vehicle that is out of reach cannot be stopped; whoever waits for it learns what else he can do.
base::Task<> Session::tell_while_interrupted() {
  using namespace std::chrono_literals;
  while (!is_interrupted_) co_await interrupted_.wait();
  for (base::Duration wait = 3s;; wait = 10s) {
    co_await loop.sleep(wait);
    if (auto const names = platform.unsettled(); !names.empty())
      log.warn(fmt::format("still waiting for {} to stop; Ctrl-C again ends at once: {} then what {} told last",
                           fmt::join(names, ", "), names.size() == 1 ? "it does" : "they do",
                           names.size() == 1 ? "it was" : "they were"));
    if (auto const names = robots.unsettled(); !names.empty())
      log.warn(
          fmt::format("still waiting for {} to be seen standing; Ctrl-C again ends at once: what hears nothing "
                      "is stopped by its own watchdog",
                      fmt::join(names, ", ")));
  }
}

void Session::note(tasks::TaskEvent const& event) {
  log.named("task").info(to_log_text(event));
  missions::Carrier carrier;
  if (auto const* vehicle = event.vehicle ? ground.registry.find(*event.vehicle) : nullptr)
    carrier = {.home = vehicle->motion.home.value, .autopilot = vehicle->autopilot, .family = vehicle->family};
  if (events_) events_->write(event, carrier);
}

}  // namespace lapwing::host
