#include "vehicle/registry.hpp"

#include <gtest/gtest.h>

namespace lapwing::vehicle {
namespace {

TEST(Registry, ListsDecimalIdsInNumericOrder) {
  base::Loop loop;
  Registry registry(loop);
  for (auto const* id : {"10", "2", "1"}) (void)registry.edit(VehicleId{id});
  std::vector<std::string> order;
  for (auto const* state : registry.all()) order.push_back(state->id.text);
  EXPECT_EQ(order, (std::vector<std::string>{"1", "2", "10"}));
}

TEST(Registry, RevisionGrowsWithEachTouchOfThatVehicleOnly) {
  base::Loop loop;
  Registry registry(loop);
  registry.touch(VehicleId{"1"});
  registry.touch(VehicleId{"1"});
  registry.touch(VehicleId{"2"});
  EXPECT_EQ(registry.revision(VehicleId{"1"}), 2u);
  EXPECT_EQ(registry.revision(VehicleId{"2"}), 1u);
  EXPECT_EQ(registry.revision(VehicleId{"3"}), 0u);
}

TEST(VehicleState, FieldNeverHeardIsUnknownNotZero) {
  VehicleState const state;
  EXPECT_FALSE(state.motion.position.known());
  EXPECT_FALSE(state.motion.position.age(base::TimePoint{}).has_value());
}

TEST(VehicleState, AgeCountsFromTheLastTimeHeard) {
  Aged<int> field;
  field.set(3, base::TimePoint(std::chrono::seconds(5)));
  EXPECT_EQ(*field.age(base::TimePoint(std::chrono::seconds(7))), std::chrono::seconds(2));
}

}  // namespace
}  // namespace lapwing::vehicle
