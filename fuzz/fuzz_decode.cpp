// Any payload of any message that the codec knows: a frame's checksum would keep a fuzzer out. The first byte chooses
// the message.
#include <cstdint>
#include <span>

#include "messages.hpp"

using namespace lapwing;

extern "C" int LLVMFuzzerTestOneInput(std::uint8_t const* data, std::size_t size) {
  if (size == 0) return 0;
  auto const& samples = fuzz::sample_frames();
  auto frame = samples[data[0] % samples.size()];
  auto const payload = std::span(data, size).subspan(1).first(std::min(size - 1, frame.payload.size()));
  frame.payload.fill(0);
  std::ranges::copy(payload, frame.payload.begin());
  fuzz::require_stable(frame);
  return 0;
}
