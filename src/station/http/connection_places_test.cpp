#include "station/http/internal/connection_places.hpp"

#include <vector>

#include <gtest/gtest.h>

#include "station/messages/message_pace.hpp"

namespace lapwing::station::internal {
namespace {

using Guest = Places::Guest;
using Standing = Places::Standing;

Guest let_in(Places& places, std::string address, Standing standing = Standing::stranger) {
  auto const entrance = places.enter(std::move(address));
  EXPECT_TRUE(entrance.guest);
  places.set(*entrance.guest, standing);
  return *entrance.guest;
}

TEST(Places, AreFreeUntilAllAreTaken) {
  Places places({.all = 2, .strangers_per_address = 2});
  EXPECT_FALSE(places.enter("a").must_leave);
  EXPECT_FALSE(places.enter("b").must_leave);
  EXPECT_TRUE(places.enter("c").must_leave);
  EXPECT_EQ(places.size(), 2U);
}

TEST(Places, GoFromTheOldestStrangerToWhoComes) {
  Places places({.all = 3, .strangers_per_address = 3});
  auto const known = let_in(places, "a", Standing::resting);
  auto const oldest = let_in(places, "a");
  let_in(places, "a");
  EXPECT_EQ(places.enter("a").must_leave, oldest);
  (void)known;
}

TEST(Places, GoFromWhoSaidSomethingBeforeWhoJustCame) {
  Places places({.all = 3, .strangers_per_address = 3});
  auto const newcomer = let_in(places, "a", Standing::newcomer);
  auto const heard_first = let_in(places, "a");
  let_in(places, "a");
  EXPECT_EQ(places.enter("a").must_leave, heard_first);
  for (int i = 0; i < 50; ++i) let_in(places, "a");
  EXPECT_NE(places.enter("a").must_leave, newcomer);
}

TEST(Places, GoFromTheFirstNewcomerWhereNobodySaidAnything) {
  Places places({.all = 100, .strangers_per_address = 2});
  auto const first = let_in(places, "a", Standing::newcomer);
  let_in(places, "a", Standing::newcomer);
  EXPECT_EQ(places.enter("a").must_leave, first);
}

TEST(Places, GoFromTheLargestCrowdAndNotFromWhoStandsAlone) {
  Places places({.all = 4, .strangers_per_address = 4});
  let_in(places, "operator");
  auto const first_of_crowd = let_in(places, "crowd");
  let_in(places, "crowd");
  let_in(places, "crowd");
  EXPECT_EQ(places.enter("crowd").must_leave, first_of_crowd);
}

TEST(Places, OfWhoRestsGoOnlyWhenThereIsNoStranger) {
  Places places({.all = 2, .strangers_per_address = 2});
  auto const rested_longest = let_in(places, "a", Standing::resting);
  let_in(places, "a", Standing::resting);
  EXPECT_EQ(places.enter("b").must_leave, rested_longest);
}

TEST(Places, OfWhoIsServedStayTheirs) {
  Places places({.all = 2, .strangers_per_address = 2});
  let_in(places, "a", Standing::served);
  let_in(places, "a", Standing::served);
  auto const refused = places.enter("b");
  EXPECT_FALSE(refused.guest || refused.must_leave);
  EXPECT_EQ(places.size(), 2U);
}

TEST(Places, OfStrangersAreFewForEachAddressEvenWhenThereIsRoom) {
  Places places({.all = 100, .strangers_per_address = 3});
  auto const first = let_in(places, "crowd");
  for (int i = 0; i < 2; ++i) let_in(places, "crowd");
  EXPECT_EQ(places.enter("crowd").must_leave, first);
  EXPECT_FALSE(places.enter("operator").must_leave);
  EXPECT_EQ(places.size(), 4U);
}

TEST(Places, OfAnAddressThatProvedItselfAreNotCountedAsStrangers) {
  Places places({.all = 100, .strangers_per_address = 3});
  for (int i = 0; i < 50; ++i) let_in(places, "proxy", i % 2 == 0 ? Standing::resting : Standing::served);
  EXPECT_EQ(places.size(), 50U);
}

TEST(Places, GoRoundByWhoRestedLast) {
  Places places({.all = 2, .strangers_per_address = 2});
  auto const early = let_in(places, "a", Standing::resting);
  auto const late = let_in(places, "a", Standing::resting);
  places.set(early, Standing::served);
  places.set(early, Standing::resting);
  EXPECT_EQ(places.enter("a").must_leave, late);
}

TEST(Places, ForgetWhoLeft) {
  Places places({.all = 1, .strangers_per_address = 1});
  auto const gone = let_in(places, "a");
  places.leave(gone);
  places.set(gone, Standing::served);
  places.leave(gone);
  EXPECT_EQ(places.size(), 0U);
  EXPECT_FALSE(places.enter("a").must_leave);
}

TEST(MessagePace, MakesOnlyThoseWaitWhoAskFasterThanAnybodyWould) {
  using namespace std::chrono_literals;
  MessagePace pace;
  auto now = MessagePace::Clock::time_point(1h);
  for (int i = 0; i < 1000; ++i) EXPECT_EQ(pace.take(now), 0ms) << i;
  EXPECT_EQ(pace.take(now), MessagePace::rest);
  now += 20ms;
  for (int i = 0; i < 8; ++i) EXPECT_EQ(pace.take(now), 0ms) << i;
  now += 10s;
  for (int i = 0; i < 4000; ++i) EXPECT_EQ(pace.take(now += 2ms), 0ms) << "500 a second for ever";
}

}  // namespace
}  // namespace lapwing::station::internal
