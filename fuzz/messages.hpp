#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>
#include <variant>
#include <vector>

#include "mavlink/codec/codec.hpp"
#include "require.hpp"

/// What the targets that read MAVLink share.
namespace lapwing::fuzz {

/// One frame of every message that the codec knows, as our own encoder writes it.
inline std::vector<mavlink::Frame> const& sample_frames() {
  static auto const frames = [] {
    std::vector<mavlink::Frame> made;
    auto const add = [&]<std::size_t... index>(std::index_sequence<index...>) {
      (made.push_back(mavlink::encode(mavlink::Message(std::in_place_index<index>), {1, 1}, index)), ...);
    };
    add(std::make_index_sequence<std::variant_size_v<mavlink::Message>>());
    return made;
  }();
  return frames;
}

/// A message that was decoded says the same when it has been sent on.
inline void require_stable(mavlink::Frame const& frame) {
  auto const message = mavlink::decode(frame);
  if (!message) return;
  auto const once = mavlink::encode(*message, frame.source, frame.seq);
  auto const again = mavlink::decode(once);
  require(again.has_value());
  auto const first = mavlink::serialize(once);
  auto const second = mavlink::serialize(mavlink::encode(*again, frame.source, frame.seq));
  require(std::ranges::equal(first.bytes(), second.bytes()));
}

}  // namespace lapwing::fuzz
