#include "apps/ground.hpp"

#include <utility>

#include "link/byte_link.hpp"
#include "link/url.hpp"

namespace lapwing::apps {

namespace {

fleet::FleetPlatform::Options platform_options(fleet::OnStop on_stop, tasks::PlanLibrary plans) {
  fleet::FleetPlatform::Options options;
  options.run.on_stop = on_stop;
  options.plan_library = std::move(plans);
  return options;
}

mavlink::Connection::Options connection_options(fleet::Fleet::Options const& fleet_options,
                                                std::optional<mavlink::SigningKey> const& signing_key) {
  mavlink::Connection::Options options{.signing_key = signing_key};
  if (!fleet_options.asks_for_messages) options.timesync_period = {};
  return options;
}

}  // namespace

Ground::Ground(base::Loop& on, fleet::OnStop on_stop, base::Logger log, fleet::Fleet::Options fleet_options,
               tasks::PlanLibrary plans, std::optional<mavlink::SigningKey> signing_key,
               vehicle::StopAction emergency_action)
    : loop(on),
      connection(on, connection_options(fleet_options, signing_key), log.named("link")),
      registry(on),
      fleet(connection, registry, std::move(fleet_options), log.named("fleet")),
      platform(fleet, platform_options(on_stop, std::move(plans)), log.named("fleet")),
      control(fleet, platform, {.stop_action = emergency_action}, log) {}

base::Result<> Ground::open(std::vector<std::string> const& urls) {
  std::vector<std::unique_ptr<link::ByteLink>> links;
  for (auto const& text : urls) {
    auto const url = link::parse_url(text);
    if (!url) return std::unexpected(url.error());
    auto link = link::open(loop, *url);
    if (!link) return std::unexpected(link.error());
    links.push_back(std::move(*link));
  }
  for (auto& link : links) connection.add_link(std::move(link));
  return {};
}

}  // namespace lapwing::apps
