#include "fleet/network/telemetry_rate.hpp"

#include <gtest/gtest.h>

namespace lapwing::fleet {
namespace {

using namespace std::chrono_literals;

/// A link that carries `received` of every hundred messages, for so long.
int watch(TelemetryRate& telemetry_rate, int received, std::optional<double> buffer_free, base::Duration from,
          base::Duration time) {
  for (auto second = from; second <= from + time; second += 1s) {
    auto const sent = static_cast<std::uint64_t>(second / 1s) * 100;
    auto const came = sent * static_cast<std::uint64_t>(received) / 100;
    telemetry_rate.update(came, sent - came, buffer_free, base::TimePoint(second));
  }
  return telemetry_rate.factor();
}

TEST(TelemetryRate, AsksAsUsualOnAGoodLink) {
  TelemetryRate telemetry_rate;
  EXPECT_EQ(watch(telemetry_rate, 98, std::nullopt, 0s, 120s), 1);
}

TEST(TelemetryRate, AsksForLessWhileMuchIsLost) {
  TelemetryRate telemetry_rate;
  EXPECT_EQ(watch(telemetry_rate, 60, std::nullopt, 0s, 10s), 2);
  EXPECT_EQ(watch(telemetry_rate, 60, std::nullopt, 11s, 60s), 4);
}

TEST(TelemetryRate, AsksForLessWhileTheRadiosBufferIsFull) {
  TelemetryRate telemetry_rate;
  EXPECT_EQ(watch(telemetry_rate, 100, 0.2, 0s, 10s), 2);
  EXPECT_EQ(watch(telemetry_rate, 100, 0.5, 11s, 60s), 2);  // neither full nor roomy
}

TEST(TelemetryRate, TrustsALinkAgainSlowly) {
  TelemetryRate telemetry_rate;
  (void)watch(telemetry_rate, 100, 0.1, 0s, 20s);
  EXPECT_EQ(telemetry_rate.factor(), 4);
  EXPECT_EQ(watch(telemetry_rate, 100, 0.9, 21s, 15s), 4);
  EXPECT_EQ(watch(telemetry_rate, 100, 0.9, 37s, 20s), 2);
  EXPECT_EQ(watch(telemetry_rate, 100, 0.9, 58s, 40s), 1);
}

TEST(TelemetryRate, MakesNothingOfFewMessagesAndOfCountersThatBeginAnew) {
  TelemetryRate telemetry_rate;
  telemetry_rate.update(1000, 900, std::nullopt, base::TimePoint(0s));
  telemetry_rate.update(0, 0, std::nullopt, base::TimePoint(10s));
  telemetry_rate.update(1, 9, std::nullopt, base::TimePoint(20s));
  EXPECT_EQ(telemetry_rate.factor(), 1);
}

}  // namespace
}  // namespace lapwing::fleet
