#include "autonomy/operator/map_follower.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <random>
#include <string>
#include <utility>

#include "autonomy/operator/map_text.hpp"

namespace lapwing::autonomy {
namespace {

using Outcome = MapFollower::Outcome;

constexpr std::size_t longest_message = std::size_t{1024} * 1024;

OccupancyMap map_of(std::vector<std::int8_t> cells) {
  auto const columns = static_cast<std::uint32_t>(cells.size());
  return {.columns = columns, .rows = 1, .resolution_m = 0.5, .origin = {-3, 4}, .cells = std::move(cells)};
}

Outcome hear(MapFollower& follower, std::string const& text) {
  auto report = parse_report(text);
  if (!report) {
    ADD_FAILURE() << report.error().message << " in " << text;
    return Outcome::waits;
  }
  if (auto* const whole = std::get_if<report::Map>(&*report)) return follower.take(std::move(*whole));
  return follower.take(std::get<report::MapChanges>(*report));
}

TEST(MapText, TellsTheWholeMapAndWhatHasChanged) {
  auto const before = map_of({-1, -1, 0, 100, 50, -1, -1, -1, -1});
  EXPECT_EQ(*map_text(before, 7),
            R"({"Type":"Map","Revision":7,"Columns":9,"Rows":1,"Resolution":0.5,"Origin X":-3,"Origin Y":4,)"
            R"("Cells":[-1,-1,0,100,50,-1,-1,-1,-1]})");
  auto now = before;
  now.cells = {-1, 3, 0, 100, 51, -1, -1, -1, 9};
  EXPECT_EQ(map_changes_text(before, 7, now, 8),
            R"({"Type":"Map Changes","Revision":8,"Since":7,"Changes":[[1,3,0,100,51],[8,9]]})");
  EXPECT_EQ(map_changes_text(before, 7, before, 8), R"({"Type":"Map Changes","Revision":8,"Since":7,"Changes":[]})");
  EXPECT_FALSE(map_text({.columns = 2, .rows = 2, .cells = {1}}, 1));
}

TEST(MapText, FitsIntoOneMessageWhateverHasChanged) {
  auto const before = map_of(std::vector<std::int8_t>(most_map_cells, -1));
  EXPECT_LT(map_text(before, std::uint64_t{1} << 53U)->size(), longest_message);
  for (std::size_t const apart : {1U, 2U, 3U, 4U, 5U, 6U, 7U}) {
    for (std::size_t const run : {1U, 2U, 5U, 50U}) {
      auto now = before;
      for (std::size_t i = 0; i < now.cells.size(); ++i)
        if (i % (run + apart - 1) < run) now.cells[i] = 100;
      EXPECT_LT(map_changes_text(before, 1, now, 2).size(), longest_message) << run << " of " << run + apart - 1;
    }
  }
}

TEST(MapFollower, HasWhatTheDroneHas) {
  std::mt19937 chance(1);
  MapFollower follower;
  auto map = map_of(std::vector<std::int8_t>(200, -1));
  ASSERT_EQ(hear(follower, *map_text(map, 1)), Outcome::shown);
  for (std::uint64_t revision = 2; revision < 60; ++revision) {
    auto const before = map;
    auto const changes = chance() % 30;
    for (std::size_t i = 0; i < changes; ++i)
      map.cells[chance() % map.cells.size()] = static_cast<std::int8_t>(static_cast<int>(chance() % 102) - 1);
    ASSERT_EQ(hear(follower, map_changes_text(before, revision - 1, map, revision)), Outcome::shown);
    ASSERT_EQ(follower.map()->cells, map.cells) << revision;
  }
}

TEST(MapFollower, SeesByTheNumberThatSomethingIsMissing) {
  MapFollower follower;
  auto const first = map_of({0, 0, 0});
  auto const second = map_of({0, 9, 0});
  auto const third = map_of({0, 9, 9});
  EXPECT_EQ(hear(follower, map_changes_text(first, 1, second, 2)), Outcome::waits) << "there is no map yet";
  EXPECT_FALSE(follower.map());
  ASSERT_EQ(hear(follower, *map_text(first, 1)), Outcome::shown);
  EXPECT_EQ(hear(follower, map_changes_text(second, 2, third, 3)), Outcome::missed);
  EXPECT_EQ(follower.map()->cells, first.cells) << "what is known stays to be shown";
  EXPECT_EQ(hear(follower, map_changes_text(third, 3, first, 4)), Outcome::waits) << "it was asked already";
  EXPECT_EQ(hear(follower, *map_text(second, 5)), Outcome::shown);
  EXPECT_EQ(hear(follower, map_changes_text(second, 5, third, 6)), Outcome::shown);
  EXPECT_EQ(follower.map()->cells, third.cells);
}

TEST(MapFollower, TakesNoChangesBeyondItsMap) {
  MapFollower follower;
  ASSERT_EQ(hear(follower, *map_text(map_of({0, 0, 0}), 1)), Outcome::shown);
  EXPECT_EQ(hear(follower, R"({"Type":"Map Changes","Revision":2,"Since":1,"Changes":[[2,5,5]]})"), Outcome::missed);
}

TEST(MapFollower, IsShownNoChangesThatMakeNoSense) {
  for (auto const* const text :
       {R"({"Type":"Map","Columns":1,"Rows":1,"Resolution":1,"Origin X":0,"Origin Y":0,"Cells":[0]})",
        R"({"Type":"Map","Revision":0,"Columns":1,"Rows":1,"Resolution":1,"Origin X":0,"Origin Y":0,"Cells":[0]})",
        R"({"Type":"Map","Revision":1})", R"({"Type":"Map Changes","Revision":2,"Since":1})",
        R"({"Type":"Map Changes","Revision":2,"Since":0,"Changes":[]})",
        R"({"Type":"Map Changes","Revision":2.5,"Since":1,"Changes":[]})",
        R"({"Type":"Map Changes","Revision":2,"Since":1,"Changes":[7]})",
        R"({"Type":"Map Changes","Revision":2,"Since":1,"Changes":[[7]]})",
        R"({"Type":"Map Changes","Revision":2,"Since":1,"Changes":[[-1,0]]})",
        R"({"Type":"Map Changes","Revision":2,"Since":1,"Changes":[[0,101]]})",
        R"({"Type":"Map Changes","Revision":2,"Since":1,"Changes":[[0,0.5]]})",
        R"({"Type":"Map Changes","Revision":2,"Since":1,"Changes":[[199999,0,0]]})",
        R"({"Type":"Map Changes","Revision":2,"Since":1,"Changes":[[4,0,0],[5,0]]})"})
    EXPECT_FALSE(parse_report(text)) << text;
}

}  // namespace
}  // namespace lapwing::autonomy
