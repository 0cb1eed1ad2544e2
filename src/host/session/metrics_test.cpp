#include "host/session/metrics.hpp"

#include <gtest/gtest.h>

namespace lapwing::host {
namespace {

using namespace std::chrono_literals;

TEST(Metrics, TellWhatLinksAndTheirSourcesLose) {
  base::Loop loop({.unpaced = true});
  vehicle::Registry const vehicles(loop);
  mavlink::LinkReport wifi;
  wifi.name = "udpin://0.0.0.0:14550";
  wifi.state = link::LinkState::open;
  wifi.bytes.perishable_dropped = 7;
  wifi.frames.crc_errors = 3;
  wifi.impossible_values.push_back({"GLOBAL_POSITION_INT", "lat", 12});
  auto& copter = wifi.sources.emplace_back();
  copter.source = {1, 1};
  copter.address = "10.0.0.2:14555";
  copter.counters.lost = 10;
  copter.round_trip = 120ms;
  copter.age = 500ms;
  auto const text = metrics_of(vehicles, std::vector{wifi}, {}, loop.now());
  auto const has = [&text](std::string const& line) { return text.contains(line + "\n"); };
  EXPECT_TRUE(has("lapwing_link_open{link=\"udpin://0.0.0.0:14550\"} 1")) << text;
  EXPECT_TRUE(has("lapwing_link_crc_errors_total{link=\"udpin://0.0.0.0:14550\"} 3"));
  EXPECT_TRUE(has("lapwing_link_perishable_dropped_total{link=\"udpin://0.0.0.0:14550\"} 7"));
  EXPECT_TRUE(
      has("lapwing_link_impossible_values_total{link=\"udpin://0.0.0.0:14550\",message=\"GLOBAL_POSITION_INT\","
          "field=\"lat\"} 12"));
  std::string const who = "{link=\"udpin://0.0.0.0:14550\",address=\"10.0.0.2:14555\",system=\"1\",component=\"1\"}";
  EXPECT_TRUE(has("lapwing_source_lost_total" + who + " 10")) << text;
  EXPECT_TRUE(has("lapwing_source_round_trip_seconds" + who + " 0.12"));
  EXPECT_TRUE(has("lapwing_source_age_seconds" + who + " 0.5"));
}

}  // namespace
}  // namespace lapwing::host
