#include "mavlink/wire/system_name.hpp"

#include <gtest/gtest.h>

namespace lapwing::mavlink {
namespace {

TEST(SystemName, ReadsWhatItWrites) {
  for (std::string const text : {"1", "255", "north/7", "field-2_b/200"}) {
    auto const name = parse_system_name(text);
    ASSERT_TRUE(name) << text;
    EXPECT_EQ(to_string(*name), text);
  }
  EXPECT_EQ(*parse_system_name("north/7"), (SystemName{"north", 7}));
  EXPECT_NE(*parse_system_name("7"), *parse_system_name("north/7"));
}

TEST(SystemName, RefusesWhatNamesNoSystem) {
  for (std::string const text : {"", "0", "256", "-1", "7x", "x", "/7", "north/", "north/0", "no rth/7", "a/b/7"}) {
    auto const name = parse_system_name(text);
    ASSERT_FALSE(name) << text;
    EXPECT_EQ(name.error().message, "'" + text + "' names no vehicle");
  }
}

}  // namespace
}  // namespace lapwing::mavlink
