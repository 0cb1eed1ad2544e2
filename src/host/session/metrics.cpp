#include "host/session/metrics.hpp"

#include <string_view>
#include <vector>

#include "base/open_metrics.hpp"
#include "route/metrics.hpp"

namespace lapwing::host {

namespace {

using base::OpenMetrics;

using mavlink::LinkReport;
using mavlink::SourceReport;

template <class Of>
struct Counter {
  std::string_view name;
  std::string_view help;
  std::uint64_t (*value)(Of const&);
};

constexpr Counter<LinkReport> link_counters[] = {
    {"lapwing_link_received_bytes", "Bytes received.", [](LinkReport const& l) { return l.bytes.bytes_received; }},
    {"lapwing_link_sent_bytes", "Bytes sent.", [](LinkReport const& l) { return l.bytes.bytes_sent; }},
    {"lapwing_link_received_frames", "MAVLink frames received.", [](LinkReport const& l) { return l.frames.frames; }},
    {"lapwing_link_crc_errors", "Frames whose checksum was wrong.",
     [](LinkReport const& l) { return l.frames.crc_errors; }},
    {"lapwing_link_unknown_frames", "Frames of messages that the dialect lacks.",
     [](LinkReport const& l) { return l.frames.unknown_ids; }},
    {"lapwing_link_junk_bytes", "Bytes that belonged to no frame.",
     [](LinkReport const& l) { return l.frames.junk_bytes; }},
    {"lapwing_link_receive_overruns", "Datagrams that the kernel dropped because its queue was full.",
     [](LinkReport const& l) { return l.bytes.overruns; }},
    {"lapwing_link_send_failures", "Datagrams or pieces of a stream that were not taken.",
     [](LinkReport const& l) { return l.bytes.send_failures; }},
    {"lapwing_link_perishable_dropped", "Old packets that newer ones pushed out of a slow link's queue.",
     [](LinkReport const& l) { return l.bytes.perishable_dropped; }},
};

/// Of each system and component on each of its links.
constexpr Counter<SourceReport> source_counters[] = {
    {"lapwing_source_received", "Messages received.", [](SourceReport const& s) { return s.counters.received; }},
    {"lapwing_source_lost", "Gaps in the sequence that nothing filled later.",
     [](SourceReport const& s) { return s.counters.lost; }},
    {"lapwing_source_duplicated", "Messages that came twice over one link.",
     [](SourceReport const& s) { return s.counters.duplicated; }},
    {"lapwing_source_redundant", "Messages that another link had brought already.",
     [](SourceReport const& s) { return s.counters.redundant; }},
    {"lapwing_source_out_of_order", "Messages that came behind later ones.",
     [](SourceReport const& s) { return s.counters.out_of_order; }},
};

void write_links(OpenMetrics& metrics, std::span<LinkReport const> links) {
  metrics.gauge("lapwing_link_open", "1 while the link is open.");
  for (auto const& l : links) metrics.sample({{"link", l.name}}, std::uint64_t{l.state == link::LinkState::open});
  for (auto const& [name, help, value] : link_counters) {
    metrics.counter(name, help);
    for (auto const& l : links) metrics.sample({{"link", l.name}}, value(l));
  }
}

/// Calls `write(report, labels)` for each source on each link.
template <class Write>
void for_each_source(std::span<LinkReport const> links, Write write) {
  for (auto const& link : links)
    for (auto const& source : link.sources) {
      auto const system = std::to_string(source.source.system);
      auto const component = std::to_string(source.source.component);
      write(source, {{"link", link.name}, {"address", source.address}, {"system", system}, {"component", component}});
    }
}

void write_impossible_values(OpenMetrics& metrics, std::span<LinkReport const> links) {
  metrics.counter("lapwing_link_impossible_values",
                  "Fields in which vehicles told what cannot be; they were left out.");
  for (auto const& link : links)
    for (auto const& [message, field, count] : link.impossible_values)
      metrics.sample({{"link", link.name}, {"message", message}, {"field", field}}, count);
}

void write_sources(OpenMetrics& metrics, std::span<LinkReport const> links) {
  using Labels = OpenMetrics::Labels;
  for (auto const& [name, help, value] : source_counters) {
    metrics.counter(name, help);
    for_each_source(links, [&](SourceReport const& s, Labels labels) { metrics.sample(labels, value(s)); });
  }
  metrics.gauge("lapwing_source_round_trip_seconds", "Median of the last TIMESYNC answers.");
  for_each_source(links, [&](SourceReport const& s, Labels labels) {
    if (s.round_trip) metrics.sample(labels, base::to_seconds(*s.round_trip));
  });
  metrics.gauge("lapwing_source_age_seconds", "Time since the last message.");
  for_each_source(links,
                  [&](SourceReport const& s, Labels labels) { metrics.sample(labels, base::to_seconds(s.age)); });
}

void write_vehicles(OpenMetrics& metrics, vehicle::Registry const& registry, base::TimePoint now) {
  auto const vehicles = registry.all();
  metrics.gauge("lapwing_vehicle_connected", "1 for a vehicle that is heard, 0 for one that is lost or in conflict.");
  for (auto const* v : vehicles)
    metrics.sample({{"vehicle", v->id.text}, {"name", v->name}},
                   std::uint64_t{v->links.connection == vehicle::Connection::ok});
  metrics.gauge("lapwing_vehicle_heartbeat_age_seconds", "Time since the vehicle's last heartbeat.");
  for (auto const* v : vehicles)
    metrics.sample({{"vehicle", v->id.text}}, base::to_seconds(now - v->links.heartbeat_heard));
  metrics.gauge("lapwing_vehicle_armed", "1 while the vehicle is armed.");
  for (auto const* v : vehicles) {
    if (v->arming.armed.known()) metrics.sample({{"vehicle", v->id.text}}, std::uint64_t{*v->arming.armed.value});
  }
  metrics.gauge("lapwing_vehicle_battery_ratio", "Charge left, 0 to 1.");
  for (auto const* v : vehicles) {
    if (v->power.battery.known()) metrics.sample({{"vehicle", v->id.text}}, v->power.battery.value->remaining);
  }
}

}  // namespace

std::string metrics_of(vehicle::Registry const& vehicles, std::span<LinkReport const> links,
                       std::map<std::string, route::Router> const& forwarding, base::TimePoint now) {
  OpenMetrics metrics;
  write_vehicles(metrics, vehicles, now);
  write_links(metrics, links);
  write_impossible_values(metrics, links);
  write_sources(metrics, links);
  std::vector<route::Router const*> routers;
  for (auto const& [network, router] : forwarding) routers.push_back(&router);
  if (!routers.empty()) route::write_metrics(routers, metrics);
  return metrics.text();
}

}  // namespace lapwing::host
