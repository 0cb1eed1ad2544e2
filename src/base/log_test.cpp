#include "base/log.hpp"

#include <gtest/gtest.h>

namespace lapwing::base {
namespace {

std::string shown(LogLevel lowest, LogLevel level, std::string text) {
  LogHub hub;
  ::testing::internal::CaptureStderr();
  hub.add_sink(standard_error_sink(lowest));
  hub.write({.level = level, .utc = {}, .source = "fleet", .text = std::move(text)});
  return ::testing::internal::GetCapturedStderr();
}

TEST(StandardErrorSink, ShowsSourceAndTextOfWhatIsImportantEnough) {
  EXPECT_TRUE(shown(LogLevel::info, LogLevel::warn, "copter 1 lost").ends_with(" fleet: copter 1 lost\n"));
  EXPECT_EQ(shown(LogLevel::info, LogLevel::debug, "a frame"), "");
}

TEST(StandardErrorSink, LetsNoTextOfAVehicleWriteLinesOfItsOwn) {
  auto const text = shown(LogLevel::info, LogLevel::info, "copter 1: a\n12:00 error\x1B[2J\x7F\xC2\x9B 20 \xC2\xB0");
  EXPECT_TRUE(text.ends_with(" fleet: copter 1: a?12:00 error?[2J?? 20 \xC2\xB0\n")) << text;
}

}  // namespace
}  // namespace lapwing::base
