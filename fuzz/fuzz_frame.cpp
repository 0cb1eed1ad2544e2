// Everything that arrives on a link: the frame parser, however the stream is cut, and the codec behind it. Beyond
// memory errors it holds that a frame is written as it was read and that a decoded message is stable.
#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <span>

#include "mavlink/codec.hpp"

namespace {

using namespace lapwing::mavlink;

void require(bool holds) {
  if (!holds) std::abort();
}

void check_message(Frame const& frame) {
  auto const message = decode(frame);
  if (!message) return;
  auto const once = encode(*message, frame.source, frame.seq);
  auto const again = decode(once);
  require(again.has_value());
  auto const first = serialize(once);
  auto const second = serialize(encode(*again, frame.source, frame.seq));
  require(std::ranges::equal(first.bytes(), second.bytes()));
}

/// What was read can be forwarded: parsing its bytes gives the same frame.
void check_frame(Frame const& frame) {
  auto const written = serialize(frame);
  FrameParser parser;
  int found = 0;
  parser.feed(written.bytes(), [&](Frame const& copy) {
    ++found;
    require(copy.message_id == frame.message_id && copy.source == frame.source && copy.seq == frame.seq);
    require(frame.version == 1 || copy.payload == frame.payload);
  });
  require(found == 1 || !find_traits(frame.message_id));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(std::uint8_t const* data, std::size_t size) {
  std::span<std::uint8_t const> input(data, size);
  if (input.empty()) return 0;
  std::size_t const piece = 1U + input.front();
  input = input.subspan(1);
  FrameParser parser;
  while (!input.empty()) {
    auto const length = std::min(piece, input.size());
    parser.feed(input.first(length), [](Frame const& frame) {
      check_frame(frame);
      check_message(frame);
    });
    input = input.subspan(length);
  }
  return 0;
}
