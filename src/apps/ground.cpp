#include "apps/ground.hpp"

#include <algorithm>
#include <cctype>
#include <utility>

#include <fmt/format.h>

#include "link/byte_link.hpp"

namespace lapwing::apps {

namespace {

fleet::FleetPlatform::Options platform_options(fleet::OnStop on_stop, tasks::PlanLibrary plans) {
  fleet::FleetPlatform::Options options;
  options.run.on_stop = on_stop;
  options.plan_library = std::move(plans);
  return options;
}

mavlink::Connection::Options connection_options(bool asks_for_messages, SigningSetup const& signing) {
  mavlink::Connection::Options options{.keys = signing.ring, .signed_until = signing.signed_until};
  if (!asks_for_messages) options.timesync_period = {};
  return options;
}

}  // namespace

base::Result<NetworkLink> parse_network_link(std::string const& text) {
  // A name stands before the URL's first colon; a path or an option may have an equals sign, too.
  auto const equals = text.find('=');
  bool const has_name = equals != std::string::npos && equals < text.find_first_of(":/");
  auto url = link::parse_url(has_name ? text.substr(equals + 1) : text);
  if (!url) return std::unexpected(url.error());
  auto name = has_name ? text.substr(0, equals) : std::string();
  auto const is_plain = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '-' || c == '_'; };
  if (has_name && (name.empty() || !std::ranges::all_of(name, is_plain)))
    return base::fail(base::ErrorKind::invalid_input,
                      fmt::format("link '{}': '{}' is no name of a network", text, name),
                      "letters, digits, - and _: north=udpin://0.0.0.0:14551");
  return NetworkLink{std::move(name), *std::move(url)};
}

Ground::Ground(base::Loop& on, fleet::OnStop on_stop, base::Logger to, fleet::Fleet::Options options,
               tasks::PlanLibrary plans, SigningSetup keys, vehicle::StopAction emergency_action)
    : loop(on),
      log(std::move(to)),
      asks_for_messages(options.asks_for_messages),
      signing(std::move(keys)),
      connection(on, connection_options(asks_for_messages, signing), log.named("link")),
      registry(on),
      fleet(connection, registry, std::move(options), log.named("fleet")),
      platform(fleet, platform_options(on_stop, std::move(plans)), log.named("fleet")),
      control(fleet, platform, {.stop_action = emergency_action}, log) {}

base::Result<> Ground::open(std::vector<std::string> const& texts) {
  std::vector<std::pair<std::string, std::unique_ptr<link::ByteLink>>> links;
  for (auto const& text : texts) {
    auto const parsed = parse_network_link(text);
    if (!parsed) return std::unexpected(parsed.error());
    auto link = link::open(loop, parsed->url);
    if (!link) return std::unexpected(link.error());
    links.emplace_back(parsed->network, std::move(*link));
  }
  for (auto& [network, link] : links) connection_of(network).add_link(std::move(link));
  return {};
}

std::vector<mavlink::LinkReport> Ground::link_reports() const {
  auto reports = connection.report();
  for (auto const& [name, network] : networks)
    for (auto& report : network.report()) reports.push_back(std::move(report));
  return reports;
}

mavlink::Connection& Ground::connection_of(std::string const& network) {
  if (network.empty()) return connection;
  if (auto const found = networks.find(network); found != networks.end()) return found->second;
  auto& made = networks.try_emplace(network, loop, connection_options(asks_for_messages, signing), log.named("link"))
                   .first->second;
  fleet.add(made, network);
  return made;
}

}  // namespace lapwing::apps
