#include "base/text/random_name.hpp"

#include <gtest/gtest.h>

namespace lapwing::base {
namespace {

TEST(RandomName, HasAsManyDigitsAsAreAskedForAndIsAnotherEachTime) {
  for (int const digits : {1, 8, 13, 32}) {
    auto const name = random_name(digits);
    EXPECT_EQ(name.size(), static_cast<std::size_t>(digits));
    EXPECT_EQ(name.find_first_not_of("0123456789abcdef"), std::string::npos) << name;
  }
  EXPECT_NE(random_name(32), random_name(32));
}

}  // namespace
}  // namespace lapwing::base
