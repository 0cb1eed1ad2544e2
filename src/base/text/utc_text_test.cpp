#include "base/text/utc_text.hpp"

#include <random>

#include <gtest/gtest.h>

namespace lapwing::base {
namespace {

using namespace std::chrono_literals;

TEST(UtcText, HasAsManyDecimalsAsItTakes) {
  UtcTime const time(1'795'255'972s);
  EXPECT_EQ(utc_text(time), "2026-11-21T10:12:52.000Z");
  EXPECT_EQ(utc_text(time + 120ms), "2026-11-21T10:12:52.120Z");
  EXPECT_EQ(utc_text(time + 120ms + 5us), "2026-11-21T10:12:52.120005Z");
  EXPECT_EQ(utc_text(time + 1ns), "2026-11-21T10:12:52.000000001Z");
  EXPECT_EQ(utc_text(UtcTime(-1ms)), "1969-12-31T23:59:59.999Z");
}

TEST(UtcText, GoesToTheMillisecondInMessages) {
  EXPECT_EQ(to_iso8601(UtcTime(0ms)), "1970-01-01T00:00:00.000Z");
  EXPECT_EQ(to_iso8601(UtcTime(1'000'000'000'007ms) + 999us), "2001-09-09T01:46:40.007Z");
  EXPECT_EQ(to_iso8601(UtcTime(-1ms)), "1969-12-31T23:59:59.999Z") << "forwards before 1970";
}

TEST(UtcText, ReadsWhatOthersWrite) {
  UtcTime const time(1'795'255'972s);
  EXPECT_EQ(utc_from_text("2026-11-21T10:12:52Z"), time);
  EXPECT_EQ(utc_from_text("2026-11-21T11:12:52+01:00"), time);
  EXPECT_EQ(utc_from_text("2026-11-21 03:42:52.5-06:30"), time + 500ms);
  EXPECT_EQ(utc_from_text("2026-11-21t10:12:52.0000000019z"), time + 1ns);
}

TEST(UtcText, ReadsNothingElse) {
  for (auto const* text :
       {"", "2026", "2026-11-21", "2026-11-21T10:12Z", "2026-11-21T10:12:52", "2026-11-21T10:12:52.Z",
        "26-11-21T10:12:52Z", "2026-02-30T10:12:52Z", "2026-13-01T10:12:52Z", "2026-11-21T24:12:52Z",
        "2026-11-21T10:60:52Z", "1492-11-21T10:12:52Z", "9999-11-21T10:12:52Z", "2026-11-21T10:12:52Zulu",
        "-026-11-21T10:12:52Z", "2026-11-21T10:12:52+1:00", "2026-11-21T10:12:-2Z"})
    EXPECT_EQ(utc_from_text(text), std::nullopt) << text;
}

TEST(UtcText, ReadsWhatItWrote) {
  std::mt19937_64 random(7);
  std::uniform_int_distribution<std::int64_t> any(-9'000'000'000'000'000'000, 9'000'000'000'000'000'000);
  for (int i = 0; i < 2'000; ++i) {
    UtcTime const time{Duration(any(random))};
    EXPECT_EQ(utc_from_text(utc_text(time)), time) << utc_text(time);
  }
}

}  // namespace
}  // namespace lapwing::base
