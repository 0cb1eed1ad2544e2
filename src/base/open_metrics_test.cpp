#include "base/open_metrics.hpp"

#include <limits>

#include <gtest/gtest.h>

namespace lapwing::base {
namespace {

TEST(OpenMetrics, WritesFamiliesWithTheirSamplesAndTheEnd) {
  OpenMetrics metrics;
  metrics.counter("lapwing_frames", "Frames that came in.");
  metrics.sample({{"endpoint", "radio"}, {"direction", "in"}}, std::uint64_t{18'446'744'073'709'551'615ULL});
  metrics.sample({{"endpoint", "wifi"}, {"direction", "in"}}, std::uint64_t{0});
  metrics.gauge("lapwing_battery_ratio", "What is left.");
  metrics.sample({}, 0.25);
  EXPECT_EQ(metrics.text(),
            "# TYPE lapwing_frames counter\n"
            "# HELP lapwing_frames Frames that came in.\n"
            "lapwing_frames_total{endpoint=\"radio\",direction=\"in\"} 18446744073709551615\n"
            "lapwing_frames_total{endpoint=\"wifi\",direction=\"in\"} 0\n"
            "# TYPE lapwing_battery_ratio gauge\n"
            "# HELP lapwing_battery_ratio What is left.\n"
            "lapwing_battery_ratio 0.25\n"
            "# EOF\n");
}

TEST(OpenMetrics, EscapesWhatPeopleNameThings) {
  OpenMetrics metrics;
  metrics.gauge("a", "one\\two \"three\"\nfour");
  metrics.sample({{"name", "C:\\radio \"left\"\n"}}, 1.5);
  EXPECT_EQ(metrics.text(),
            "# TYPE a gauge\n"
            "# HELP a one\\\\two \\\"three\\\"\\nfour\n"
            "a{name=\"C:\\\\radio \\\"left\\\"\\n\"} 1.5\n"
            "# EOF\n");
}

TEST(OpenMetrics, SpellsNumbersThatAreNone) {
  OpenMetrics metrics;
  metrics.gauge("a", "");
  metrics.sample({{"n", "1"}}, std::numeric_limits<double>::quiet_NaN());
  metrics.sample({{"n", "2"}}, std::numeric_limits<double>::infinity());
  metrics.sample({{"n", "3"}}, -std::numeric_limits<double>::infinity());
  auto const text = metrics.text();
  EXPECT_NE(text.find("a{n=\"1\"} NaN\n"), std::string::npos);
  EXPECT_NE(text.find("a{n=\"2\"} +Inf\n"), std::string::npos);
  EXPECT_NE(text.find("a{n=\"3\"} -Inf\n"), std::string::npos);
}

TEST(OpenMetrics, IsValidWithNothingInIt) {
  EXPECT_EQ(OpenMetrics().text(), "# EOF\n");
}

}  // namespace
}  // namespace lapwing::base
