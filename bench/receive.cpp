// The whole way of a message through a connection: bytes of a far end, frame, route, decoded message, subscriber. Each
// of the vehicles sends from an address of its own, one datagram a message, as they do in the field.

#include <string>
#include <vector>

#include <benchmark/benchmark.h>

#include "base/async/loop.hpp"
#include "mavlink/connection/connection.hpp"

namespace lapwing::bench {
namespace {

/// A link whose datagrams are handed in.
class Feed final : public link::ByteLink {
 public:
  [[nodiscard]] std::string name() const override { return "feed"; }
  [[nodiscard]] std::string peer_name(link::Peer) const override { return "feed"; }
  void start(Receive receive) override { hand_in = std::move(receive); }
  bool send(link::Peer, link::Bytes, link::Urgency) override { return true; }
  [[nodiscard]] std::vector<link::Peer> standing_peers() const override { return {}; }
  [[nodiscard]] link::LinkState state() const override { return link::LinkState::open; }
  [[nodiscard]] std::string last_error() const override { return {}; }
  [[nodiscard]] link::LinkCounters counters() const override { return {}; }

  Receive hand_in;
};

/// Every sequence number of each vehicle, so that going round is going on.
std::vector<mavlink::FrameBytes> datagrams(int vehicles) {
  std::vector<mavlink::FrameBytes> all;
  for (int seq = 0; seq < 256; ++seq) {
    for (int vehicle = 1; vehicle <= vehicles; ++vehicle) {
      mavlink::Message message = mavlink::Attitude{.since_boot = std::chrono::milliseconds(seq), .yaw_rad = 1.0};
      if (seq % 2 == 1) message = mavlink::GlobalPosition{.position = geo::Wgs84::from_degrees(41.178, -8.598, 120.0)};
      all.push_back(mavlink::serialize(
          mavlink::encode(message, {static_cast<std::uint8_t>(vehicle), 1}, static_cast<std::uint8_t>(seq))));
    }
  }
  return all;
}

void receive(benchmark::State& state) {
  auto const vehicles = static_cast<int>(state.range(0));
  base::Loop loop({.unpaced = true});
  mavlink::Connection connection(loop, {.heartbeat = {}}, {});
  auto feed = std::make_unique<Feed>();
  auto const& link = *feed;
  connection.add_link(std::move(feed));
  std::size_t heard = 0;
  auto const subscription = connection.subscribe([&heard](mavlink::Received const&) { ++heard; });
  auto const bytes = datagrams(vehicles);
  for ([[maybe_unused]] auto _ : state)
    for (std::size_t i = 0; i < bytes.size(); ++i)
      link.hand_in(link::Peer{i % static_cast<std::size_t>(vehicles)}, bytes[i].bytes());
  if (heard != bytes.size() * state.iterations()) state.SkipWithError("messages were lost");
  state.SetItemsProcessed(static_cast<std::int64_t>(heard));
}
BENCHMARK(receive)->Arg(1)->Arg(100);

}  // namespace
}  // namespace lapwing::bench

BENCHMARK_MAIN();
