#include "host/links/ground.hpp"

#include <algorithm>
#include <cstdlib>
#include <utility>

#include <fmt/format.h>

#include "link/byte_link.hpp"
#include "mavlink/wire/system_name.hpp"

namespace lapwing::host {

namespace {

mavlink::Connection::Options connection_options(bool asks_for_messages, SigningSetup const& signing,
                                                std::string const& network) {
  mavlink::Connection::Options options{.signed_until = signing.signed_until};
  if (signing.ring) options.keys = mavlink::ring_of_network(*signing.ring, network);
  if (!asks_for_messages) options.timesync_period = {};
  return options;
}

}  // namespace

parameters::Cache parameter_cache() {
  return parameters::Cache(parameters::cache_folder(std::getenv("XDG_CACHE_HOME"), std::getenv("HOME")));
}

base::Result<NetworkLink> parse_network_link(std::string const& text) {
  // A name stands before the URL's first colon; a path or an option may have an equals sign, too.
  auto const equals = text.find('=');
  bool const has_name = equals != std::string::npos && equals < text.find_first_of(":/");
  auto url = link::parse_url(has_name ? text.substr(equals + 1) : text);
  if (!url) return std::unexpected(url.error());
  auto name = has_name ? text.substr(0, equals) : std::string();
  if (has_name && !mavlink::is_network_name(name))
    return base::fail(base::ErrorKind::invalid_input,
                      fmt::format("link '{}': '{}' is no name of a network", text, name),
                      "letters, digits, - and _: north=udpin://0.0.0.0:14551");
  return NetworkLink{std::move(name), *std::move(url)};
}

Ground::Ground(base::Loop& on, base::Logger to, fleet::Fleet::Options options, SigningSetup keys)
    : loop(on),
      log(std::move(to)),
      asks_for_messages(options.asks_for_messages),
      signing(std::move(keys)),
      connection(made("")),
      registry(on),
      authority(on, registry, log.named("command")),
      fleet(connection, registry, authority, std::move(options), log.named("fleet")) {}

base::Result<> Ground::open(std::vector<std::string> const& texts) {
  std::vector<std::pair<std::string, std::unique_ptr<link::ByteLink>>> links;
  for (auto const& text : texts) {
    auto const parsed = parse_network_link(text);
    if (!parsed) return std::unexpected(parsed.error());
    auto link = link::open(loop, parsed->url);
    if (!link) return std::unexpected(link.error());
    links.emplace_back(parsed->network, std::move(*link));
  }
  for (auto& [name, link] : links) {
    bool const is_new = !networks.contains(name);
    auto& network = is_new ? made(name) : networks.at(name);
    if (is_new) fleet.add(network, name);
    network.add_link(std::move(link));
  }
  return {};
}

base::Result<mavlink::Connection*> Ground::network(std::string const& name) {
  if (auto const found = networks.find(name); found != networks.end()) return &found->second;
  return base::fail(base::ErrorKind::invalid_input, fmt::format("there is no network {}", name),
                    fmt::format("name it before the URL of its link: --link {}=udpin://0.0.0.0:14551", name));
}

std::vector<mavlink::LinkReport> Ground::link_reports() const {
  std::vector<mavlink::LinkReport> reports;
  for (auto const& [name, network] : networks)
    for (auto& report : network.report()) reports.push_back(std::move(report));
  return reports;
}

mavlink::SigningTime Ground::signed_until() const {
  mavlink::SigningTime latest = 0;
  for (auto const& [name, network] : networks)
    if (auto const* guard = network.signing()) latest = std::max(latest, guard->signed_until());
  return latest;
}

mavlink::Connection& Ground::made(std::string const& network) {
  auto options = connection_options(asks_for_messages, signing, network);
  return networks.try_emplace(network, loop, std::move(options), log.named("link")).first->second;
}

}  // namespace lapwing::host
