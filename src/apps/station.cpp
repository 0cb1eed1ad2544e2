#include <algorithm>
#include <memory>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "apps/config_file.hpp"
#include "apps/key_file.hpp"
#include "apps/plausibility/options.hpp"
#include "apps/session.hpp"
#include "apps/signals.hpp"
#include "apps/station_config.hpp"
#include "apps/verb.hpp"

namespace lapwing::apps {

namespace {

/// What the command line says; it goes before the file.
struct StationArguments {
  std::string config;
  std::vector<std::string> links;
  std::vector<std::string> payload;
  std::vector<std::string> forward;
  std::string plans;
  std::optional<std::string> on_stop;
  std::optional<std::string> emergency_stop;
  std::optional<std::string> scripts;
  std::optional<std::string> record;
  std::optional<std::string> signing_key;
  std::optional<std::string> tiles;
  PlausibilityArguments plausibility;
  WebArguments web;
};

base::Result<StationConfig> settings_of(StationArguments const& arguments) {
  base::Result<StationConfig> config =
      arguments.config.empty() ? StationConfig{}
                               : load_config(arguments.config, read_station_config, "docs/reference/station-config.md");
  if (!config) return config;
  if (!arguments.links.empty()) config->links = arguments.links;
  if (config->links.empty()) config->links = {default_link};
  for (auto const& text : arguments.payload) {
    if (auto added = add_payload(text, config->payload); !added) return std::unexpected(added.error());
  }
  if (arguments.on_stop) {
    auto const on_stop = parse_on_stop(*arguments.on_stop);
    if (!on_stop) return std::unexpected(on_stop.error());
    config->on_stop = *on_stop;
  }
  if (arguments.emergency_stop) {
    auto const action = parse_emergency_stop(*arguments.emergency_stop);
    if (!action) return std::unexpected(action.error());
    config->emergency_action = *action;
  }
  auto plausibility = plausibility_of(arguments.plausibility, config->plausibility);
  if (!plausibility) return std::unexpected(plausibility.error());
  config->plausibility = *std::move(plausibility);
  if (arguments.tiles) {
    if (auto checked = check_tiles(*arguments.tiles); !checked) return std::unexpected(checked.error());
    config->map.tiles = *arguments.tiles;
  }
  if (!arguments.forward.empty()) {
    auto forward = forward_to(arguments.forward);
    if (!forward) return std::unexpected(forward.error());
    config->forward = *std::move(forward);
  }
  if (arguments.scripts) config->map.scripts = *arguments.scripts;
  if (arguments.signing_key) config->signing_key = *arguments.signing_key;
  if (arguments.record) config->record = *arguments.record;
  apply(arguments.web, config->web);
  return config;
}

int serve(StationArguments const& arguments) {
  auto const config = settings_of(arguments);
  if (!config) return refuse(config.error());
  auto plans = load_plans(arguments.plans);
  if (!plans) return refuse(plans.error());
  auto const signing = read_signing(config->signing_key);
  if (!signing) return refuse(signing.error());
  Session session({.on_stop = config->on_stop,
                   .emergency_action = config->emergency_action,
                   .battery_limits = config->battery_limits,
                   .plans = *std::move(plans),
                   .payload = config->payload,
                   .plausibility = config->plausibility,
                   .signing = *signing});
  if (!config->record.empty()) {
    if (auto begun = session.record(config->record); !begun) return refuse(begun.error());
  }
  if (auto opened = session.open_links(config->links); !opened) return refuse(opened.error());
  if (auto opened = session.forward(config->forward); !opened) return refuse(opened.error());
  if (auto opened = session.open_map(config->web, config->map); !opened) return refuse(opened.error());
  fmt::print(stderr, "listening for vehicles on {}; Ctrl-C ends\n", fmt::join(config->links, ", "));
  {
    StopSignals const signals(session.loop, [&session] { session.loop.stop(); });
    session.loop.run();
  }
  // Vehicles that fly a script of ours are put into their stop mode before the process goes.
  bool const was_running = session.host.status().state == station::ScriptState::running;
  session.host.stop("the end of the station");
  session.run_to_end(std::nullopt);
  session.give_back_rates();
  return was_running ? exit_interrupted : exit_done;
}

}  // namespace

void add_station(CLI::App& program, int& exit_code) {
  auto arguments = std::make_shared<StationArguments>();
  auto* verb = program.add_subcommand("station", "Ground station with the map; scripts start from the browser");
  verb->add_option("--config", arguments->config, "TOML file with the settings; options given here go before it");
  verb->add_option("--link", arguments->links,
                   "Where vehicles are (may be repeated); default " + std::string(default_link));
  verb->add_option("--forward", arguments->forward, forward_help);
  verb->add_option("--payload", arguments->payload, payload_help);
  add_web_options(*verb, arguments->web);
  verb->add_option("--scripts", arguments->scripts, "Folder whose scripts the map offers")
      ->check(CLI::ExistingDirectory);
  verb->add_option("--signing-key", arguments->signing_key, signing_key_help);
  verb->add_option("--record", arguments->record, record_help);
  verb->add_option("--plans", arguments->plans, plans_help);
  verb->add_option("--tiles", arguments->tiles, "Base map for the browsers: https://tiles.example/{z}/{x}/{y}.png");
  verb->add_option("--on-stop", arguments->on_stop,
                   "What a vehicle does when its task is stopped: loiter (default), rtl or land");
  add_plausibility_options(*verb, arguments->plausibility);
  verb->add_option("--emergency-stop", arguments->emergency_stop,
                   "What the emergency stop does: hold (default), land, rtl or terminate");
  verb->callback([arguments, &exit_code] { exit_code = serve(*arguments); });
}

}  // namespace lapwing::apps
