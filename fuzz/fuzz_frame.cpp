// Everything that arrives on a link: the frame parser, however the stream is cut, and the codec behind it. Beyond
// memory errors it holds that a frame is written as it was read and that a decoded message is stable.
#include <algorithm>
#include <cstdint>
#include <span>

#include "messages.hpp"

namespace {

using namespace lapwing;
using mavlink::Frame;

/// What was read can be forwarded: parsing its bytes gives the same frame.
void require_forwardable(Frame const& frame) {
  if (!mavlink::find_traits(frame.message_id)) return;
  auto const written = mavlink::serialize(frame);
  mavlink::FrameParser parser;
  int found = 0;
  parser.feed(written.bytes(), [&](Frame const& copy) {
    ++found;
    fuzz::require(copy.message_id == frame.message_id && copy.source == frame.source && copy.seq == frame.seq);
    fuzz::require(frame.version == 1 || copy.payload == frame.payload);
  });
  fuzz::require(found == 1);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(std::uint8_t const* data, std::size_t size) {
  std::span<std::uint8_t const> input(data, size);
  if (input.empty()) return 0;
  std::size_t const piece = 1U + input.front();
  input = input.subspan(1);
  mavlink::FrameParser parser;
  while (!input.empty()) {
    auto const length = std::min(piece, input.size());
    parser.feed(input.first(length), [](Frame const& frame) {
      require_forwardable(frame);
      fuzz::require_stable(frame);
    });
    input = input.subspan(length);
  }
  return 0;
}
