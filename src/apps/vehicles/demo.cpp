#include <memory>

#include <fmt/format.h>

#include "apps/verb.hpp"
#include "base/files/replace_file.hpp"
#include "host/files/files.hpp"
#include "host/session/session.hpp"
#include "host/simulation/simulated_fleet.hpp"
#include "sim/model/vehicle_spec.hpp"

namespace lapwing::apps {

namespace {

struct DemoOptions {
  bool headless = false;
  std::string script;
  std::string report;
  std::vector<std::string> forward;
  std::string record;
  std::string vehicles = "copter:2,rover:1";
  std::vector<std::string> robots;
  std::string car_park;
  std::string on_stop = "loiter";
  host::WebArguments web;
  std::optional<double> speedup;
};

/// The map stays open after the script has ended, until Ctrl-C.
void keep_map(host::Session& session) {
  fmt::print(stderr, "the map stays open at {}; Ctrl-C ends\n", session.map->url());
  session.serve("an interrupt");
}

base::Result<> open_map(host::Session& session, host::WebArguments const& web, geo::Wgs84 const& home) {
  host::WebAccess access;
  host::apply(web, access);
  auto ground = host::base_map_of(host::home_directory() / "examples/ground/car-park.geojson");
  if (!ground) return std::unexpected(ground.error());
  ground->name = "Car park and office";
  return session.open_map(access, {.home = home,
                                   .base_maps = {*std::move(ground)},
                                   .store = {.place = host::StoreSettings::Place::temporary},
                                   .scripts = host::home_directory() / "examples"});
}

/// What the session has beside its simulated vehicles: a recording, other programs that listen, robots and the map.
base::Result<> furnish(host::Session& session, DemoOptions const& options, geo::Wgs84 const& home) {
  if (!options.record.empty())
    if (auto begun = session.record(options.record); !begun) return begun;
  auto programs = host::forward_to(options.forward);
  if (!programs) return std::unexpected(programs.error());
  if (auto forwarded = session.forward(*std::move(programs)); !forwarded) return forwarded;
  // The usual script has a robot in it.
  auto robots = options.robots;
  if (robots.empty() && options.script.empty())
    robots = {"sim:" + (host::home_directory() / "examples/buildings/office.toml").string()};
  if (auto added = session.add_robots(robots, home); !added) return added;
  return options.headless ? base::Result<>() : open_map(session, options.web, home);
}

/// The usual script flies over one.
std::filesystem::path car_park_of(DemoOptions const& options) {
  if (!options.car_park.empty() || !options.script.empty()) return options.car_park;
  return host::home_directory() / "examples/car-park/world.toml";
}

int demo(DemoOptions const& options) {
  constexpr auto example = "examples/demo.dolphin";
  auto const script = options.script.empty() ? std::string(example) : options.script;
  auto const source = host::read_script(options.script.empty() ? (host::home_directory() / example).string() : script);
  if (!source) return host::refuse(source.error());
  auto const on_stop = host::parse_on_stop(options.on_stop);
  if (!on_stop) return host::refuse(on_stop.error());
  auto const vehicles = sim::parse_vehicles(options.vehicles);
  if (!vehicles) return host::refuse(vehicles.error());

  auto const needs = host::needs_of_text(script, *source);
  sim::WorldOptions world;
  world.vehicles = *vehicles;
  world.home = needs.home.value_or(world.home);

  // Fast enough not to bore, slow enough to follow.
  constexpr double watchable = 4.0;
  host::Session session({.speedup = options.speedup.value_or(options.headless ? 0.0 : watchable),
                         .on_stop = *on_stop,
                         .payload = host::equipped(world, host::payload_for(needs))});
  if (auto furnished = furnish(session, options, world.home); !furnished) return host::refuse(furnished.error());
  if (auto simulated = session.simulate(std::move(world)); !simulated) return host::refuse(simulated.error());
  if (auto const car_park = car_park_of(options); !car_park.empty())
    if (auto watched = session.watch_car_park(car_park); !watched) return host::refuse(watched.error());
  auto const started = session.host.start(script, *source);
  fmt::print(stderr, "{}", session.host.rendered_diagnostics());
  if (!started) return host::exit_usage;
  session.run_to_end(std::nullopt);
  auto const outcome = *session.host.outcome();
  if (!options.report.empty()) {
    if (auto written = base::replace_file(options.report, host::to_json(session.report())); !written)
      return host::refuse(written.error());
  }
  if (session.map && outcome.kind != dolphin::Outcome::Kind::stopped) keep_map(session);
  return dolphin::exit_code(outcome);
}

}  // namespace

void add_demo(CLI::App& program, int& exit_code) {
  auto options = std::make_shared<DemoOptions>();
  auto* verb = begin_verb(program, "demo");
  verb->add_flag("--headless", options->headless, "No map: run to the end as fast as the machine computes, then exit");
  verb->add_option("--script", options->script, "Another script than examples/demo.dolphin");
  verb->add_option("--vehicles", options->vehicles, "What and how many")->capture_default_str();
  verb->add_option("--robot", options->robots,
                   std::string(host::robot_help) + "; default, without --script: the office beside the car park")
      ->allow_extra_args(false);
  verb->add_option("--car-park", options->car_park,
                   std::string(host::car_park_help) + "; default, without --script: the demo's");
  verb->add_option("--report", options->report, "Write what happened to this file as JSON");
  verb->add_option("--forward", options->forward, host::forward_help);
  verb->add_option("--record", options->record, host::record_help);
  host::add_web_options(*verb, options->web);
  verb->add_option("--speedup", options->speedup, "1 real time; default 4 with the map, as fast as possible without")
      ->check(CLI::Range(0.0, 1000.0));
  verb->add_option("--on-stop", options->on_stop, "What a vehicle does when its task is stopped: loiter, rtl or land");
  verb->callback([options, &exit_code] { exit_code = demo(*options); });
}

}  // namespace lapwing::apps
