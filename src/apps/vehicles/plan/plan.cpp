#include <memory>
#include <sstream>

#include <fmt/format.h>

#include "apps/vehicles/plan/dry_run.hpp"
#include "apps/verb.hpp"
#include "base/files/replace_file.hpp"
#include "base/text/diagnostic.hpp"
#include "dolphin/machine/engine.hpp"
#include "dolphin/names/needs.hpp"
#include "dryrun/flight_json.hpp"
#include "dryrun/svg.hpp"
#include "dryrun/text.hpp"
#include "host/files/files.hpp"
#include "host/files/plans.hpp"
#include "host/plausibility/options.hpp"
#include "host/session/session.hpp"
#include "host/simulation/simulated_fleet.hpp"
#include "host/simulation/simulation.hpp"
#include "host/vocabulary.hpp"
#include "plan/files/plan_file.hpp"

namespace lapwing::apps {

namespace {

struct PlanOptions {
  std::string script;
  std::string vehicles;
  std::vector<std::string> robots;
  std::string home;
  std::string wind;
  std::string fence;
  std::string plans;
  std::string svg;
  std::string json;
  std::string answers;
  std::uint64_t seed = 1;
  double timeout_s = 7200.0;
  std::optional<double> swap_batteries_s;
  host::PlausibilityArguments plausibility;
};

/// Prints what is wrong with the script; nothing when it can be flown.
base::Result<dolphin::Needs> read_needs(std::string const& name, std::string const& text,
                                        plan::plausibility::Settings const& settings) {
  auto const source = std::make_shared<base::SourceFile const>(name, text);
  base::Diagnostics diagnostics(*source);
  auto const vocabulary = host::vocabulary(settings);
  auto const program = dolphin::load(source, vocabulary, diagnostics);
  fmt::print(stderr, "{}", base::render(diagnostics));
  if (!program) return base::fail(base::ErrorKind::invalid_input, fmt::format("{} does not check", name));
  return host::needs_of_text(name, text);
}

base::Result<DryRun::Options> dry_run_options(PlanOptions const& options, std::string const& text) {
  auto plausibility = host::plausibility_of(options.plausibility);
  if (!plausibility) return std::unexpected(plausibility.error());
  auto const needs = read_needs(options.script, text, *plausibility);
  if (!needs) return std::unexpected(needs.error());
  auto plans = host::load_plans(options.plans);
  if (!plans) return std::unexpected(plans.error());
  DryRun::Options result;
  result.plans = std::move(plans->library);
  result.timeout = base::from_seconds(options.timeout_s);
  result.payload = host::payload_for(*needs);
  result.plausibility = *std::move(plausibility);
  auto& world = result.world;
  world.seed = options.seed;
  if (options.swap_batteries_s) world.battery_swap_after = base::from_seconds(*options.swap_batteries_s);
  auto const vehicles = options.vehicles.empty()
                            ? host::simulated_fleet_for(*needs, base::SourceFile(options.script, text))
                            : sim::parse_vehicles(options.vehicles);
  if (!vehicles) return std::unexpected(vehicles.error());
  world.vehicles = *vehicles;
  if (auto placed = host::place(world, options.home, needs->home); !placed) return std::unexpected(placed.error());
  if (auto const blows = host::set_wind(world, options.wind); !blows) return std::unexpected(blows.error());
  if (!options.answers.empty()) {
    auto const answers = host::read_script(options.answers);
    if (!answers) return std::unexpected(answers.error());
    std::istringstream lines(*answers);
    for (std::string line; std::getline(lines, line);) result.answers.push_back(line);
  }
  return result;
}

base::Result<plan::Fence> read_fence_file(std::string const& path, geo::Wgs84 home) {
  if (path.empty()) return plan::Fence{};
  auto const text = host::read_script(path);
  if (!text) return std::unexpected(text.error());
  auto const read = plan::read_plan(path, *text);
  if (!read) return std::unexpected(read.error());
  auto fence = plan::level(read->plan.fence, home);
  if (!fence) fence.error().message = fmt::format("{}: {}", path, fence.error().message);
  return fence;
}

base::Result<> write_files(PlanOptions const& options, dryrun::FlightRecord const& record,
                           dryrun::Analysis const& analysis, plan::Fence const& fence) {
  if (!options.svg.empty()) {
    if (auto written = base::replace_file(options.svg, dryrun::to_svg(record, analysis, fence)); !written)
      return written;
  }
  if (options.json.empty()) return {};
  return base::replace_file(options.json, dryrun::to_json(record, analysis, fence));
}

int plan_script(PlanOptions const& options) {
  auto const text = host::read_script(options.script);
  if (!text) return host::refuse(text.error());
  auto const dry_run_with = dry_run_options(options, *text);
  if (!dry_run_with) return host::refuse(dry_run_with.error());
  auto const fence = read_fence_file(options.fence, dry_run_with->world.home);
  if (!fence) return host::refuse(fence.error());

  DryRun dry_run(*dry_run_with);
  if (auto added = dry_run.add_robots(options.robots); !added) return host::refuse(added.error());
  if (auto on = dry_run.power_on(); !on) return host::refuse(on.error());
  if (auto const flown = dry_run.fly(options.script, *text); !flown) return host::refuse(flown.error().error);
  auto const record = dry_run.record();
  auto const analysis = dryrun::analyse(record, *fence);
  auto const crew = host::to_text(dry_run_with->world.vehicles);
  if (options.vehicles.empty() && !crew.empty()) fmt::print("--vehicles {}: what the script picks\n", crew);
  fmt::print("{}", dryrun::to_text(record, analysis, *fence));
  if (auto written = write_files(options, record, analysis, *fence); !written) return host::refuse(written.error());
  auto const code = dolphin::exit_code(dry_run.outcome());
  return code == host::exit_done && !analysis.breaches.empty() ? host::exit_failed : code;
}

}  // namespace

void add_plan(CLI::App& program, int& exit_code) {
  auto options = std::make_shared<PlanOptions>();
  auto* verb = begin_verb(program, "plan");
  verb->add_option("script", options->script, "Dolphin script")->required();
  verb->add_option("--vehicles", options->vehicles,
                   "What and how many, e.g. copter:2,rover:1; default: what the script picks");
  verb->add_option("--robot", options->robots,
                   "Robots in a simulated building: sim:BUILDING.toml[:COUNT] (may be repeated)")
      ->allow_extra_args(false);
  verb->add_option("--home", options->home,
                   "Where they stand: LAT,LON,ALT[,HEADING] in degrees and metres; default: the script's first home");
  verb->add_option("--fence", options->fence,
                   "File of the areas to stay in or out of (GeoJSON, .plan, KML); a breach exits with 1");
  verb->add_option("--plans", options->plans, host::plans_help);
  verb->add_option("--wind", options->wind, host::wind_help);
  host::add_plausibility_options(*verb, options->plausibility);
  verb->add_option("--svg", options->svg, "Draw the flight, map and time lines, to this file");
  verb->add_option("--json", options->json, "Write everything, tracks included, to this file");
  verb->add_option("--swap-batteries", options->swap_batteries_s, host::swap_help)->check(CLI::Range(1.0, 1e6));
  verb->add_option("--answers", options->answers, "File with the answers to the script's questions, one a line");
  verb->add_option("--seed", options->seed, "Of everything that is left to chance")
      ->check(not_negative())
      ->capture_default_str();
  verb->add_option("--timeout", options->timeout_s, "Cut the flight off after so many simulated seconds")
      ->check(CLI::Range(1.0, 1e6))
      ->capture_default_str();
  verb->callback([options, &exit_code] { exit_code = plan_script(*options); });
}

}  // namespace lapwing::apps
