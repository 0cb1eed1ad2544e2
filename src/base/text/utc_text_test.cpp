#include "base/text/utc_text.hpp"

#include <gtest/gtest.h>

namespace lapwing::base {
namespace {

using namespace std::chrono_literals;

TEST(Iso8601, HasMillisecondsAndTheZoneUtc) {
  EXPECT_EQ(to_iso8601(UtcTime(0ms)), "1970-01-01T00:00:00.000Z");
  EXPECT_EQ(to_iso8601(UtcTime(1'000'000'000'007ms)), "2001-09-09T01:46:40.007Z");
}

TEST(Iso8601, CountsForwardsBefore1970) {
  EXPECT_EQ(to_iso8601(UtcTime(-1ms)), "1969-12-31T23:59:59.999Z");
  EXPECT_EQ(to_iso8601(UtcTime(-1'000ms)), "1969-12-31T23:59:59.000Z");
}

}  // namespace
}  // namespace lapwing::base
