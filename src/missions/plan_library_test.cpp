#include "missions/plan_library.hpp"

#include <gtest/gtest.h>

#include "missions/mission_task.hpp"

namespace lapwing::missions {
namespace {

PlanLibrary library() {
  plan::Mission mission{.name = "north", .home = std::nullopt, .items = {mavlink::MissionItem{}}};
  return {{"north", mission},
          {"broken", base::fail(base::ErrorKind::invalid_input, "broken.plan: mission: \"items\" is missing")}};
}

TEST(PlanLibrary, GivesMissionsByTheirName) {
  auto const found = find_plan(library(), "north");
  ASSERT_TRUE(found);
  EXPECT_EQ((*found)->kind(), "mission");
  EXPECT_EQ((*found)->name(), "north");
  EXPECT_EQ(names_of(library()), (std::vector<std::string>{"broken", "north"}));
}

TEST(PlanLibrary, SaysWhyAPlanCouldNotBeRead) {
  EXPECT_EQ(find_plan(library(), "broken").error().message, "broken.plan: mission: \"items\" is missing");
}

TEST(PlanLibrary, DoesNotKnowOthers) {
  auto const missing = find_plan({}, "south");
  ASSERT_FALSE(missing);
  EXPECT_EQ(missing.error().kind, base::ErrorKind::not_found);
  EXPECT_EQ(missing.error().message, "there is no plan called 'south'");
  EXPECT_EQ(missing.error().hint, "name a mission of this script, or give plan files with --plans DIR");
}

}  // namespace
}  // namespace lapwing::missions
