#include "mavlink/exchange/plan_replacement.hpp"

#include <gtest/gtest.h>

#include "mavlink/testing/mission_store.hpp"

namespace lapwing::mavlink {
namespace {

using namespace testing;

constexpr auto ardupilot = MavAutopilot::ardupilotmega;

bool holds(MissionStore const& store, std::vector<MissionItem> const& items) {
  return compare_readback(items, store.items, ardupilot).empty();
}

struct Replacing : ::testing::Test {
  base::Result<> replace(std::vector<MissionItem> items, ReplaceOptions options = {}) {
    options.autopilot = ardupilot;
    record = {};
    return bench.loop.run_until_done(
        replace_plan(bench.ground, Bench::target, std::move(items), MissionType::mission, options, record));
  }

  Bench bench;
  MissionStore store{*bench.vehicle};
  Replacement record;
};

TEST_F(Replacing, PutsTheNewPlanThereAndReadsItBack) {
  store.items = mission_of(3, 50.0);
  ASSERT_TRUE(replace(mission_of(5, 10.0)));
  EXPECT_TRUE(holds(store, mission_of(5, 10.0)));
  EXPECT_EQ(record.left, PlanLeft::new_one);
  EXPECT_EQ(record.written, 5u);
  EXPECT_EQ(record.before->items.size(), 3u);
  EXPECT_EQ(record.held.items.size(), 5u);
}

TEST_F(Replacing, WritesNothingThatIsThereAlready) {
  store.items = mission_of(5, 10.0);
  ASSERT_TRUE(replace(mission_of(5, 10.0)));
  EXPECT_EQ(record.written, 0u);
  EXPECT_EQ(record.left, PlanLeft::new_one);
  EXPECT_TRUE(bench.vehicle->all<MissionItem>().empty());
}

TEST_F(Replacing, WritesOnlyThePartThatChanges) {
  store.items = mission_of(20, 10.0);
  auto changed = mission_of(20, 10.0);
  changed[7].place.z_m = 99.0;
  changed[9].place.z_m = 99.0;
  ASSERT_TRUE(replace(changed));
  EXPECT_TRUE(holds(store, changed));
  EXPECT_EQ(store.parts, 1);
  EXPECT_EQ(record.written, 3u);
  EXPECT_EQ(bench.vehicle->all<MissionItem>().size(), 3u);
}

TEST_F(Replacing, WritesTheWholeWhenAPartIsRefused) {
  store.items = mission_of(20, 10.0);
  store.refuses_part = MavMissionResult::error;
  auto changed = mission_of(20, 10.0);
  changed[7].place.z_m = 99.0;
  auto const begun = bench.loop.now();
  ASSERT_TRUE(replace(changed));
  EXPECT_TRUE(holds(store, changed));
  EXPECT_EQ(record.written, 20u);
  EXPECT_LT(bench.loop.now() - begun, 1s);
}

TEST_F(Replacing, PutsTheOldPlanBackWhenAnItemIsRefused) {
  store.items = mission_of(4, 50.0);
  auto const script = bench.vehicle->on;
  bench.vehicle->on = [&](Message const& message) {
    // Whatever is as low as the new plan's item 2.
    auto const* item = std::get_if<MissionItem>(&message);
    store.refuses.reset();
    if (item && item->seq == 2 && item->place.z_m < 20.0) store.refuses = {2, MavMissionResult::invalid_param7};
    script(message);
  };
  auto const result = replace(mission_of(6, 10.0));
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().kind, base::ErrorKind::refused);
  EXPECT_EQ(result.error().message,
            "upload: vehicle 1 refused item 2 (NAV_WAYPOINT): invalid altitude or parameter 7; the vehicle still holds "
            "its old plan");
  EXPECT_EQ(record.left, PlanLeft::old_one);
  EXPECT_TRUE(holds(store, mission_of(4, 50.0)));
}

TEST_F(Replacing, ClearsWhatItCannotPutBack) {
  store.items = mission_of(4, 50.0);
  store.spoils_item_1 = true;
  store.refuses = {2, MavMissionResult::invalid_param7};  // the old plan's, too
  auto const result = replace(mission_of(6, 10.0));
  ASSERT_FALSE(result);
  EXPECT_EQ(record.left, PlanLeft::none);
  EXPECT_TRUE(store.items.empty());
  EXPECT_TRUE(result.error().message.ends_with("; what the vehicle held was cleared")) << result.error().message;
}

TEST_F(Replacing, ClearsWhereTheOldPlanWasNotKept) {
  store.items = mission_of(4, 50.0);
  store.refuses = {2, MavMissionResult::unsupported};
  ASSERT_FALSE(replace(mission_of(6, 10.0), {.keeps_old = false}));
  EXPECT_EQ(record.left, PlanLeft::none);
  EXPECT_TRUE(store.items.empty());
}

TEST_F(Replacing, TouchesNothingWhenTheNumberOfItemsIsRefused) {
  store.items = mission_of(4, 50.0);
  store.refuses_count = MavMissionResult::no_space;
  ASSERT_FALSE(replace(mission_of(6, 10.0)));
  EXPECT_EQ(record.left, PlanLeft::old_one);
  EXPECT_TRUE(holds(store, mission_of(4, 50.0)));
  EXPECT_TRUE(bench.vehicle->all<MissionClearAll>().empty());
}

TEST_F(Replacing, DoesNotTrustAVehicleThatKeepsSomethingElse) {
  store.items = mission_of(4, 50.0);
  store.spoils_item_1 = true;
  auto const result = replace(mission_of(6, 10.0));
  ASSERT_FALSE(result);
  EXPECT_NE(result.error().message.find("item 1: altitude 16.00 m, sent 11.00 m"), std::string::npos);
  EXPECT_EQ(record.left, PlanLeft::none);
}

TEST_F(Replacing, SaysWhenItDoesNotKnowWhatIsLeft) {
  store.items = mission_of(4, 50.0);
  store.silent_at = 2;
  auto const result = replace(mission_of(6, 10.0));
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().kind, base::ErrorKind::timed_out);
  EXPECT_EQ(record.left, PlanLeft::unknown);
  EXPECT_TRUE(
      result.error().message.ends_with("; the vehicle may hold a part of the new plan and a part of the old one"));
}

TEST_F(Replacing, CanBeUndoneWhenItWasGivenUp) {
  store.items = mission_of(40, 50.0);
  auto const script = bench.vehicle->on;
  bool drops = true;
  bench.vehicle->on = [&](Message const& message) {
    auto const* item = std::get_if<MissionItem>(&message);
    if (!drops || !item || item->seq < 20) script(message);
  };
  ReplaceOptions const options{.autopilot = ardupilot};
  {
    auto task = replace_plan(bench.ground, Bench::target, mission_of(30, 10.0), MissionType::mission, options, record);
    task.start();
    bench.run_for(2s);
    ASSERT_FALSE(task.done());
  }
  EXPECT_EQ(record.left, PlanLeft::unknown);
  drops = false;
  bench.loop.run_until_done(undo_replacement(bench.ground, Bench::target, MissionType::mission, options, record));
  EXPECT_EQ(record.left, PlanLeft::old_one);
  EXPECT_TRUE(holds(store, mission_of(40, 50.0)));
}

/// Whatever the link does: the new plan is there, or the old one, or none, or it is said that nobody knows.
TEST(ReplacingOverABadLink, LeavesWhatItSays) {
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    Bench bench({.loss = seed % 2 ? 0.3 : 0.5, .duplication = 0.1, .delay = 50ms, .jitter = 20ms, .seed = seed});
    MissionStore store(*bench.vehicle);
    store.items = mission_of(8, 50.0);
    Replacement record;
    ReplaceOptions const options{.autopilot = ardupilot};
    auto const result = bench.loop.run_until_done(
        replace_plan(bench.ground, Bench::target, mission_of(12, 10.0), MissionType::mission, options, record));
    EXPECT_EQ(result.has_value(), record.left == PlanLeft::new_one);
    auto const is_true = [&] {
      if (record.left == PlanLeft::new_one) return holds(store, mission_of(12, 10.0));
      if (record.left == PlanLeft::old_one) return holds(store, mission_of(8, 50.0));
      return record.left == PlanLeft::unknown || store.items.empty();
    };
    EXPECT_TRUE(is_true()) << "with seed " << seed << ": " << to_string(record.left);
  }
}

}  // namespace
}  // namespace lapwing::mavlink
