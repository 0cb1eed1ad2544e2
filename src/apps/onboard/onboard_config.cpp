#include "apps/onboard/onboard_config.hpp"

#include <algorithm>
#include <array>
#include <set>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "apps/onboard/bus_config.hpp"
#include "base/config.hpp"
#include "base/text/spelling.hpp"
#include "link/url.hpp"

namespace lapwing::apps {

namespace {

namespace fs = std::filesystem;
namespace wire = link::operator_link;
using base::ConfigReader;
using base::Diagnostics;
using base::config_kinds::invalid_value;

/// Where the flight controller sends when nobody says where.
constexpr auto usual_link = "udpin://127.0.0.1:14550";

fs::path beside(base::SourceFile const& source, std::string const& path) {
  return fs::path(source.name()).parent_path() / path;
}

void read_bridge(ConfigReader& root, Diagnostics& diagnostics, bridge::BridgeOptions& bridge) {
  bridge.link = link::parse_url(usual_link).value();
  auto table = root.table("bridge");
  if (!table) return;
  if (auto const text = table->text("link")) {
    if (auto url = link::parse_url(text->value))
      bridge.link = *std::move(url);
    else
      diagnostics.report(invalid_value, text->span, url.error().message, url.error().hint);
  }
  if (auto const id = table->integer("system_id", 1, 255)) bridge.system_id = static_cast<std::uint8_t>(id->value);
  if (auto const geoid = table->number("geoid_m", -110.0, 90.0)) bridge.geoid_m = geoid->value;
  table->refuse_unknown();
}

void read_relied_on(ConfigReader& table, Diagnostics& diagnostics, std::vector<std::string>& relies_on) {
  auto const texts = table.texts("relies_on");
  if (!texts) return;
  auto const known = onboard::known_processes();
  for (auto const& [text, span] : *texts) {
    if (std::ranges::find(known, text) != known.end())
      relies_on.push_back(text);
    else
      diagnostics.report(invalid_value, span, fmt::format("nobody reports his health as \"{}\"", text),
                         fmt::format("one of {}", fmt::join(known, ", ")));
  }
}

void read_decide(ConfigReader& root, base::SourceFile const& source, Diagnostics& diagnostics,
                 onboard::DecideSettings& decide) {
  decide.state_folder = beside(source, decide.state_folder.string());
  auto table = root.table("decide");
  if (!table) return;
  constexpr double longest_link_lost_s = 60.0;
  if (auto const folder = table->text("state_folder")) decide.state_folder = beside(source, folder->value);
  if (auto const lost = table->number("link_lost_s", 1.0, longest_link_lost_s))
    decide.machine.link_lost = base::from_seconds(lost->value);
  if (auto const furthest = table->number("furthest_m", 1.0, 1e4)) decide.machine.places.furthest_m = furthest->value;
  read_relied_on(*table, diagnostics, decide.relies_on);
  table->refuse_unknown();
}

void read_mode(ConfigReader& table, Diagnostics& diagnostics, wire::Mode& mode) {
  auto const text = table.text("mode");
  if (!text) return;
  if (text->value == "framed") {
    mode = wire::Mode::framed;
  } else if (text->value == "json") {
    mode = wire::Mode::json;
  } else {
    diagnostics.report(invalid_value, text->span, fmt::format("mode cannot be \"{}\"", text->value),
                       "framed (numbered and confirmed, the default) or json (one object after the other)");
  }
}

void read_tls(ConfigReader& table, base::SourceFile const& source, Diagnostics& diagnostics,
              std::optional<wire::TlsServerSettings>& tls) {
  auto const certificate = table.text("certificate");
  auto const key = table.text("key");
  auto const authority = table.text("client_authority");
  if (!certificate && !key && !authority) return;
  if (!certificate || !key) {
    auto const span = certificate ? certificate->span : key ? key->span : authority->span;
    diagnostics.report(invalid_value, span, "TLS takes a certificate and its key", "name both files, in PEM");
    return;
  }
  tls = wire::TlsServerSettings{.certificate = beside(source, certificate->value), .key = beside(source, key->value)};
  if (authority) tls->client_authority = beside(source, authority->value);
}

void read_operator(ConfigReader& root, base::SourceFile const& source, Diagnostics& diagnostics,
                   OnboardConfig& config) {
  auto& desk = config.decide.desk;
  desk.server.end.name = "drone";
  desk.server.end.session.link_lost = config.decide.machine.link_lost;
  auto table = root.table("operator");
  if (!table) return;
  if (auto const address = table->text("address")) desk.address = address->value;
  if (auto const port = table->integer("port", 0, 65535)) desk.port = static_cast<std::uint16_t>(port->value);
  if (auto const name = table->text("name")) {
    desk.server.end.name = name->value;
    if (auto const fine = wire::check_name(name->value); !fine)
      diagnostics.report(invalid_value, name->span, fine.error().message, fine.error().hint);
  }
  if (auto const file = table->text("token_file")) config.token_file = beside(source, file->value);
  read_mode(*table, diagnostics, desk.server.end.mode);
  read_tls(*table, source, diagnostics, desk.tls);
  table->refuse("token", "keep it in a file of its own (mode 0600): token_file = \"operator.token\"");
  table->refuse_unknown();
}

onboard::ProcessSpec read_process(base::Placed<ConfigReader>& table, Diagnostics& diagnostics,
                                  OnboardConfig const& config) {
  onboard::ProcessSpec spec;
  auto const name = table.value.text("name");
  if (name) spec.name = name->value;
  if (!name && !table.value.has("name"))
    diagnostics.report(invalid_value, table.span, "a process needs a name", "name = \"bridge\"");
  bool const is_within = spec.name == bridge_process || spec.name == decide_process;
  auto const command = table.value.texts("command");
  if (command)
    for (auto const& [word, span] : *command) spec.command.push_back(word);
  if (name && is_within && command)
    diagnostics.report(invalid_value, name->span, fmt::format("{} is in this program and takes no command", spec.name),
                       "give a process of your own another name");
  // It has a program of its own, which is known.
  bool const is_beside =
      (config.sees && spec.name == perceive_process) || (config.shows && spec.name == stream_process);
  bool const is_own = is_within || (is_beside && !command);
  if (name && !is_own && spec.command.empty())
    diagnostics.report(invalid_value, name->span,
                       fmt::format("there is no process {} in this program, and no command for it", spec.name),
                       "bridge, decide, or command = [\"/path/to/program\", \"its\", \"words\"]");
  auto const tells_life = table.value.flag("tells_life");
  spec.tells_life = is_own || (tells_life && tells_life->value);
  table.value.refuse_unknown();
  return spec;
}

void read_processes(ConfigReader& root, Diagnostics& diagnostics, OnboardConfig& config) {
  std::set<std::string, std::less<>> names;
  for (auto& table : root.tables("process")) {
    auto spec = read_process(table, diagnostics, config);
    if (!spec.name.empty() && !names.insert(spec.name).second)
      diagnostics.report(invalid_value, table.span, fmt::format("there are two processes {}", spec.name));
    if (spec.name == bridge_process && names.contains(decide_process))
      diagnostics.report(invalid_value, table.span, "bridge stands behind decide",
                         "name it first: they are stopped in the other order, and decide needs it to bring the drone "
                         "down");
    config.processes.push_back(std::move(spec));
  }
  if (!config.processes.empty() || root.has("process")) return;
  config.processes.push_back({.name = std::string(bridge_process)});
  if (config.sees) config.processes.push_back({.name = std::string(perceive_process)});
  if (config.shows) config.processes.push_back({.name = std::string(stream_process)});
  config.processes.push_back({.name = std::string(decide_process)});
}

}  // namespace

OnboardConfig read_onboard_config(base::SourceFile const& source, base::Diagnostics& diagnostics) {
  auto const tree = base::parse_config(source, diagnostics);
  ConfigReader root(tree, diagnostics);
  OnboardConfig config;
  read_bus(root, config.bus);
  read_bridge(root, diagnostics, config.bridge);
  read_decide(root, source, diagnostics, config.decide);
  read_operator(root, source, diagnostics, config);
  if (auto const file = root.text("health_file")) config.health_file = beside(source, file->value);
  // What is in them lapwing-perceive and lapwing-stream read and check.
  config.sees = root.has("camera");
  config.shows = root.has("rtsp") || root.has("webrtc");
  for (auto const* const table : {"camera", "survey", "stream", "rtsp", "webrtc"}) (void)root.table(table);
  if (!config.sees && root.has("survey"))
    diagnostics.report(invalid_value, {0, 1}, "a survey needs a camera",
                       "[camera] with kind = \"simulated\" and a world, ...");
  if (config.shows && !config.sees)
    diagnostics.report(
        invalid_value, {0, 1},
        fmt::format("[{}] shows what a camera sees, and there is none", root.has("rtsp") ? "rtsp" : "webrtc"),
        "[camera] with kind = \"simulated\" and a world, ...");
  read_processes(root, diagnostics, config);
  root.refuse_unknown();
  return config;
}

}  // namespace lapwing::apps
