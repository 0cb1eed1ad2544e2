#include "onboard/decide/lateness.hpp"

#include <chrono>

#include <gtest/gtest.h>

namespace lapwing::onboard {
namespace {

using namespace std::chrono_literals;

TEST(Lateness, TellsByWhenThatShareOfTheFramesHadBegun) {
  Lateness lateness;
  for (int i = 0; i < 98; ++i) lateness.add(250us);
  lateness.add(4ms);
  lateness.add(30ms);
  EXPECT_EQ(lateness.frames(), 100u);
  EXPECT_EQ(lateness.quantile(0.5), 300us);
  EXPECT_EQ(lateness.quantile(0.99), 4100us);
  EXPECT_EQ(lateness.quantile(1.0), 30ms);
  EXPECT_EQ(to_string(lateness),
            "100 frames, late by 0.3 ms in the middle, 4.1 ms at the 99th percentile, 30.0 ms at most");
}

TEST(Lateness, CountsFramesThatBeginFarTooLateOrEarly) {
  Lateness lateness;
  lateness.add(-1ms);
  EXPECT_EQ(lateness.most(), 0ms);
  lateness.add(5s);
  EXPECT_EQ(lateness.quantile(0.99), 5s);
}

TEST(Lateness, OfNoFrameIsNone) {
  EXPECT_EQ(Lateness().quantile(0.99), 0ms);
}

}  // namespace
}  // namespace lapwing::onboard
