#include "robot/poi/named_place.hpp"

#include <vector>

#include <gtest/gtest.h>

namespace lapwing::robot {
namespace {

map::PointOfInterest tag(double x, std::string name, std::string text) {
  return {.position = {x, 2.0}, .kind = "name tag", .name = std::move(name), .text = std::move(text)};
}

/// Four doors along a hall, 3 m apart.
struct PlaceCalled : ::testing::Test {
  std::vector<map::PointOfInterest> points{tag(0.0, "221", "221 office"), tag(3.0, "223", "223 meeting room"),
                                           tag(6.0, "ITB-224", "ITB-224 office"), tag(9.0, "exit", "exit")};

  [[nodiscard]] base::Result<map::SitePoint> place(std::string_view name) const {
    std::vector<map::PointOfInterest const*> all;
    for (auto const& point : points) all.push_back(&point);
    return place_called(name, all);
  }
  /// -1: none.
  [[nodiscard]] double x_of(std::string_view name) const {
    auto const found = place(name);
    return found ? found->x() : -1.0;
  }
};

TEST_F(PlaceCalled, IsTheOneWithThatNumberHoweverItIsSaid) {
  for (auto const* name : {"223", "room 223", "Room 223", "door 223", "223 meeting room", "Meeting 223"})
    EXPECT_EQ(x_of(name), 3.0) << name;
}

TEST_F(PlaceCalled, IsTheOneWhoseLabelAloneHasTheWords) {
  EXPECT_EQ(x_of("meeting room"), 3.0);
  EXPECT_EQ(x_of("Exit"), 9.0);
  EXPECT_EQ(x_of("room 224"), 6.0) << "a part of its number";
  EXPECT_EQ(x_of("itb 224"), 6.0);
}

TEST_F(PlaceCalled, TakesWhatIsCalledSoBeforeWhatHasTheWord) {
  points.push_back(tag(12.0, "office", "office"));
  EXPECT_EQ(x_of("office"), 12.0);
}

TEST_F(PlaceCalled, DoesNotGuessBetweenSeveral) {
  auto const found = place("office");
  ASSERT_FALSE(found);
  EXPECT_EQ(found.error().message, "the map has 2 places called 'office' on its floor: 221 office, ITB-224 office");
  EXPECT_EQ(found.error().hint, "say what only one of them is called");
}

TEST_F(PlaceCalled, TakesTwoSightsOfOneDoorForOnePlace) {
  points.push_back(tag(3.6, "223", "223"));
  EXPECT_EQ(x_of("room 223"), 3.0);
}

TEST_F(PlaceCalled, FindsNothingByAPartOfAWordNorByNoWord) {
  points.push_back(tag(12.0, "", ""));
  for (auto const* name : {"22", "room", "", "2", "meet"}) EXPECT_FALSE(place(name)) << name;
  EXPECT_EQ(place("room 22").error().message, "the map has no place called 'room 22' on its floor");
}

}  // namespace
}  // namespace lapwing::robot
