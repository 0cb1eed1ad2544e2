#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "apps/verb.hpp"
#include "host/files/key_file.hpp"
#include "host/session/session.hpp"
#include "host/session/signals.hpp"
#include "host/simulation/simulation.hpp"
#include "host/simulation/world_place.hpp"
#include "link/url.hpp"
#include "sim/model/vehicle_spec.hpp"

namespace lapwing::apps {

namespace {

constexpr auto usual_home = "41.1780,-8.5980,90";
/// How far off a vehicle has its home, as ArduPilot had in the loop.
constexpr double usual_altitude_error_m = 0.09;

struct SimOptions {
  std::string vehicles = "copter:1";
  std::optional<std::string> home;
  std::string world;
  std::string out = "udpout://127.0.0.1:14550";
  double speedup = 1.0;
  double loss = 0.0;
  double delay_s = 0.0;
  double duplication = 0.0;
  double jitter_s = 0.0;
  std::string wind;
  std::uint64_t seed = 1;
  int first_id = 1;
  bool realistic_boot = false;
  std::optional<double> swap_batteries_s;
  std::optional<double> battery_mah;
  std::vector<std::string> parameters;
  std::string signing_key;
};

base::Result<sim::WorldOptions> world_options(SimOptions const& options) {
  sim::WorldOptions world;
  auto const vehicles = sim::parse_vehicles(options.vehicles);
  if (!vehicles) return std::unexpected(vehicles.error());
  auto home = host::parse_home(options.home.value_or(usual_home));
  if (!home) return std::unexpected(home.error());
  if (!options.world.empty()) {
    auto const place = host::world_place(options.world);
    if (!place) return std::unexpected(place.error());
    if (!options.home) home->place = *place;
  }
  auto const out = link::parse_url(options.out);
  if (!out) return std::unexpected(out.error());
  world.vehicles = *vehicles;
  world.home = home->place;
  world.heading_rad = home->heading_rad;
  world.altitude_error_m = usual_altitude_error_m;
  world.out = *out;
  world.seed = options.seed;
  world.first_system_id = options.first_id;
  world.impairment.loss = options.loss;
  world.impairment.delay = base::from_seconds(options.delay_s);
  world.impairment.duplication = options.duplication;
  world.impairment.jitter = base::from_seconds(options.jitter_s);
  if (auto const blows = host::set_wind(world, options.wind); !blows) return std::unexpected(blows.error());
  for (auto const& text : options.parameters) {
    auto const parameter = sim::parse_parameter(text);
    if (!parameter) return std::unexpected(parameter.error());
    world.parameters.push_back(*parameter);
  }
  auto const signing = host::read_signing(options.signing_key);
  if (!signing) return std::unexpected(signing.error());
  world.keys = signing->ring;
  if (options.swap_batteries_s) world.battery_swap_after = base::from_seconds(*options.swap_batteries_s);
  if (options.battery_mah) world.battery_capacity_mah = *options.battery_mah;
  world.boot = options.realistic_boot ? sim::BootStyle::realistic : sim::BootStyle::quick;
  return world;
}

int simulate(SimOptions const& options) {
  auto world_of = world_options(options);
  if (!world_of) return host::refuse(world_of.error());
  base::Loop loop(host::pace_for(options.speedup));
  base::LogHub hub;
  hub.add_sink(base::standard_error_sink(base::LogLevel::info));
  base::Logger const log(hub, "sim");
  sim::World world(loop, std::move(*world_of), log);
  if (auto started = world.start(); !started) return host::refuse(started.error());
  fmt::print(stderr, "{} simulated vehicle{} to {}; Ctrl-C ends\n", world.vehicles().size(),
             world.vehicles().size() == 1 ? "" : "s", options.out);
  host::StopSignals const signals(loop, [&loop] { loop.stop(); });
  loop.run();
  return host::exit_done;
}

}  // namespace

void add_sim(CLI::App& program, int& exit_code) {
  auto options = std::make_shared<SimOptions>();
  auto* verb = begin_verb(program, "sim");
  verb->add_option("--vehicles", options->vehicles, "What and how many: copter:2,plane:1,rover:1,boat:1,sub:1,px4:1")
      ->capture_default_str();
  verb->add_option(
      "--home", options->home,
      fmt::format("LAT,LON,ALT[,HEADING] in degrees and metres; default: the world's anchor, or {}", usual_home));
  verb->add_option("--world", options->world,
                   "A simulated car park's or building's file, at whose anchor the vehicles start");
  verb->add_option("--out", options->out, "Where the vehicles send")->capture_default_str();
  verb->add_option("--speedup", options->speedup, "1 real time, 10 ten times faster")
      ->check(CLI::Range(0.01, 1000.0))
      ->capture_default_str();
  verb->add_option("--loss", options->loss, "Share of packets lost, each way")->check(CLI::Range(0.0, 0.99));
  verb->add_option("--delay", options->delay_s, "Seconds that each packet is late, each way")
      ->check(CLI::Range(0.0, 60.0));
  verb->add_option("--duplicate", options->duplication, "Share of packets that arrive twice")
      ->check(CLI::Range(0.0, 1.0));
  verb->add_option("--jitter", options->jitter_s, "Up to so many seconds later still: packets overtake each other")
      ->check(CLI::Range(0.0, 60.0));
  verb->add_option("--wind", options->wind, host::wind_help);
  verb->add_option("--seed", options->seed, "The same seed gives the same noise and losses")
      ->check(not_negative())
      ->capture_default_str();
  verb->add_option("--first-id", options->first_id, "System id of the first vehicle")
      ->check(CLI::Range(1, 250))
      ->capture_default_str();
  verb->add_option("--param", options->parameters, "NAME=VALUE: a parameter of every vehicle; may come several times");
  verb->add_option("--signing-key", options->signing_key, host::signing_key_help);
  verb->add_option("--swap-batteries", options->swap_batteries_s, host::swap_help)->check(CLI::Range(1.0, 1e6));
  verb->add_option("--battery-mah", options->battery_mah,
                   "How much a full battery of each vehicle holds; 5000 otherwise")
      ->check(CLI::Range(100.0, 100'000.0));
  verb->add_flag("--realistic-boot", options->realistic_boot, "Take 41 s to start up, as ArduPilot does, instead of 3");
  verb->callback([options, &exit_code] { exit_code = simulate(*options); });
}

}  // namespace lapwing::apps
