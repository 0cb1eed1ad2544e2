#include <algorithm>
#include <memory>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "apps/verb.hpp"
#include "host/files/config_file.hpp"
#include "host/files/key_file.hpp"
#include "host/plausibility/options.hpp"
#include "host/robots/old_parts.hpp"
#include "host/robots/robot_cameras.hpp"
#include "host/robots/robot_spec.hpp"
#include "host/session/session.hpp"
#include "host/station/station_config.hpp"
#include "sim/world/world.hpp"

namespace lapwing::apps {

namespace {

/// What the command line says; it goes before the file.
struct StationArguments {
  std::string config;
  std::vector<std::string> links;
  std::vector<std::string> robots;
  std::optional<std::string> robot_cameras;
  std::vector<std::string> old_parts;
  std::vector<std::string> survey;
  std::vector<std::string> payload;
  std::vector<std::string> forward;
  std::string plans;
  std::optional<std::string> on_stop;
  std::optional<std::string> emergency_stop;
  std::optional<std::string> scripts;
  std::optional<std::string> record;
  std::optional<std::string> signing_key;
  std::optional<std::string> tiles;
  std::optional<std::string> store;
  host::PlausibilityArguments plausibility;
  host::WebArguments web;
};

base::Result<> set_map(StationArguments const& arguments, host::MapContent& map) {
  if (arguments.tiles) {
    if (auto checked = host::check_tiles(*arguments.tiles); !checked) return std::unexpected(checked.error());
    map.tiles = *arguments.tiles;
  }
  if (arguments.store) {
    map.store.place = host::StoreSettings::Place::named;
    map.store.address = *arguments.store;
  }
  if (arguments.scripts) map.scripts = *arguments.scripts;
  return {};
}

/// What holds vehicles back.
base::Result<> set_safety(StationArguments const& arguments, host::StationConfig& config) {
  if (arguments.on_stop) {
    auto const on_stop = host::parse_on_stop(*arguments.on_stop);
    if (!on_stop) return std::unexpected(on_stop.error());
    config.on_stop = *on_stop;
  }
  if (arguments.emergency_stop) {
    auto const action = host::parse_emergency_stop(*arguments.emergency_stop);
    if (!action) return std::unexpected(action.error());
    config.emergency_action = *action;
  }
  auto plausibility = host::plausibility_of(arguments.plausibility, config.plausibility);
  if (!plausibility) return std::unexpected(plausibility.error());
  config.plausibility = *std::move(plausibility);
  return {};
}

base::Result<host::StationConfig> settings_of(StationArguments const& arguments) {
  base::Result<host::StationConfig> config =
      arguments.config.empty()
          ? host::StationConfig{}
          : host::load_config(arguments.config, host::read_station_config, "docs/reference/station-config.md");
  if (!config) return config;
  if (!arguments.links.empty()) config->links = arguments.links;
  if (!arguments.robots.empty()) config->robots = arguments.robots;
  if (arguments.robot_cameras) config->robot_cameras = *arguments.robot_cameras;
  if (!arguments.old_parts.empty()) config->old_parts = arguments.old_parts;
  if (auto added = host::add_survey_links(arguments.survey, config->survey); !added)
    return std::unexpected(added.error());
  for (auto& drone : config->survey)
    if (auto taken = host::take_tokens(drone); !taken) return std::unexpected(taken.error());
  if (config->links.empty()) config->links = {host::default_link};
  for (auto const& text : arguments.payload) {
    if (auto added = host::add_payload(text, config->payload); !added) return std::unexpected(added.error());
  }
  if (auto set = set_safety(arguments, *config); !set) return std::unexpected(set.error());
  if (auto set = set_map(arguments, config->map); !set) return std::unexpected(set.error());
  if (!arguments.forward.empty()) {
    auto forward = host::forward_to(arguments.forward);
    if (!forward) return std::unexpected(forward.error());
    config->forward = *std::move(forward);
  }
  if (arguments.signing_key) config->signing_key = *arguments.signing_key;
  if (arguments.record) config->record = *arguments.record;
  host::apply(arguments.web, config->web);
  return config;
}

/// They stand in the site that the map has from before, else at its home. A simulated one is nowhere else.
base::Result<> add_robots(host::Session& session, host::StationConfig const& config) {
  bool is_any_real = false;
  for (auto const& text : config.robots) {
    auto const request = host::parse_robot(text);
    if (!request) return std::unexpected(request.error());
    is_any_real = is_any_real || !std::holds_alternative<host::SimulatedRobots>(*request);
  }
  if (is_any_real && !config.map.home && !session.live_map.site("default"))
    return base::fail(base::ErrorKind::invalid_input, "nothing says where on the globe the robot is",
                      "in the station's file, --config: [map] home = \"LAT,LON,ALT\"");
  return session.add_robots(config.robots, config.map.home.value_or(sim::WorldOptions{}.home));
}

int serve(StationArguments const& arguments) {
  auto const config = settings_of(arguments);
  if (!config) return host::refuse(config.error());
  auto plans = host::load_plans(arguments.plans);
  if (!plans) return host::refuse(plans.error());
  auto const signing = host::read_signing(config->signing_key);
  if (!signing) return host::refuse(signing.error());
  auto cameras = host::load_robot_cameras(config->robot_cameras);
  if (!cameras) return host::refuse(cameras.error());
  host::Session session({.on_stop = config->on_stop,
                         .emergency_action = config->emergency_action,
                         .battery_limits = config->battery_limits,
                         .plans = *std::move(plans),
                         .payload = config->payload,
                         .plausibility = config->plausibility,
                         .signing = *signing,
                         .robot_cameras = *std::move(cameras)});
  if (!config->record.empty()) {
    if (auto begun = session.record(config->record); !begun) return host::refuse(begun.error());
  }
  if (auto opened = session.open_store(config->map); !opened) return host::refuse(opened.error());
  if (auto added = add_robots(session, *config); !added) return host::refuse(added.error());
  if (auto opened = session.open_old_parts(config->old_parts); !opened) return host::refuse(opened.error());
  if (auto opened = session.open_survey(config->survey); !opened) return host::refuse(opened.error());
  if (auto opened = session.open_links(config->links); !opened) return host::refuse(opened.error());
  if (auto opened = session.forward(config->forward); !opened) return host::refuse(opened.error());
  if (auto opened = session.open_map(config->web, config->map); !opened) return host::refuse(opened.error());
  fmt::print(stderr, "listening for vehicles on {}; Ctrl-C ends\n", fmt::join(config->links, ", "));
  bool const was_running = session.serve("the end of the station");
  session.give_back_rates();
  return was_running ? host::exit_interrupted : host::exit_done;
}

}  // namespace

void add_station(CLI::App& program, int& exit_code) {
  auto arguments = std::make_shared<StationArguments>();
  auto* verb = begin_verb(program, "station");
  verb->add_option("--config", arguments->config, "TOML file with the settings; options given here go before it");
  verb->add_option("--link", arguments->links,
                   "Where vehicles are (may be repeated); default " + std::string(host::default_link));
  verb->add_option("--robot", arguments->robots, host::robot_help)->allow_extra_args(false);
  verb->add_option("--robot-cameras", arguments->robot_cameras, host::robot_cameras_help);
  verb->add_option("--old-parts", arguments->old_parts, host::old_parts_help)->allow_extra_args(false);
  verb->add_option("--survey", arguments->survey, host::survey_help)->allow_extra_args(false);
  verb->add_option("--forward", arguments->forward, host::forward_help);
  verb->add_option("--payload", arguments->payload, host::payload_help);
  host::add_web_options(*verb, arguments->web);
  verb->add_option("--scripts", arguments->scripts, "Folder whose scripts the map offers")
      ->check(CLI::ExistingDirectory);
  verb->add_option("--signing-key", arguments->signing_key, host::signing_key_help);
  verb->add_option("--record", arguments->record, host::record_help);
  verb->add_option("--plans", arguments->plans, host::plans_help);
  verb->add_option("--store", arguments->store,
                   "Where the map and its past are kept: a folder, or postgresql://USER@HOST/DATABASE");
  verb->add_option("--tiles", arguments->tiles, "Base map for the browsers: https://tiles.example/{z}/{x}/{y}.png");
  verb->add_option("--on-stop", arguments->on_stop,
                   "What a vehicle does when its task is stopped: loiter (default), rtl or land");
  host::add_plausibility_options(*verb, arguments->plausibility);
  verb->add_option("--emergency-stop", arguments->emergency_stop,
                   "What the emergency stop does: hold (default), land, rtl or terminate");
  verb->callback([arguments, &exit_code] { exit_code = serve(*arguments); });
}

}  // namespace lapwing::apps
