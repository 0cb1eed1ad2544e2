#include "base/crc32.hpp"

#include <gtest/gtest.h>

namespace lapwing::base {
namespace {

TEST(Crc32, IsTheCheckValueOfItsCatalogue) {
  EXPECT_EQ(crc32("123456789"), 0xCBF43926U);
  EXPECT_EQ(crc32(""), 0U);
  EXPECT_NE(crc32("a"), crc32("b"));
}

}  // namespace
}  // namespace lapwing::base
