#include "tasks/harness_platform.hpp"

#include "tasks/testing/script.hpp"

namespace lapwing::tasks {
namespace {

using namespace testing;

TEST(HarnessPlatform, HasTheVehiclesOfTheConformanceCases) {
  Stage stage;
  std::vector<std::string> seen;
  for (auto const& vehicle : stage.platform.vehicles()) {
    seen.push_back(fmt::format("{} {} {}", vehicle.id.text, vehicle.type, vehicle.payload.size()));
  }
  EXPECT_EQ(seen, (Trace{"a1 UAV 2", "a2 UAV 1", "u1 UUV 2", "u2 UUV 0"}));
  EXPECT_FALSE(stage.platform.find({"x"}));
}

TEST(HarnessPlatform, RefusesPlansWithoutALength) {
  Stage stage;
  for (auto const* name : {"survey1", "A:", "A:x", "A:-1", "A:1s", "A:nan", "A:1e300"}) {
    auto const task = stage.platform.named_task(name);
    ASSERT_FALSE(task.has_value()) << name;
    EXPECT_EQ(task.error().message, fmt::format("there is no plan called '{}'", name));
  }
  EXPECT_EQ((*stage.platform.named_task("a:b:2"))->name(), "a:b");
}

TEST(HarnessPlatform, SetsConnectionTimeoutsAndTellsOfNewVehicles) {
  Stage stage;
  stage.platform.set_connection_timeout({"a1"}, seconds(60));
  EXPECT_EQ(stage.platform.find({"a1"})->connection_timeout, seconds(60));
  auto arrived =
      stage.platform.vehicles_changed().wait_for([&] { return stage.platform.find({"x1"}).has_value(); }, seconds(10));
  auto newcomer = *stage.platform.find({"a1"});
  newcomer.id = {"x1"};
  stage.loop.post([&] { stage.platform.set_vehicle(newcomer); });
  EXPECT_TRUE(stage.loop.run_until_done(std::move(arrived)));
}

}  // namespace
}  // namespace lapwing::tasks
