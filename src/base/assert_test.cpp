#include "base/assert.hpp"

#include <gtest/gtest.h>

#include "base/time.hpp"

namespace lapwing::base {
namespace {

using namespace std::chrono_literals;

enum class Colour { red, green };
[[maybe_unused]] std::string_view to_string(Colour colour) {
  return colour == Colour::red ? "red" : "green";
}
enum class Level { low = 3 };

TEST(Assert, DoesNothingWhileTheContractHolds) {
  int looked = 0;
  LAPWING_ASSERT(++looked == 1);
  LAPWING_ASSERT(looked == 1, ++looked);
  EXPECT_EQ(looked, 1) << "values are worked out for the message only";
}

TEST(AssertDeathTest, EndsTheProgramWithConditionValuesAndPlace) {
  int const size = 3;
  std::string const name = "north";
  EXPECT_DEATH(LAPWING_ASSERT(size < 2, size, name),
               R"(broken contract: size < 2 \[size = 3, name = 'north'\] at src/base/assert_test.cpp:[0-9]+)");
}

TEST(AssertDeathTest, IsOnInEveryBuildAndNeedsNoValues) {
  EXPECT_EXIT(LAPWING_ASSERT(1 > 2), testing::KilledBySignal(SIGABRT), "broken contract: 1 > 2 at src/base");
}

TEST(AssertDeathTest, ShowsValuesOfEveryUsualKind) {
  Duration const left = 1500ms;
  TimePoint const then{2s};
  auto const colour = Colour::green;
  auto const level = Level::low;
  bool const armed = true;
  int const* const nothing = nullptr;
  EXPECT_DEATH(LAPWING_ASSERT(!armed, left, then, colour, level, armed, nothing, 0.25, std::max(1, 2)),
               R"(\[left = 1.5 s, then = 2 s, colour = green, level = 3, armed = true, nothing = null, 0.25 = 0.25, )"
               R"(std::max\(1, 2\) = 2\])");
}

}  // namespace
}  // namespace lapwing::base
