#include "route/metrics.hpp"

#include <functional>
#include <span>

namespace lapwing::route {

namespace {

using Status = EndpointStatus;
using Value = std::uint64_t (*)(Status const&);

struct Reason {
  std::string_view direction;
  std::string_view reason;
  Value value;
};

/// Every way in which a frame, or a datagram of the link, can get lost.
constexpr Reason drops[] = {
    {"in", "filtered", [](Status const& s) { return s.counters.in.filtered; }},
    {"in", "read_only", [](Status const& s) { return s.counters.in.read_only; }},
    {"in", "duplicate", [](Status const& s) { return s.counters.in.duplicates; }},
    {"in", "unroutable", [](Status const& s) { return s.counters.in.unroutable; }},
    {"out", "filtered", [](Status const& s) { return s.counters.out.filtered; }},
    {"out", "superseded", [](Status const& s) { return s.counters.out.superseded; }},
    {"out", "overflowed", [](Status const& s) { return s.counters.out.overflowed; }},
    {"out", "expired", [](Status const& s) { return s.counters.out.expired; }},
    {"out", "refused", [](Status const& s) { return s.counters.out.refused; }},
    {"out", "abandoned", [](Status const& s) { return s.counters.out.abandoned; }},
};

struct Direction {
  std::string_view direction;
  Value value;
};

struct Counter {
  std::string_view name;
  std::string_view help;
  std::vector<Direction> by_direction;
};

Counter const traffic[] = {
    {"lapwing_router_frames",
     "MAVLink frames received from and given to an endpoint.",
     {{"in", [](Status const& s) { return s.counters.in.frames; }},
      {"out", [](Status const& s) { return s.counters.out.frames; }}}},
    {"lapwing_router_frame_bytes",
     "Bytes of those frames.",
     {{"in", [](Status const& s) { return s.counters.in.bytes; }},
      {"out", [](Status const& s) { return s.counters.out.bytes; }}}},
};

struct Plain {
  std::string_view name;
  std::string_view help;
  Value value;
};

constexpr Plain counters[] = {
    {"lapwing_router_crc_errors", "Frames whose checksum was wrong.",
     [](Status const& s) { return s.parser.crc_errors; }},
    {"lapwing_router_unknown_frames", "Frames of messages that the dialect lacks; they are passed on.",
     [](Status const& s) { return s.parser.unknown_ids; }},
    {"lapwing_router_junk_bytes", "Bytes received that belonged to no frame.",
     [](Status const& s) { return s.parser.junk_bytes; }},
    {"lapwing_router_receive_overruns", "Datagrams that the kernel dropped because its queue was full.",
     [](Status const& s) { return s.link.overruns; }},
    {"lapwing_router_perishable_drops",
     "Pieces of a stream, of up to 1400 bytes, that waited for 3 s in its queue or made room for newer ones.",
     [](Status const& s) { return s.link.perishable_dropped; }},
    {"lapwing_router_send_failures", "Datagrams or pieces of a stream that the operating system did not take.",
     [](Status const& s) { return s.link.send_failures; }},
};

constexpr Plain gauges[] = {
    {"lapwing_router_far_ends", "Programs and vehicles that the endpoint speaks with.",
     [](Status const& s) { return static_cast<std::uint64_t>(s.far_ends); }},
    {"lapwing_router_waiting_frames", "Frames that wait for the endpoint's rate limit.",
     [](Status const& s) { return static_cast<std::uint64_t>(s.waiting); }},
    {"lapwing_router_link_open", "1 while the endpoint's link is open.",
     [](Status const& s) { return std::uint64_t{s.state == link::LinkState::open}; }},
};

}  // namespace

void write_metrics(std::span<Router const* const> routers, base::OpenMetrics& metrics) {
  std::vector<Status> endpoints;
  std::uint64_t systems = 0;
  for (auto const* router : routers) {
    for (auto& status : router->status()) endpoints.push_back(std::move(status));
    systems += router->systems();
  }
  for (auto const& [name, help, by_direction] : traffic) {
    metrics.counter(name, help);
    for (auto const& s : endpoints) {
      for (auto const& [direction, value] : by_direction)
        metrics.sample({{"endpoint", s.name}, {"direction", direction}}, value(s));
    }
  }
  metrics.counter("lapwing_router_dropped_frames", "Frames that were not passed on, by reason.");
  for (auto const& s : endpoints) {
    for (auto const& [direction, reason, value] : drops)
      metrics.sample({{"endpoint", s.name}, {"direction", direction}, {"reason", reason}}, value(s));
  }
  for (auto const& [name, help, value] : counters) {
    metrics.counter(name, help);
    for (auto const& s : endpoints) metrics.sample({{"endpoint", s.name}}, value(s));
  }
  for (auto const& [name, help, value] : gauges) {
    metrics.gauge(name, help);
    for (auto const& s : endpoints) metrics.sample({{"endpoint", s.name}}, value(s));
  }
  metrics.gauge("lapwing_router_systems", "MAVLink systems that were heard.");
  metrics.sample({}, systems);
}

}  // namespace lapwing::route
