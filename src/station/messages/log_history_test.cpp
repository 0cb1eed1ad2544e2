#include "station/messages/log_history.hpp"

#include <algorithm>

#include <gtest/gtest.h>

namespace lapwing::station {
namespace {

using base::LogLevel;

void say(LogHistory& history, std::string source, std::string text, LogLevel level = LogLevel::info) {
  history.add({level, {}, std::move(source), std::move(text)});
}

std::vector<std::string> texts(LogHistory const& history, std::uint64_t after = 0) {
  std::vector<std::string> all;
  for (auto const& line : history.after(after)) all.push_back(line.record.text);
  return all;
}

TEST(LogHistory, KeepsTheLastLines) {
  LogHistory history(3);
  for (auto const* text : {"a", "b", "c", "d"}) say(history, "fleet", text);
  EXPECT_EQ(texts(history), (std::vector<std::string>{"b", "c", "d"}));
  EXPECT_EQ(texts(history, 3), (std::vector<std::string>{"d"}));
  EXPECT_EQ(history.last_sequence(), 4U);
}

TEST(LogHistory, LosesNoWordOfOthersToOneThatFloods) {
  LogHistory history(100);
  for (int i = 0; i < 10; ++i) say(history, "fleet", "copter " + std::to_string(i));
  say(history, "vehicle 1", "PreArm: no fix");
  for (int i = 0; i < 100'000; ++i) say(history, "script", "x");
  auto const kept = texts(history);
  ASSERT_EQ(kept.size(), 100U);
  for (int i = 0; i < 10; ++i) EXPECT_EQ(kept[static_cast<std::size_t>(i)], "copter " + std::to_string(i));
  EXPECT_EQ(kept[10], "PreArm: no fix");
}

TEST(LogHistory, SharesItsRoomAmongThoseThatFlood) {
  LogHistory history(100);
  for (int i = 0; i < 1000; ++i) {
    say(history, "script", "x");
    say(history, "station", "y");
  }
  auto const script = std::ranges::count(texts(history), "x");
  EXPECT_TRUE(script == 50 || script == 49) << script;
}

TEST(LogHistory, KeepsErrorsLongest) {
  LogHistory history(3);
  say(history, "fleet", "EMERGENCY STOP", LogLevel::error);
  for (int i = 0; i < 10; ++i) say(history, "fleet", std::to_string(i));
  EXPECT_EQ(texts(history), (std::vector<std::string>{"EMERGENCY STOP", "8", "9"}));
  for (int i = 0; i < 3; ++i) say(history, "fleet", "error " + std::to_string(i), LogLevel::error);
  EXPECT_EQ(texts(history), (std::vector<std::string>{"error 0", "error 1", "error 2"}));
}

}  // namespace
}  // namespace lapwing::station
