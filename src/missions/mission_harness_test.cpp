#include "missions/mission_harness.hpp"

#include <gtest/gtest.h>

#include "missions/mission_task.hpp"

namespace lapwing::missions {
namespace {

TEST(MissionHarness, LooksForPlansBeforeTimedTasks) {
  base::Loop loop({.unpaced = true});
  PlanLibrary plans;
  plans.emplace("north", plan::Mission{.name = "north", .home = std::nullopt, .items = {mavlink::MissionItem{}}});
  plans.emplace("broken", base::fail(base::ErrorKind::invalid_input, "broken.plan: it is empty"));
  MissionHarness const platform(loop, std::move(plans));
  EXPECT_EQ((*platform.named_task("north"))->kind(), "mission");
  EXPECT_EQ((*platform.named_task("A:0.3"))->kind(), "task");
  EXPECT_EQ(platform.named_task("broken").error().kind, base::ErrorKind::invalid_input);
  EXPECT_EQ(platform.named_task("south").error().kind, base::ErrorKind::not_found);
  EXPECT_EQ(platform.plan_names().size(), 2u);
}

}  // namespace
}  // namespace lapwing::missions
