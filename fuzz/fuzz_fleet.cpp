// Any messages from vehicles and strangers, well-formed as frames, against a ground station's fleet in virtual time.
// An input is a row of messages: which one, length of its payload, payload.
#include <array>
#include <cstdint>
#include <span>

#include "fleet/fleet.hpp"
#include "link/pipe_link.hpp"
#include "messages.hpp"
#include "vehicle/registry.hpp"

using namespace lapwing;

namespace {

base::Task<void> send(base::Loop& loop, link::ByteLink& peer, std::span<std::uint8_t const> input) {
  auto const& samples = fuzz::sample_frames();
  std::uint8_t seq = 0;
  while (input.size() >= 2) {
    auto frame = samples[input[0] % samples.size()];
    auto const length = std::min<std::size_t>(input[1], input.size() - 2);
    frame.source = {static_cast<std::uint8_t>(1 + input[0] / samples.size()), 1};
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
  vehicle::Registry registry;
  fleet::Fleet fleet(connection, registry, {}, {});
  loop.run_until_done(send(loop, *pipe.b, {data, size}));
  fuzz::require(fleet.all().size() <= 255);
  return 0;
}
