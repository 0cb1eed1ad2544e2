#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include "mavlink/wire/frame.hpp"

/// Frames as their bytes and back, for tests.
namespace lapwing::mavlink::testing {

using Data = std::vector<std::uint8_t>;

/// The one frame that these bytes are.
inline Frame parsed(Data const& bytes) {
  Frame result;
  FrameParser parser;
  parser.feed(bytes, [&](Frame const& frame) { result = frame; });
  EXPECT_EQ(parser.counters().frames, 1u);
  return result;
}

inline Data bytes_of(Frame const& frame) {
  auto const out = serialize(frame);
  return {out.bytes().begin(), out.bytes().end()};
}

}  // namespace lapwing::mavlink::testing
