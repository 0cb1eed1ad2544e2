#include <memory>

#include <fmt/format.h>

#include "apps/crew.hpp"
#include "apps/files.hpp"
#include "apps/session.hpp"
#include "apps/signals.hpp"
#include "apps/verb.hpp"
#include "sim/vehicle_spec.hpp"

namespace lapwing::apps {

namespace {

struct DemoOptions {
  bool headless = false;
  std::string script;
  std::string report;
  std::vector<std::string> forward;
  std::string record;
  std::string vehicles = "copter:2,rover:1";
  std::string on_stop = "loiter";
  WebArguments web;
  std::optional<double> speedup;
};

/// The map stays open after the script has ended, until Ctrl-C.
void keep_map(Session& session) {
  fmt::print(stderr, "the map stays open at {}; Ctrl-C ends\n", session.map->url());
  StopSignals const signals(session.loop, [&session] {
    session.host.stop("an interrupt");
    session.loop.stop();
  });
  session.loop.run();
  session.run_to_end(std::nullopt);
}

int demo(DemoOptions const& options) {
  constexpr auto example = "examples/survey.dolphin";
  auto const script = options.script.empty() ? std::string(example) : options.script;
  auto const source = read_script(options.script.empty() ? (home_directory() / example).string() : script);
  if (!source) return refuse(source.error());
  auto const on_stop = parse_on_stop(options.on_stop);
  if (!on_stop) return refuse(on_stop.error());
  auto const vehicles = sim::parse_vehicles(options.vehicles);
  if (!vehicles) return refuse(vehicles.error());

  auto const needs = needs_of_text(script, *source);
  sim::WorldOptions world;
  world.vehicles = *vehicles;
  world.home = needs.home.value_or(world.home);

  // Fast enough not to bore, slow enough to follow.
  constexpr double watchable = 4.0;
  Session session({.speedup = options.speedup.value_or(options.headless ? 0.0 : watchable),
                   .on_stop = *on_stop,
                   .payload = equipped(world, payload_for(needs))});
  if (!options.record.empty()) {
    if (auto begun = session.record(options.record); !begun) return refuse(begun.error());
  }
  auto programs = forward_to(options.forward);
  if (!programs) return refuse(programs.error());
  if (auto forwarded = session.forward(*std::move(programs)); !forwarded) return refuse(forwarded.error());
  if (!options.headless) {
    WebAccess access;
    apply(options.web, access);
    auto const opened = session.open_map(access, {.home = world.home, .scripts = home_directory() / "examples"});
    if (!opened) return refuse(opened.error());
  }
  if (auto simulated = session.simulate(std::move(world)); !simulated) return refuse(simulated.error());
  auto const started = session.host.start(script, *source);
  fmt::print(stderr, "{}", session.host.rendered_diagnostics());
  if (!started) return exit_usage;
  session.run_to_end(std::nullopt);
  auto const outcome = *session.host.outcome();
  if (!options.report.empty()) {
    if (auto written = write_file(options.report, to_json(session.report())); !written) return refuse(written.error());
  }
  if (session.map && outcome.kind != dolphin::Outcome::Kind::stopped) keep_map(session);
  return dolphin::exit_code(outcome);
}

}  // namespace

void add_demo(CLI::App& program, int& exit_code) {
  auto options = std::make_shared<DemoOptions>();
  auto* verb = program.add_subcommand("demo", "Simulated vehicles fly a script while you watch on the map");
  verb->add_flag("--headless", options->headless, "No map: run to the end as fast as the machine computes, then exit");
  verb->add_option("--script", options->script, "Another script than examples/survey.dolphin");
  verb->add_option("--vehicles", options->vehicles, "What and how many")->capture_default_str();
  verb->add_option("--report", options->report, "Write what happened to this file as JSON");
  verb->add_option("--forward", options->forward, forward_help);
  verb->add_option("--record", options->record, record_help);
  add_web_options(*verb, options->web);
  verb->add_option("--speedup", options->speedup, "1 real time; default 4 with the map, as fast as possible without")
      ->check(CLI::Range(0.0, 1000.0));
  verb->add_option("--on-stop", options->on_stop, "What a vehicle does when its task is stopped: loiter, rtl or land");
  verb->callback([options, &exit_code] { exit_code = demo(*options); });
}

}  // namespace lapwing::apps
