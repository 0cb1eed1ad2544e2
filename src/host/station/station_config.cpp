#include "host/station/station_config.hpp"

#include <array>
#include <utility>

#include <fmt/format.h>

#include "base/config.hpp"
#include "base/text/spelling.hpp"
#include "host/links/ground.hpp"
#include "host/plausibility/reading.hpp"
#include "host/robots/old_parts.hpp"
#include "host/robots/robot_spec.hpp"
#include "host/session/session.hpp"
#include "host/simulation/simulation.hpp"
#include "link/url.hpp"
#include "route/config.hpp"

namespace lapwing::host {

namespace {

namespace fs = std::filesystem;
using base::ConfigReader;
using base::Diagnostics;
using PlacedText = base::Placed<std::string>;

/// The value of `read`, or what is wrong with it at its place.
template <class T>
std::optional<T> valid(Diagnostics& diagnostics, base::Span span, base::Result<T> read) {
  if (read) return *std::move(read);
  diagnostics.report(base::config_kinds::invalid_value, span, read.error().message, read.error().hint);
  return std::nullopt;
}

fs::path beside(base::SourceFile const& source, std::string const& path) {
  return fs::path(source.name()).parent_path() / path;
}

void read_links(ConfigReader& root, Diagnostics& diagnostics, StationConfig& config) {
  auto const links = root.texts("links");
  if (!links) return;
  for (auto const& [text, span] : *links) {
    if (valid(diagnostics, span, parse_network_link(text))) config.links.push_back(text);
  }
}

void read_robots(ConfigReader& root, Diagnostics& diagnostics, StationConfig& config) {
  auto const robots = root.texts("robots");
  if (!robots) return;
  for (auto const& [text, span] : *robots) {
    if (valid(diagnostics, span, parse_robot(text))) config.robots.push_back(text);
  }
}

void read_old_parts(ConfigReader& root, Diagnostics& diagnostics, StationConfig& config) {
  auto const parts = root.texts("old_parts");
  if (!parts) return;
  for (auto const& [text, span] : *parts) {
    if (valid(diagnostics, span, parse_old_parts(text))) config.old_parts.push_back(text);
  }
}

void read_payload(ConfigReader& root, Diagnostics& diagnostics, StationConfig& config) {
  auto const payload = root.texts("payload");
  if (!payload) return;
  for (auto const& [text, span] : *payload) {
    if (auto const added = add_payload(text, config.payload); !added)
      diagnostics.report(base::config_kinds::invalid_value, span, added.error().message, added.error().hint);
  }
}

void read_on_stop(ConfigReader& root, Diagnostics& diagnostics, StationConfig& config) {
  auto const text = root.text("on_stop");
  if (!text) return;
  constexpr std::array<std::string_view, 3> modes{"loiter", "rtl", "land"};
  if (auto const on_stop = parse_on_stop(text->value)) {
    config.on_stop = *on_stop;
    return;
  }
  auto hint = base::did_you_mean(text->value, modes);
  diagnostics.report(base::config_kinds::invalid_value, text->span,
                     fmt::format("on_stop cannot be \"{}\"", text->value),
                     hint.empty() ? "use loiter (hold in place, the default), rtl (return to launch) or land" : hint);
}

void read_emergency_stop(ConfigReader& root, Diagnostics& diagnostics, StationConfig& config) {
  auto const text = root.text("emergency_stop");
  if (!text) return;
  if (auto const action = parse_emergency_stop(text->value)) {
    config.emergency_action = *action;
    return;
  }
  constexpr std::array<std::string_view, 4> actions{"hold", "land", "rtl", "terminate"};
  auto hint = base::did_you_mean(text->value, actions);
  diagnostics.report(base::config_kinds::invalid_value, text->span,
                     fmt::format("emergency_stop cannot be \"{}\"", text->value),
                     hint.empty() ? "use hold (stay in place, the default), land, rtl or terminate" : hint);
}

Forward read_forward(base::Placed<ConfigReader> table) {
  auto const network = table.value.text("network");
  return {.network = network ? network->value : std::string(), .endpoint = route::read_endpoint(std::move(table))};
}

void read_web(ConfigReader web, base::SourceFile const& source, Diagnostics& diagnostics, WebAccess& access) {
  if (auto const bind = web.text("bind")) access.bind = bind->value;
  if (auto const port = web.integer("port", 0, 65535)) access.port = static_cast<int>(port->value);
  if (auto const file = web.text("token_file")) access.token_file = beside(source, file->value).string();
  if (auto const generate = web.flag("generate_token")) {
    access.generate_token = generate->value;
    if (generate->value && !access.token_file.empty()) {
      diagnostics.report(base::config_kinds::invalid_value, generate->span,
                         "a token comes from token_file or is generated, not both", "remove one of them");
    }
  }
  if (auto const names = web.texts("host_names")) {
    for (auto const& [name, span] : *names) access.host_names.push_back(name);
  }
  web.refuse("token", "keep it in a file of its own (mode 0600): token_file = \"station.token\"");
  web.refuse_unknown();
}

void read_map(ConfigReader map, base::SourceFile const& source, Diagnostics& diagnostics, MapContent& content) {
  if (auto const name = map.text("site")) content.site_name = name->value;
  if (auto const home = map.text("home")) {
    if (auto const place = valid(diagnostics, home->span, parse_home(home->value))) content.home = place->place;
  }
  if (auto const tiles = map.text("tiles")) {
    if (auto const checked = check_tiles(tiles->value); !checked) {
      diagnostics.report(base::config_kinds::invalid_value, tiles->span, checked.error().message, checked.error().hint);
    }
    content.tiles = tiles->value;
  }
  content.base_maps = read_base_maps(map, fs::path(source.name()).parent_path());
  if (auto const scripts = map.text("scripts")) {
    content.scripts = beside(source, scripts->value);
    if (!fs::is_directory(content.scripts)) {
      diagnostics.report(base::config_kinds::invalid_value, scripts->span,
                         fmt::format("there is no folder {}", content.scripts.string()),
                         "a relative path counts from this file's folder");
    }
  }
  map.refuse_unknown();
}

void read_store(ConfigReader store, base::SourceFile const& source, StoreSettings& settings) {
  if (auto const place = store.text("place")) {
    settings.place = StoreSettings::Place::named;
    bool const is_server = place->value.starts_with("postgresql://") || place->value.starts_with("postgres://");
    settings.address = is_server ? place->value : beside(source, place->value).string();
  }
  constexpr std::int64_t most_mb = 1'000'000'000;
  constexpr std::int64_t most_days = 36'500;
  if (auto const size = store.integer("most_mb", 10, most_mb))
    settings.most_bytes = static_cast<std::uint64_t>(size->value) * 1024 * 1024;
  if (auto const days = store.integer("days", 1, most_days)) settings.longest = std::chrono::days(days->value);
  store.refuse_unknown();
}

void read_alarms(ConfigReader alarms, Diagnostics& diagnostics, vehicle::BatteryLimits& limits) {
  auto const low = alarms.number("battery_low_percent", 0.0, 100.0);
  auto const critical = alarms.number("battery_critical_percent", 0.0, 100.0);
  if (low) limits.low = low->value / 100.0;
  if (critical) limits.critical = critical->value / 100.0;
  if (limits.critical > limits.low) {
    diagnostics.report(base::config_kinds::invalid_value, critical ? critical->span : low->span,
                       "a battery is low before it is critical",
                       fmt::format("battery_low_percent is {:g}, battery_critical_percent {:g}", limits.low * 100.0,
                                   limits.critical * 100.0));
  }
  alarms.refuse_unknown();
}

}  // namespace

StationConfig read_station_config(base::SourceFile const& source, Diagnostics& diagnostics) {
  StationConfig config;
  auto const entries = base::parse_config(source, diagnostics);
  if (diagnostics.has_errors()) return config;
  ConfigReader root(entries, diagnostics);
  read_links(root, diagnostics, config);
  read_robots(root, diagnostics, config);
  read_old_parts(root, diagnostics, config);
  if (auto const file = root.text("robot_cameras")) config.robot_cameras = beside(source, file->value).string();
  for (auto& table : root.tables("survey")) config.survey.push_back(read_survey(table, source, diagnostics));
  read_payload(root, diagnostics, config);
  read_on_stop(root, diagnostics, config);
  read_emergency_stop(root, diagnostics, config);
  for (auto& table : root.tables("forward")) config.forward.push_back(read_forward(std::move(table)));
  if (auto const file = root.text("signing_key")) config.signing_key = beside(source, file->value).string();
  if (auto const folder = root.text("record")) config.record = beside(source, folder->value).string();
  if (auto table = root.table("plausibility")) config.plausibility = read_plausibility(std::move(*table));
  if (auto web = root.table("web")) read_web(std::move(*web), source, diagnostics, config.web);
  if (auto store = root.table("store")) read_store(std::move(*store), source, config.map.store);
  if (auto map = root.table("map")) read_map(std::move(*map), source, diagnostics, config.map);
  if (auto alarms = root.table("alarms")) read_alarms(std::move(*alarms), diagnostics, config.battery_limits);
  root.refuse_unknown();
  return config;
}

}  // namespace lapwing::host
