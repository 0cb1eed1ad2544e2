#include "base/text/spelling.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace lapwing::base {
namespace {

TEST(EditDistance, CountsInsertionsDeletionsReplacementsAndSwaps) {
  EXPECT_EQ(edit_distance("abc", "abc", 5), 0U);
  EXPECT_EQ(edit_distance("abc", "abxc", 5), 1U);
  EXPECT_EQ(edit_distance("abc", "ac", 5), 1U);
  EXPECT_EQ(edit_distance("abc", "axc", 5), 1U);
  EXPECT_EQ(edit_distance("abc", "acb", 5), 1U);
  EXPECT_EQ(edit_distance("surveyAreaNorth", "surveyNorth", 5), 4U);
  EXPECT_EQ(edit_distance("", "abc", 5), 3U);
}

TEST(EditDistance, GivesUpBeyondTheLimit) {
  EXPECT_EQ(edit_distance("abcdef", "uvwxyz", 2), 3U);
}

TEST(EditDistance, CountsCaseAloneAsOne) {
  EXPECT_EQ(edit_distance("takeoff", "takeOff", 5), 1U);
}

TEST(Closest, FindsWhatWasMeant) {
  std::vector<std::string_view> const words = {"surveySouth", "surveyNorth", "returnHome"};
  EXPECT_EQ(closest("surveyAreaNorth", words), "surveyNorth");
  EXPECT_EQ(closest("surveyAreaSouth", words), "surveySouth");
  EXPECT_EQ(closest("somethingElse", words), std::nullopt);
}

TEST(Closest, IsSilentAboutSingleLettersAndTheWordItself) {
  std::vector<std::string_view> const words = {"a", "v1", "v2"};
  EXPECT_EQ(closest("b", words), std::nullopt);
  EXPECT_EQ(closest("v3", words), "v1");
  EXPECT_EQ(closest("v1", std::vector<std::string_view>{"v1"}), std::nullopt);
}

TEST(DidYouMean, IsEmptyWhenNothingIsNear) {
  EXPECT_EQ(did_you_mean("minuts", std::vector<std::string_view>{"minutes"}), "did you mean minutes?");
  EXPECT_EQ(did_you_mean("minuts", std::vector<std::string_view>{"km"}), "");
}

}  // namespace
}  // namespace lapwing::base
