#include "apps/metrics.hpp"

#include <string_view>

#include "base/open_metrics.hpp"
#include "route/metrics.hpp"

namespace lapwing::apps {

namespace {

using base::OpenMetrics;

struct LinkNow {
  std::string name;
  bool is_open;
  link::LinkCounters bytes;
  mavlink::ParserCounters frames;
};

struct LinkCounter {
  std::string_view name;
  std::string_view help;
  std::uint64_t (*value)(LinkNow const&);
};

constexpr LinkCounter link_counters[] = {
    {"lapwing_link_received_bytes", "Bytes received.", [](LinkNow const& l) { return l.bytes.bytes_received; }},
    {"lapwing_link_sent_bytes", "Bytes sent.", [](LinkNow const& l) { return l.bytes.bytes_sent; }},
    {"lapwing_link_received_frames", "MAVLink frames received.", [](LinkNow const& l) { return l.frames.frames; }},
    {"lapwing_link_crc_errors", "Frames whose checksum was wrong.",
     [](LinkNow const& l) { return l.frames.crc_errors; }},
    {"lapwing_link_unknown_frames", "Frames of messages that the dialect lacks.",
     [](LinkNow const& l) { return l.frames.unknown_ids; }},
    {"lapwing_link_junk_bytes", "Bytes that belonged to no frame.",
     [](LinkNow const& l) { return l.frames.junk_bytes; }},
    {"lapwing_link_receive_overruns", "Datagrams that the kernel dropped because its queue was full.",
     [](LinkNow const& l) { return l.bytes.overruns; }},
    {"lapwing_link_send_failures", "Datagrams or pieces of a stream that were not taken.",
     [](LinkNow const& l) { return l.bytes.send_failures; }},
};

void write_links(OpenMetrics& metrics, mavlink::Connection const& connection) {
  std::vector<LinkNow> links;
  for (std::size_t i = 0; i < connection.links().size(); ++i) {
    auto const& link = *connection.links()[i];
    links.push_back(
        {link.name(), link.state() == link::LinkState::open, link.counters(), connection.parser_counters(i)});
  }
  metrics.gauge("lapwing_link_open", "1 while the link is open.");
  for (auto const& l : links) metrics.sample({{"link", l.name}}, std::uint64_t{l.is_open});
  for (auto const& [name, help, value] : link_counters) {
    metrics.counter(name, help);
    for (auto const& l : links) metrics.sample({{"link", l.name}}, value(l));
  }
}

void write_vehicles(OpenMetrics& metrics, vehicle::Registry const& registry, base::TimePoint now) {
  auto const vehicles = registry.all();
  metrics.gauge("lapwing_vehicle_connected", "1 for a vehicle that is heard, 0 for one that is lost or in conflict.");
  for (auto const* v : vehicles)
    metrics.sample({{"vehicle", v->id.text}, {"name", v->name}},
                   std::uint64_t{v->connection == vehicle::Connection::ok});
  metrics.gauge("lapwing_vehicle_heartbeat_age_seconds", "Time since the vehicle's last heartbeat.");
  for (auto const* v : vehicles) metrics.sample({{"vehicle", v->id.text}}, base::to_seconds(now - v->heartbeat_heard));
  metrics.gauge("lapwing_vehicle_armed", "1 while the vehicle is armed.");
  for (auto const* v : vehicles) {
    if (v->armed.known()) metrics.sample({{"vehicle", v->id.text}}, std::uint64_t{*v->armed.value});
  }
  metrics.gauge("lapwing_vehicle_battery_ratio", "Charge left, 0 to 1.");
  for (auto const* v : vehicles) {
    if (v->battery.known()) metrics.sample({{"vehicle", v->id.text}}, v->battery.value->remaining);
  }
}

}  // namespace

std::string metrics_of(vehicle::Registry const& vehicles, mavlink::Connection const& connection,
                       route::Router const* forwarding) {
  OpenMetrics metrics;
  write_vehicles(metrics, vehicles, connection.loop().now());
  write_links(metrics, connection);
  if (forwarding) route::write_metrics(*forwarding, metrics);
  return metrics.text();
}

}  // namespace lapwing::apps
