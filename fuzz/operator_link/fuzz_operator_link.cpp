// Both readers of the operator link's streams. The first byte says which, and in which pieces the rest comes: what is
// read must not depend on them, and what was read as a frame's content can be written and read again.
#include <cstdint>
#include <string>
#include <vector>

#include "link/operator_link/wire/json_objects.hpp"
#include "link/operator_link/wire/protocol.hpp"
#include "require.hpp"

using namespace lapwing;
using namespace lapwing::link::operator_link;

namespace {

constexpr std::size_t longest_object = 200;

/// What a reader made of the stream, as texts; its fault is the last.
std::vector<std::string> frames(link::Bytes stream, std::size_t piece) {
  std::vector<std::string> found;
  FrameReader reader;
  for (std::size_t at = 0; at < stream.size(); at += piece) {
    reader.feed(stream.subspan(at, std::min(piece, stream.size() - at)));
    for (;;) {
      auto const frame = reader.next();
      if (!frame) {
        fuzz::require(!frame.error().message.empty());
        found.push_back(frame.error().message);
        return found;
      }
      if (!*frame) break;
      found.emplace_back((*frame)->body.begin(), (*frame)->body.end());
      auto const speech = read(**frame);
      if (!speech || !*speech) continue;
      auto const* const hello = std::get_if<Hello>(&**speech);
      if (hello != nullptr && hello->version != protocol_version) continue;
      std::vector<std::uint8_t> again;
      write(again, **speech);
      fuzz::require(std::ranges::equal(link::Bytes(again).subspan(frame_header_bytes), (*frame)->body));
    }
  }
  return found;
}

std::vector<std::string> objects(link::Bytes stream, std::size_t piece) {
  std::vector<std::string> found;
  JsonObjects reader(longest_object);
  for (std::size_t at = 0; at < stream.size(); at += piece) {
    reader.feed(stream.subspan(at, std::min(piece, stream.size() - at)));
    while (auto const item = reader.next()) {
      fuzz::require(!*item || ((*item)->size() <= longest_object && (*item)->front() == '{' && (*item)->back() == '}'));
      found.push_back(*item ? **item : "!" + item->error());
    }
  }
  return found;
}

/// Frames with their CRCs put right, so that what stands in them is reached: a length is a byte of the input.
std::vector<std::uint8_t> framed(link::Bytes input) {
  std::vector<std::uint8_t> stream;
  while (input.size() >= 2) {
    auto const size = std::min<std::size_t>(input[1], input.size() - 2);
    write_frame(stream, static_cast<FrameType>(input[0]), input.subspan(2, size));
    input = input.subspan(2 + size);
  }
  return stream;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(std::uint8_t const* data, std::size_t size) {
  if (size == 0) return 0;
  link::Bytes const input(data + 1, size - 1);
  auto const piece = std::size_t{1} + data[0] / 4;
  auto const whole = std::max<std::size_t>(input.size(), 1);
  switch (data[0] % 4) {
    case 0: fuzz::require(frames(input, piece) == frames(input, whole)); break;
    case 1: {
      auto const stream = framed(input);
      fuzz::require(frames(stream, piece) == frames(stream, std::max<std::size_t>(stream.size(), 1)));
      break;
    }
    default: fuzz::require(objects(input, piece) == objects(input, whole));
  }
  return 0;
}
