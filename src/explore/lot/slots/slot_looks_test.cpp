#include "explore/lot/slots/slot_looks.hpp"

#include <algorithm>
#include <random>

#include <gtest/gtest.h>

#include "explore/lot/belief.hpp"
#include "explore/testing/lot_pictures.hpp"

namespace lapwing::explore {
namespace {

using testing::after;

constexpr Turnover turnover = {};
constexpr Independence independence = {};

Look look(double seconds, double x, double log_likelihood) {
  return {.at = after(seconds), .from = {x, 0.0, 20.0}, .log_likelihood = log_likelihood, .by = "drone 1"};
}

double chance(std::vector<Look> const& looks, double seconds) {
  SlotLooks all;
  for (auto const& one : looks) all.add(one);
  return all.taken_chance(after(seconds), turnover, independence);
}

TEST(SlotLooks, WithoutLooksItIsTakenAsOftenAsSlotsAre) {
  EXPECT_DOUBLE_EQ(chance({}, 0.0), turnover.taken_share);
  EXPECT_EQ(SlotLooks().newest(), nullptr);
}

TEST(SlotLooks, OneLookIsBayesRule) {
  EXPECT_NEAR(chance({look(0.0, 0.0, log_odds_of(0.9))}, 0.0), 0.9, 1e-12);
  EXPECT_NEAR(chance({look(0.0, 0.0, log_odds_of(0.9)), look(0.0, 50.0, log_odds_of(0.9))}, 0.0), 81.0 / 82.0, 1e-12);
}

TEST(SlotLooks, TheSameLookTwiceSaysNothingNew) {
  auto const one = chance({look(0.0, 0.0, 2.0)}, 0.0);
  EXPECT_NEAR(chance({look(0.0, 0.0, 2.0), look(0.0, 0.0, 2.0)}, 0.0), one, 1e-12);
  EXPECT_GT(chance({look(0.0, 0.0, 2.0), look(0.0, 10.0, 2.0)}, 0.0), one);
}

TEST(SlotLooks, OrderOfArrivalDoesNotMatter) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> number(-3.0, 3.0);
  std::vector<Look> looks;
  for (int i = 0; i < 12; ++i) looks.push_back(look(40.0 * (i % 5), 17.0 * i, number(random)));
  auto const in_order = chance(looks, 300.0);
  for (int i = 0; i < 50; ++i) {
    std::ranges::shuffle(looks, random);
    EXPECT_NEAR(chance(looks, 300.0), in_order, 1e-12);
  }
}

TEST(SlotLooks, WhatIsOldFadesAndIsForgottenInTheEnd) {
  std::vector<Look> const looks = {look(0.0, 0.0, 4.0)};
  double before = chance(looks, 0.0);
  double const memory_s = base::to_seconds(turnover.memory);
  EXPECT_NEAR(chance(looks, memory_s) - 0.5, (before - 0.5) * std::exp(-1.0), 1e-9);
  for (double seconds = 60.0; seconds < 4.0 * memory_s; seconds += 600.0) {
    auto const now = chance(looks, seconds);
    EXPECT_LT(now, before);
    EXPECT_GT(now, turnover.taken_share);
    before = now;
  }
  EXPECT_NEAR(chance(looks, 20.0 * memory_s), turnover.taken_share, 1e-6);
}

TEST(SlotLooks, TheNewerOfTwoThatDisagreeCountsMoreTheLongerAgoTheOtherWas) {
  auto const soon = chance({look(0.0, 0.0, 4.0), look(10.0, 10.0, -4.0)}, 10.0);
  auto const late = chance({look(0.0, 0.0, 4.0), look(3600.0, 10.0, -4.0)}, 3600.0);
  EXPECT_NEAR(soon, 0.5, 0.1);
  EXPECT_LT(late, 0.06);
}

TEST(SlotLooks, AChanceStaysOneHoweverSureAndManyTheLooks) {
  SlotLooks looks;
  for (int i = 0; i < 500; ++i) {
    looks.add(look(i, 10.0 * i, 50.0));
    looks.fold(turnover, independence);
    auto const now = looks.taken_chance(after(i), turnover, independence);
    EXPECT_GT(now, 0.5);
    EXPECT_LE(now, 1.0);
  }
  looks.add(look(501.0, 9000.0, -50.0));
  EXPECT_LT(looks.taken_chance(after(501.0), turnover, independence), 0.01);
}

TEST(SlotLooks, ADetectorThatErrsForMinutesFromOnePlaceIsNotBelievedMore) {
  SlotLooks looks;
  for (int i = 0; i < 300; ++i) {
    auto one = look(0.2 * i, 0.0, 2.0);
    if (looks.novelty_of(one, independence) < least_novelty) continue;
    looks.add(std::move(one));
    looks.fold(turnover, independence);
  }
  EXPECT_LT(looks.taken_chance(after(60.0), turnover, independence), chance_of(2.0 * 2.0));
}

TEST(SlotLooks, WhatIsOlderThanWhatWasFoldedIsNotTaken) {
  SlotLooks looks;
  for (int i = 0; i < 40; ++i) EXPECT_TRUE(looks.add(look(100.0 + 10.0 * i, 10.0 * i, 1.0)));
  looks.fold(turnover, independence);
  EXPECT_FALSE(looks.add(look(0.0, 0.0, 1.0)));
  EXPECT_TRUE(looks.add(look(480.0, 7.0, 1.0)));
}

TEST(Belief, ExpectedBitsAreThoseOfABinaryChannel) {
  EXPECT_DOUBLE_EQ(expected_bits(0.5, 0.0), 1.0);
  EXPECT_NEAR(expected_bits(0.5, 0.5), 0.0, 1e-12);
  EXPECT_NEAR(expected_bits(0.5, 0.11), 0.5, 1e-3);  // the classic: a channel that errs 11 times in 100 carries half
  for (double p = 0.0; p <= 1.0; p += 0.05) {
    EXPECT_GE(expected_bits(p, 0.03), 0.0);
    EXPECT_LE(expected_bits(p, 0.03), entropy_bits(p) + 1e-12);
  }
}

}  // namespace
}  // namespace lapwing::explore
