#include <memory>

#include <fmt/format.h>

#include "apps/files.hpp"
#include "apps/harness_run.hpp"
#include "apps/secret_file.hpp"
#include "apps/session.hpp"
#include "apps/simulation.hpp"
#include "apps/verb.hpp"
#include "sim/vehicle_spec.hpp"

namespace lapwing::apps {

namespace {

struct RunOptions {
  std::string script;
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
};

/// Simulated vehicles, or the links, or the default link.
base::Result<> connect(Session& session, RunOptions const& options, std::optional<mavlink::SigningKey> const& key) {
  if (options.simulated.empty()) {
    return session.open_links(options.links.empty() ? std::vector<std::string>{default_link} : options.links);
  }
  auto const vehicles = sim::parse_vehicles(options.simulated);
  if (!vehicles) return std::unexpected(vehicles.error());
  sim::WorldOptions world;
  world.vehicles = *vehicles;
  world.seed = options.seed.value_or(world.seed);
  world.signing_key = key;
  world.impairment.loss = options.loss;
  world.impairment.delay = base::from_seconds(options.delay_s);
  if (!options.home.empty()) {
    auto const home = parse_home(options.home);
    if (!home) return std::unexpected(home.error());
    world.home = home->place;
    world.heading_rad = home->heading_rad;
  }
  if (auto opened = session.open_links(options.links); !opened) return opened;
  return session.simulate(std::move(world));
}

int refuse(base::Error const& error) {
  print_error(error);
  return error.kind == base::ErrorKind::invalid_input || error.kind == base::ErrorKind::not_found ? exit_usage
                                                                                                  : exit_halted;
}

int run(RunOptions const& options) {
  auto const source = read_script(options.script);
  if (!source) return refuse(source.error());
  auto plans = load_plans(options.plans);
  if (!plans) return refuse(plans.error());
  if (options.platform == "test") {
    return run_on_harness(options.script, *source, options.events, options.seed, *std::move(plans));
  }
  auto const on_stop = parse_on_stop(options.on_stop);
  if (!on_stop) return refuse(on_stop.error());

  auto const key = read_signing_key(options.signing_key);
  if (!key) return refuse(key.error());
  Session session({.speedup = options.speedup.value_or(options.simulated.empty() ? 1.0 : 0.0),
                   .on_stop = *on_stop,
                   .plans = *std::move(plans),
                   .seed = options.seed,
                   .signing_key = *key});
  if (!options.record.empty()) {
    if (auto begun = session.record(options.record); !begun) return refuse(begun.error());
    if (auto kept = write_file(session.recording->beside(".dolphin"), *source); !kept) return refuse(kept.error());
  }
  if (auto connected = connect(session, options, *key); !connected) return refuse(connected.error());
  auto const started = session.host.start(options.script, *source);
  fmt::print(stderr, "{}", session.host.rendered_diagnostics());
  if (!started) return exit_usage;
  session.run_to_end(options.timeout_s ? std::optional(base::from_seconds(*options.timeout_s)) : std::nullopt);
  auto const outcome = *session.host.outcome();
  std::vector<std::string> reports;
  if (!options.report.empty()) reports.push_back(options.report);
  if (session.recording) reports.push_back(session.recording->beside(".json"));
  for (auto const& path : reports) {
    if (auto written = write_file(path, to_json(session.report())); !written) return refuse(written.error());
  }
  return dolphin::exit_code(outcome);
}

}  // namespace

void add_run(CLI::App& program, int& exit_code) {
  auto options = std::make_shared<RunOptions>();
  auto* verb = program.add_subcommand("run", "Run a script on vehicles");
  verb->add_option("script", options->script, "Dolphin script")->required();
  verb->add_option(
      "--link", options->links,
      "Where vehicles are, e.g. udpin://0.0.0.0:14550 (may be repeated); default " + std::string(default_link));
  verb->add_option("--sim", options->simulated, "Simulated vehicles instead, e.g. copter:2,rover:1");
  verb->add_option("--home", options->home,
                   "Where the simulated vehicles stand: LAT,LON,ALT[,HEADING] in degrees and metres");
  verb->add_option("--loss", options->loss, "With --sim: share of packets lost, each way")
      ->check(CLI::Range(0.0, 0.99));
  verb->add_option("--delay", options->delay_s, "With --sim: seconds that each packet is late, each way")
      ->check(CLI::Range(0.0, 60.0));
  verb->add_option("--speedup", options->speedup,
                   "1 real time, 10 ten times faster, 0 as fast as possible (default with --sim)")
      ->check(CLI::Range(0.0, 1000.0));
  verb->add_option("--timeout", options->timeout_s, "Halt the script after so many seconds")
      ->check(CLI::PositiveNumber);
  verb->add_option("--report", options->report, "Write what happened to this file as JSON");
  verb->add_option("--signing-key", options->signing_key, signing_key_help);
  verb->add_option("--record", options->record, record_help);
  verb->add_option("--on-stop", options->on_stop, "What a vehicle does when its task is stopped: loiter, rtl or land");
  verb->add_option("--plans", options->plans, plans_help);
  verb->add_option("--platform", options->platform, "mavlink, or test: the language's own test vehicles, no MAVLink")
      ->check(CLI::IsMember({"mavlink", "test"}));
  verb->add_option("--seed", options->seed,
                   "Of all chance: simulated vehicles and what the script draws by lot; sets a fixed calendar too, so "
                   "that a run repeats");
  verb->add_option("--events", options->events,
                   "With --platform test: write task events to this file as JSON lines (- for standard output)");
  verb->callback([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace lapwing::apps
