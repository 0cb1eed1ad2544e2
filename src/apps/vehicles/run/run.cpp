#include <algorithm>
#include <array>
#include <memory>

#include <fmt/format.h>

#include "apps/vehicles/run/harness_run.hpp"
#include "apps/verb.hpp"
#include "base/files/replace_file.hpp"
#include "base/text/diagnostic.hpp"
#include "host/files/files.hpp"
#include "host/files/key_file.hpp"
#include "host/links/equipment.hpp"
#include "host/plausibility/options.hpp"
#include "host/robots/old_parts.hpp"
#include "host/robots/robot_cameras.hpp"
#include "host/session/session.hpp"
#include "host/simulation/simulated_fleet.hpp"
#include "host/simulation/simulation.hpp"
#include "host/vocabulary.hpp"
#include "sim/model/vehicle_spec.hpp"

namespace lapwing::apps {

namespace {

struct RunOptions {
  std::vector<std::string> scripts;
  std::vector<std::string> links;
  std::string simulated;
  std::string home;
  double loss = 0.0;
  double delay_s = 0.0;
  std::optional<double> speedup;
  std::optional<double> timeout_s;
  std::string report;
  std::string record;
  std::string on_stop = "loiter";
  std::string platform = "mavlink";
  std::string events;
  std::optional<std::uint64_t> seed;
  std::string plans;
  std::string signing_key;
  std::vector<std::string> payload;
  std::vector<std::string> forward;
  std::vector<std::string> robots;
  std::vector<std::string> old_parts;
  std::vector<std::string> survey;
  std::string robot_cameras;
  std::string pictures = "pictures";
  std::string car_park;
  std::optional<double> swap_batteries_s;
  host::PlausibilityArguments plausibility;

  [[nodiscard]] std::optional<base::Duration> timeout() const {
    return timeout_s ? std::optional(base::from_seconds(*timeout_s)) : std::nullopt;
  }
};

/// The simulated vehicles, where the script is at home unless the user says otherwise.
base::Result<sim::WorldOptions> world_for(RunOptions const& options, dolphin::Needs const& needs) {
  sim::WorldOptions world;
  auto const vehicles = sim::parse_vehicles(options.simulated);
  if (!vehicles) return std::unexpected(vehicles.error());
  world.vehicles = *vehicles;
  world.seed = options.seed.value_or(world.seed);
  world.impairment.loss = options.loss;
  world.impairment.delay = base::from_seconds(options.delay_s);
  if (options.swap_batteries_s) world.battery_swap_after = base::from_seconds(*options.swap_batteries_s);
  if (auto placed = host::place(world, options.home, needs.home); !placed) return std::unexpected(placed.error());
  return world;
}

/// What the user says; simulated vehicles carry what the script asks for as well.
base::Result<host::Equipment> equipment_for(RunOptions const& options, std::optional<sim::WorldOptions> const& world,
                                            dolphin::Needs const& needs) {
  host::Equipment equipment;
  if (world) equipment = host::equipped(*world, host::payload_for(needs));
  for (auto const& text : options.payload) {
    if (auto added = host::add_payload(text, equipment); !added) return std::unexpected(added.error());
  }
  return equipment;
}

/// Simulated vehicles, or the links, or the default link; and who rides along.
base::Result<> connect(host::Session& session, RunOptions const& options, std::optional<sim::WorldOptions> world) {
  auto programs = host::forward_to(options.forward);
  if (!programs) return std::unexpected(programs.error());
  // Who names robots or survey drones alone wants no vehicles on the default link.
  bool const wants_default = options.links.empty() && !world && options.robots.empty() && options.survey.empty();
  auto const links = wants_default ? std::vector<std::string>{host::default_link} : options.links;
  if (auto opened = session.open_links(links); !opened) return opened;
  if (auto forwarded = session.forward(*std::move(programs)); !forwarded) return forwarded;
  if (world)
    if (auto simulated = session.simulate(*std::move(world)); !simulated) return simulated;
  return options.car_park.empty() ? base::Result<>{} : session.watch_car_park(options.car_park);
}

/// To the user's file and beside the recording, if there is one.
base::Result<> write_reports(host::Session const& session, RunOptions const& options) {
  std::vector<std::string> paths;
  if (!options.report.empty()) paths.push_back(options.report);
  if (session.recording) paths.push_back(session.recording->beside(".json"));
  for (auto const& path : paths) {
    if (auto written = base::replace_file(path, host::to_json(session.report())); !written) return written;
  }
  return {};
}

int run_script(host::Session& session, RunOptions const& options, host::ScriptText const& script) {
  if (session.recording) {
    if (auto kept = base::replace_file(session.recording->beside(".dolphin"), script.text); !kept)
      return host::refuse(kept.error());
  }
  auto const started = session.host.start(script.name, script.text);
  fmt::print(stderr, "{}", session.host.rendered_diagnostics());
  if (!started) return host::exit_usage;
  session.run_to_end(options.timeout());
  if (auto written = write_reports(session, options); !written) return host::refuse(written.error());
  return dolphin::exit_code(*session.host.outcome());
}

/// So that nothing real is outrun by its clock.
bool is_all_simulated(RunOptions const& options) {
  auto const is_simulated = [](std::string const& robot) { return robot.starts_with("sim:"); };
  bool const is_linked =
      !options.survey.empty() || (options.simulated.empty() && (options.robots.empty() || !options.links.empty()));
  return !is_linked && options.old_parts.empty() && std::ranges::all_of(options.robots, is_simulated);
}

base::Result<> open_vehicles(host::Session& session, RunOptions const& options, dolphin::Needs const& needs,
                             std::optional<sim::WorldOptions> world) {
  auto const anchor = world ? world->home : needs.home.value_or(sim::WorldOptions{}.home);
  if (auto added = session.add_robots(options.robots, anchor); !added) return added;
  if (auto opened = session.open_old_parts(options.old_parts); !opened) return opened;
  std::vector<host::SurveyLink> survey;
  if (auto named = host::add_survey_links(options.survey, survey); !named) return named;
  if (auto opened = session.open_survey(std::move(survey)); !opened) return opened;
  return connect(session, options, std::move(world));
}

int run_on_vehicles(RunOptions const& options, std::vector<host::ScriptText> const& scripts, host::LoadedPlans plans,
                    host::EventFile const& events) {
  auto const on_stop = host::parse_on_stop(options.on_stop);
  if (!on_stop) return host::refuse(on_stop.error());
  auto const needs = host::needs_of_text(scripts.front().name, scripts.front().text);
  std::optional<sim::WorldOptions> world;
  if (!options.simulated.empty()) {
    auto made = world_for(options, needs);
    if (!made) return host::refuse(made.error());
    world = *std::move(made);
  }
  auto equipment = equipment_for(options, world, needs);
  if (!equipment) return host::refuse(equipment.error());

  auto plausibility = host::plausibility_of(options.plausibility);
  if (!plausibility) return host::refuse(plausibility.error());
  auto const signing = host::read_signing(options.signing_key);
  if (!signing) return host::refuse(signing.error());
  if (world) world->keys = signing->ring;
  auto cameras = host::load_robot_cameras(options.robot_cameras);
  if (!cameras) return host::refuse(cameras.error());
  host::Session session({.speedup = options.speedup.value_or(is_all_simulated(options) ? 0.0 : 1.0),
                         .on_stop = *on_stop,
                         .plans = std::move(plans),
                         .payload = *std::move(equipment),
                         .plausibility = *std::move(plausibility),
                         .events = &events,
                         .seed = options.seed,
                         .signing = *signing,
                         .robot_cameras = *std::move(cameras),
                         .pictures = options.pictures});
  if (!options.record.empty()) {
    if (auto begun = session.record(options.record); !begun) return host::refuse(begun.error());
  }
  if (auto opened = open_vehicles(session, options, needs, std::move(world)); !opened)
    return host::refuse(opened.error());
  int code = host::exit_done;
  for (auto script = scripts.begin(); script != scripts.end() && code == host::exit_done; ++script)
    code = run_script(session, options, *script);
  session.give_back_rates();
  return code;
}

/// Before the first script moves anything, those after it are looked at too. Prints what is wrong with them.
bool rest_checks(std::vector<host::ScriptText> const& scripts) {
  auto const vocabulary = host::vocabulary();
  bool is_good = true;
  for (std::size_t i = 1; i < scripts.size(); ++i) {
    auto const source = std::make_shared<base::SourceFile const>(scripts[i].name, scripts[i].text);
    base::Diagnostics diagnostics(*source);
    if (dolphin::load(source, vocabulary, diagnostics)) continue;
    fmt::print(stderr, "{}", base::render(diagnostics));
    is_good = false;
  }
  return is_good;
}

/// What means nothing to the test platform, and so is a mistake beside it.
base::Result<> check_combination(RunOptions const& options) {
  if (options.platform != "test") return {};
  std::array<std::pair<std::string_view, bool>, 14> const given{{{"--robot", !options.robots.empty()},
                                                                 {"--old-parts", !options.old_parts.empty()},
                                                                 {"--car-park", !options.car_park.empty()},
                                                                 {"--survey", !options.survey.empty()},
                                                                 {"--link", !options.links.empty()},
                                                                 {"--sim", !options.simulated.empty()},
                                                                 {"--home", !options.home.empty()},
                                                                 {"--forward", !options.forward.empty()},
                                                                 {"--loss", options.loss > 0.0},
                                                                 {"--delay", options.delay_s > 0.0},
                                                                 {"--payload", !options.payload.empty()},
                                                                 {"--report", !options.report.empty()},
                                                                 {"--signing-key", !options.signing_key.empty()},
                                                                 {"--record", !options.record.empty()}}};
  auto const found = std::ranges::find(given, true, &std::pair<std::string_view, bool>::second);
  if (found == given.end()) return {};
  return base::fail(base::ErrorKind::invalid_input, fmt::format("{} does not go with --platform test", found->first),
                    "its vehicles are a1 a2 u1 u2, without links");
}

int run(RunOptions const& options) {
  if (auto fits = check_combination(options); !fits) return host::refuse(fits.error());
  auto const scripts = host::read_scripts(options.scripts);
  if (!scripts) return host::refuse(scripts.error());
  auto plans = host::load_plans(options.plans);
  if (!plans) return host::refuse(plans.error());
  auto events = host::EventFile::open(options.events);
  if (!events) {
    host::print_error(events.error());
    return host::exit_usage;
  }
  if (!rest_checks(*scripts)) return host::exit_usage;
  if (options.platform != "test") return run_on_vehicles(options, *scripts, *std::move(plans), *events);
  return run_on_harness(
      *scripts,
      {.events = *std::move(events), .seed = options.seed, .timeout = options.timeout(), .plans = *std::move(plans)});
}

void add_vehicle_options(CLI::App& verb, RunOptions& options) {
  verb.add_option("--link", options.links,
                  "Where vehicles are, e.g. udpin://0.0.0.0:14550 (may be repeated); default " +
                      std::string(host::default_link))
      ->allow_extra_args(false);
  verb.add_option("--forward", options.forward, host::forward_help)->allow_extra_args(false);
  verb.add_option("--sim", options.simulated, "Simulated vehicles instead, e.g. copter:2,rover:1");
  verb.add_option("--robot", options.robots, host::robot_help)->allow_extra_args(false);
  verb.add_option("--robot-cameras", options.robot_cameras, host::robot_cameras_help);
  verb.add_option("--pictures", options.pictures, "Folder for what robots photograph")->capture_default_str();
  verb.add_option("--old-parts", options.old_parts, host::old_parts_help)->allow_extra_args(false);
  verb.add_option("--car-park", options.car_park, host::car_park_help);
  verb.add_option("--survey", options.survey,
                  "A survey drone's operator link (may be repeated): HOST[:PORT]; those with a token or TLS are for "
                  "scripts of a station")
      ->allow_extra_args(false);
  verb.add_option("--home", options.home,
                  "Where the simulated vehicles stand: LAT,LON,ALT[,HEADING] in degrees and metres; default: the "
                  "script's first home");
  verb.add_option("--loss", options.loss, "With --sim: share of packets lost, each way")->check(CLI::Range(0.0, 0.99));
  verb.add_option("--delay", options.delay_s, "With --sim: seconds that each packet is late, each way")
      ->check(CLI::Range(0.0, 60.0));
  verb.add_option("--swap-batteries", options.swap_batteries_s, host::swap_help)->check(CLI::Range(1.0, 1e6));
  verb.add_option("--payload", options.payload,
                  std::string(host::payload_help) + "; simulated ones carry what the script asks for too")
      ->allow_extra_args(false);
  host::add_plausibility_options(verb, options.plausibility);
  verb.add_option("--on-stop", options.on_stop, "What a vehicle does when its task is stopped: loiter, rtl or land");
  verb.add_option("--platform", options.platform, "mavlink, or test: the language's own test vehicles, no MAVLink")
      ->check(CLI::IsMember({"mavlink", "test"}));
}

}  // namespace

void add_run(CLI::App& program, int& exit_code) {
  auto options = std::make_shared<RunOptions>();
  auto* verb = begin_verb(program, "run");
  verb->add_option("script", options->scripts, "Dolphin script; of several each begins when the one before is done")
      ->required();
  add_vehicle_options(*verb, *options);
  verb->add_option("--speedup", options->speedup,
                   "1 real time, 10 ten times faster, 0 as fast as possible (default with --sim)")
      ->check(CLI::Range(0.0, 1000.0));
  verb->add_option("--timeout", options->timeout_s, "Halt the script after so many seconds")
      ->check(CLI::Range(1e-3, 1e9));
  verb->add_option("--report", options->report, "Write what happened to this file as JSON");
  verb->add_option("--signing-key", options->signing_key, host::signing_key_help);
  verb->add_option("--record", options->record, host::record_help);
  verb->add_option("--plans", options->plans, host::plans_help);
  verb->add_option("--seed", options->seed,
                   "Of all chance: simulated vehicles and what the script draws by lot; sets a fixed calendar too, so "
                   "that a run repeats")
      ->check(not_negative());
  verb->add_option("--events", options->events,
                   "Write what happens to tasks to this file as JSON lines (- for standard output)");
  verb->callback([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace lapwing::apps
