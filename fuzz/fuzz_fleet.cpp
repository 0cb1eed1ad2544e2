// Any messages from vehicles and strangers, well-formed as frames, against a ground station's fleet in virtual time.
// An input is a row of messages: which one, length of its payload, payload.
#include <array>
#include <cstdint>
#include <span>

#include "fleet/network/fleet.hpp"
#include "link/pipe_link.hpp"
#include "messages.hpp"
#include "vehicle/registry.hpp"

using namespace lapwing;

namespace {

/// Two vehicles, what one of them carries, and a radio.
constexpr auto senders = std::to_array<mavlink::Address>({{1, 1}, {1, 100}, {1, 154}, {2, 1}, {51, 68}});

base::Task<void> send(base::Loop& loop, link::ByteLink& peer, std::span<std::uint8_t const> input) {
  auto const& samples = fuzz::sample_frames();
  std::uint8_t seq = 0;
  while (input.size() >= 2) {
    auto frame = samples[input[0] % samples.size()];
    auto const length = std::min<std::size_t>(input[1], input.size() - 2);
    frame.source = senders[input[0] / samples.size() % senders.size()];
    frame.seq = seq++;
    frame.payload.fill(0);
    std::ranges::copy(input.subspan(2, length), frame.payload.begin());
    (void)peer.send(peer.standing_peers().front(), mavlink::serialize(frame).bytes());
    input = input.subspan(2 + length);
    co_await loop.sleep(std::chrono::milliseconds(100));
  }
  co_await loop.sleep(std::chrono::seconds(10));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(std::uint8_t const* data, std::size_t size) {
  base::Loop loop({.unpaced = true});
  auto pipe = link::make_pipe(loop);
  mavlink::Connection connection(loop, {}, {});
  connection.add_link(std::move(pipe.a));
  pipe.b->start([](link::Peer, link::Bytes) {});
  vehicle::Registry registry(loop);
  vehicle::Authority authority(loop, registry, {});
  fleet::Fleet fleet(connection, registry, authority, {}, {});
  loop.run_until_done(send(loop, *pipe.b, {data, size}));
  fuzz::require(fleet.all().size() <= 255);
  for (auto const* state : registry.all()) {
    fuzz::require(state->payload.components.size() <= 32 && state->arming.reasons.size() <= 20);
    fuzz::require(!state->payload.pictures.value || state->payload.pictures.value->recent.size() <= 2000);
  }
  return 0;
}
