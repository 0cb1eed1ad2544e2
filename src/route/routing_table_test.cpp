#include "route/routing_table.hpp"

#include <vector>

#include <gtest/gtest.h>

namespace lapwing::route {
namespace {

using namespace std::chrono_literals;
using mavlink::Address;
using Channels = std::vector<ChannelId>;

base::TimePoint at(base::Duration time) {
  return base::TimePoint(time);
}

Channels routes(RoutingTable const& table, Address target) {
  Channels channels;
  table.for_each(target, [&](ChannelId channel) { channels.push_back(channel); });
  return channels;
}

TEST(RoutingTable, KnowsWhereEachComponentWasHeard) {
  RoutingTable table;
  table.learn({1, 1}, 3, at(0s));
  table.learn({1, 100}, 5, at(0s));
  table.learn({2, 1}, 3, at(0s));
  EXPECT_EQ(routes(table, {1, 1}), Channels{3});
  EXPECT_EQ(routes(table, {1, 100}), Channels{5});
  EXPECT_EQ(routes(table, {1, 0}), (Channels{3, 5})) << "any component of the system";
  EXPECT_EQ(routes(table, {1, 50}), Channels{}) << "what was never heard cannot be sent to";
  EXPECT_EQ(routes(table, {9, 0}), Channels{});
  EXPECT_EQ(table.systems(), 2u);
}

TEST(RoutingTable, NamesAChannelOnceHoweverManyComponentsAreThere) {
  RoutingTable table;
  table.learn({1, 1}, 3, at(0s));
  table.learn({1, 100}, 3, at(0s));
  table.learn({1, 154}, 3, at(0s));
  EXPECT_EQ(routes(table, {1, 0}), Channels{3});
}

TEST(RoutingTable, HoldsSeveralPlacesOfOneSystem) {
  RoutingTable table;
  // Two ground stations that both call themselves 255: each must get the answers.
  table.learn({255, 190}, 1, at(0s));
  table.learn({255, 190}, 2, at(0s));
  EXPECT_EQ(routes(table, {255, 190}), (Channels{1, 2}));
}

TEST(RoutingTable, LeavesThePlaceFromWhichASystemMoved) {
  RoutingTable table;
  table.learn({1, 1}, 1, at(0s));
  table.learn({1, 1}, 2, at(5s));
  EXPECT_EQ(routes(table, {1, 1}), (Channels{1, 2}));
  table.learn({1, 1}, 2, at(10s + 1ms));
  EXPECT_EQ(routes(table, {1, 1}), Channels{2});
  table.learn({1, 1}, 1, at(11s));
  EXPECT_EQ(routes(table, {1, 1}), (Channels{1, 2})) << "it is back";
}

TEST(RoutingTable, KeepsTheOnlyPlaceOfASilentComponent) {
  RoutingTable table;
  table.learn({1, 100}, 1, at(0s));
  table.learn({1, 1}, 2, at(100s));
  EXPECT_EQ(routes(table, {1, 100}), Channels{1});
  EXPECT_EQ(routes(table, {1, 0}), (Channels{1, 2}));
}

TEST(RoutingTable, ForgetsAChannelThatIsGone) {
  RoutingTable table;
  table.learn({1, 1}, 1, at(0s));
  table.learn({1, 1}, 2, at(0s));
  table.forget(1);
  EXPECT_EQ(routes(table, {1, 1}), Channels{2});
  EXPECT_FALSE(table.reaches({1, 1}, 1));
  EXPECT_TRUE(table.reaches({1, 0}, 2));
}

TEST(RoutingTable, IsBoundedForOneSystem) {
  RoutingTable table;
  for (std::size_t i = 0; i <= RoutingTable::max_places; ++i)
    table.learn({1, 1}, static_cast<ChannelId>(i), at(i * 1ms));
  auto const channels = routes(table, {1, 1});
  EXPECT_EQ(channels.size(), RoutingTable::max_places);
  EXPECT_FALSE(table.reaches({1, 1}, 0)) << "the one heard longest ago made room";
}

TEST(RoutingTable, DoesNotLearnSystemZero) {
  RoutingTable table;
  table.learn({0, 1}, 1, at(0s));
  EXPECT_EQ(table.systems(), 0u);
}

}  // namespace
}  // namespace lapwing::route
