#include "station/feeds/envelope.hpp"

#include <gtest/gtest.h>

namespace lapwing::station {
namespace {

TEST(Envelope, AddsKeysToTexts) {
  EXPECT_EQ(in_envelope({.content = R"({"type":"log"})"}, {.feed = "log", .feed_id = 5, .revision = 7}),
            R"({"type":"log","feed":"log","revision":7})");
  EXPECT_EQ(in_envelope({.content = R"({"a":{}})"}, {.feed = "log", .revision = 7, .begins_whole = true}),
            R"({"a":{},"feed":"log","revision":7,"whole":true})");
}

TEST(Envelope, PutsAHeaderBeforeBytes) {
  auto const bytes = in_envelope({.content = "xy", .is_binary = true},
                                 {.feed = "map", .feed_id = 0x0203, .revision = 0x010203040506, .begins_whole = true});
  EXPECT_EQ(bytes, std::string("\x01\x01\x03\x02\0\0\0\0\x06\x05\x04\x03\x02\x01\0\0xy", binary_header_size + 2));
  EXPECT_EQ(in_envelope({.content = "", .is_binary = true}, {.feed = "map", .feed_id = 1}),
            std::string("\x01\0\x01\0\0\0\0\0\0\0\0\0\0\0\0\0", binary_header_size));
}

}  // namespace
}  // namespace lapwing::station
