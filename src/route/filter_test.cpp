#include "route/filter.hpp"

#include <gtest/gtest.h>

#include "route/test_packets.hpp"

namespace lapwing::route {
namespace {

bool passes(Filter const& filter, Packet const& packet) {
  return filter.passes(packet.view());
}

TEST(Filter, LetsEverythingPassThatNobodySpokeOf) {
  EXPECT_TRUE(passes({}, packet("HEARTBEAT")));
  EXPECT_TRUE(passes({}, unknown_packet(70'000)));
}

TEST(Filter, BlocksMessages) {
  Filter filter;
  filter.block_message(0);
  filter.block_message(70'000);
  EXPECT_FALSE(passes(filter, packet("HEARTBEAT")));
  EXPECT_FALSE(passes(filter, unknown_packet(70'000)));
  EXPECT_TRUE(passes(filter, packet("ATTITUDE")));
}

TEST(Filter, AllowsTheseMessagesAndNoOthers) {
  Filter filter;
  filter.allow_message(30);
  filter.allow_message(0);
  EXPECT_TRUE(passes(filter, packet("HEARTBEAT")));
  EXPECT_TRUE(passes(filter, packet("ATTITUDE")));
  EXPECT_FALSE(passes(filter, packet("VFR_HUD")));
}

TEST(Filter, LooksAtTheSendersSystemAndComponent) {
  Filter filter;
  filter.allow_system(1);
  filter.allow_system(2);
  filter.block_component(100);
  EXPECT_TRUE(passes(filter, packet("HEARTBEAT", {.source = {1, 1}})));
  EXPECT_TRUE(passes(filter, packet("HEARTBEAT", {.source = {2, 1}})));
  EXPECT_FALSE(passes(filter, packet("HEARTBEAT", {.source = {3, 1}})));
  EXPECT_FALSE(passes(filter, packet("HEARTBEAT", {.source = {1, 100}})));
}

TEST(Filter, BlocksWhatIsBothAllowedAndBlocked) {
  Filter filter;
  filter.allow_system(1);
  filter.block_system(1);
  filter.allow_component(1);
  EXPECT_FALSE(passes(filter, packet("HEARTBEAT")));
}

}  // namespace
}  // namespace lapwing::route
