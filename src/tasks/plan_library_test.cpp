#include "tasks/plan_library.hpp"

#include <gtest/gtest.h>

#include "tasks/harness_platform.hpp"
#include "tasks/mission_task.hpp"

namespace lapwing::tasks {
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

TEST(PlanLibrary, ComesBeforeTheTimedTasksOfTheTestPlatform) {
  base::Loop loop({.unpaced = true});
  HarnessPlatform const platform(loop, library());
  EXPECT_EQ((*platform.named_task("north"))->kind(), "mission");
  EXPECT_EQ((*platform.named_task("A:0.3"))->kind(), "task");
  EXPECT_EQ(platform.named_task("broken").error().kind, base::ErrorKind::invalid_input);
  EXPECT_EQ(platform.named_task("south").error().kind, base::ErrorKind::not_found);
  EXPECT_EQ(platform.plan_names().size(), 2u);
}

}  // namespace
}  // namespace lapwing::tasks
