#include <gtest/gtest.h>

#include <algorithm>

#include "mavlink/testing/mission_store.hpp"

namespace lapwing::mavlink {
namespace {

using namespace testing;

TEST(Upload, SendsEveryItemInOrderAndReportsProgress) {
  Bench bench;
  MissionStore store(*bench.vehicle);
  std::vector<std::size_t> steps;
  ASSERT_TRUE(upload(bench, mission_of(5), {}, [&](std::size_t done, std::size_t) { steps.push_back(done); }));
  ASSERT_EQ(store.items.size(), 5u);
  EXPECT_TRUE(compare_readback(mission_of(5), store.items, MavAutopilot::px4).empty());
  EXPECT_EQ(steps, (std::vector<std::size_t>{0, 1, 2, 3, 4, 5}));
  for (auto const& item : store.items) EXPECT_EQ(item.form, ItemForm::integer);
}

TEST(Upload, AnswersRequestIntToo) {
  Bench bench;
  MissionStore store(*bench.vehicle);
  store.asks_with_int = true;
  EXPECT_TRUE(upload(bench, mission_of(3)));
  EXPECT_EQ(store.items.size(), 3u);
}

TEST(Upload, OfNothingClears) {
  Bench bench;
  MissionStore store(*bench.vehicle);
  store.items = mission_of(3);
  EXPECT_TRUE(upload(bench, {}));
  EXPECT_TRUE(store.items.empty());
}

TEST(Upload, NamesTheItemThatWasRefusedAndWhy) {
  Bench bench;
  MissionStore store(*bench.vehicle);
  store.refuses = {2, MavMissionResult::unsupported};
  auto items = mission_of(4);
  items[2].command = MavCmd::do_change_altitude;
  auto const result = upload(bench, items);
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().kind, base::ErrorKind::refused);
  EXPECT_EQ(result.error().message, "vehicle 1 refused item 2 (DO_CHANGE_ALTITUDE): command not supported");
}

TEST(Upload, ReportsARefusedCount) {
  Bench bench;
  MissionStore store(*bench.vehicle);
  store.refuses_count = MavMissionResult::no_space;
  auto const result = upload(bench, mission_of(4));
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().message, "vehicle 1 refused 4 mission items: no space left for items");
}

TEST(Upload, FailsWhenTheVehicleStopsAskingAndSaysSoToIt) {
  Bench bench;
  MissionStore store(*bench.vehicle);
  store.silent_at = 2;
  auto const begun = bench.loop.now();
  auto const result = upload(bench, mission_of(4), {.restarts = 0});
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().kind, base::ErrorKind::timed_out);
  EXPECT_EQ(result.error().message,
            "vehicle 1 stopped asking for mission items: the last that it wanted was item 2, of 4");
  EXPECT_LT(bench.loop.now() - begun, 12s);
  bench.run_for(1s);
  auto const acks = bench.vehicle->all<MissionAck>();
  ASSERT_EQ(acks.size(), 1u);
  EXPECT_EQ(acks[0].result, MavMissionResult::operation_cancelled);
}

TEST(Upload, FailsWhenNobodyAnswersTheCount) {
  Bench bench;
  auto const result = upload(bench, mission_of(4), {.restarts = 0});
  ASSERT_FALSE(result);
  EXPECT_EQ(bench.vehicle->all<MissionCount>().size(), 5u);
}

TEST(Upload, IsCancelledByDestroyingIt) {
  Bench bench;
  MissionStore store(*bench.vehicle);
  store.silent_at = 1;
  {
    auto task = upload_mission(bench.ground, Bench::target, mission_of(4));
    task.start();
    bench.run_for(1s);
    ASSERT_FALSE(task.done());
  }
  bench.run_for(1s);
  ASSERT_EQ(bench.vehicle->all<MissionAck>().size(), 1u);
}

TEST(Upload, TakesItemsOutOfTurnAsNoise) {
  Bench bench;
  MissionStore store(*bench.vehicle);
  auto const script = bench.vehicle->on;
  bench.vehicle->on = [&](Message const& message) {
    if (auto const* item = std::get_if<MissionItem>(&message); item && item->seq == 1)
      bench.vehicle->answer(MissionAck{.result = MavMissionResult::invalid_sequence});
    if (std::get_if<MissionCount>(&message))
      bench.vehicle->answer(MissionAck{});  // the late end of an earlier transfer
    script(message);
  };
  EXPECT_TRUE(upload(bench, mission_of(3)));
  EXPECT_EQ(store.items.size(), 3u);
}

TEST(Upload, UnderstandsThatItsLastAcknowledgementWasLost) {
  Bench bench;
  MissionStore store(*bench.vehicle);
  bool lost = false;
  // The vehicle's first MISSION_ACK never arrives; then it answers the repeated last item with ERROR, as ArduPilot
  // does.
  auto const script = bench.vehicle->on;
  bench.vehicle->on = [&](Message const& message) {
    auto const* item = std::get_if<MissionItem>(&message);
    if (item && item->seq == 2 && !lost) {
      lost = true;
      store.items.push_back(*item);
      store.silent = true;
      return;
    }
    if (item && lost) return bench.vehicle->answer(MissionAck{.result = MavMissionResult::error});
    script(message);
  };
  EXPECT_TRUE(upload(bench, mission_of(3), {.restarts = 0}));
}

TEST(Upload, BeginsAnewWhenTheVehicleGaveUp) {
  Bench bench;
  MissionStore store(*bench.vehicle);
  int counts = 0;
  auto const script = bench.vehicle->on;
  bench.vehicle->on = [&](Message const& message) {
    counts += std::holds_alternative<MissionCount>(message);
    // The first transfer's item 1 never arrives.
    auto const* item = std::get_if<MissionItem>(&message);
    if (item && item->seq == 1 && counts == 1) return;
    script(message);
  };
  EXPECT_TRUE(upload(bench, mission_of(3)));
  EXPECT_EQ(counts, 2);
  EXPECT_EQ(store.finished, 1);
}

/// The vehicle asks again for a lost item after a second: with a tenth lost each way, some twenty times in this
/// mission.
TEST(Upload, DoesNotWaitForTheVehicleToMissAnItem) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    Bench bench({.loss = 0.1, .delay = 5ms, .seed = seed});
    MissionStore store(*bench.vehicle);
    auto const begun = bench.loop.now();
    ASSERT_TRUE(upload(bench, mission_of(100)));
    EXPECT_EQ(store.items.size(), 100u);
    EXPECT_LT(bench.loop.now() - begun, 6s) << "with seed " << seed;
  }
}

TEST(Upload, SendsTheNextItemWhenOnlyTheRequestForItWasLost) {
  Bench bench;
  MissionStore store(*bench.vehicle);
  auto const script = bench.vehicle->on;
  std::vector<int> came;
  bench.vehicle->on = [&](Message const& message) {
    if (auto const* item = std::get_if<MissionItem>(&message)) came.push_back(item->seq);
    if (came == std::vector{0, 1}) {
      // Item 1 arrives, the request for item 2 does not.
      store.swallow(std::get<MissionItem>(message));
      return;
    }
    script(message);
  };
  auto const begun = bench.loop.now();
  EXPECT_TRUE(upload(bench, mission_of(4)));
  EXPECT_EQ(came, (std::vector{0, 1, 1, 2, 3}));
  EXPECT_LT(bench.loop.now() - begun, 1s);
}

TEST(Upload, DoesNotWaitForAVehicleThatIsHeardAndAnswersNothing) {
  Bench bench({.delay = 50ms});
  auto const begun = bench.loop.now();
  auto const done = upload(bench, mission_of(3), very_patient);
  ASSERT_FALSE(done);
  EXPECT_NE(done.error().message.find("answers nothing"), std::string::npos) << done.error().message;
  EXPECT_LT(bench.loop.now() - begun, 12s);
}

TEST(Upload, BeginsAnewWhenTheLinkIsBack) {
  CutBench bench(40s);
  auto const begun = bench.loop.now();
  ASSERT_TRUE(upload(bench, mission_of(40), patient));
  EXPECT_EQ(bench.store.items.size(), 40u);
  EXPECT_LT(bench.loop.now() - begun, 50s);
}

TEST(Upload, GoesOnWithinTheVehiclesPatience) {
  CutBench bench(5s);
  std::vector<std::size_t> steps;
  ASSERT_TRUE(upload(bench, mission_of(40), patient, [&](std::size_t done, std::size_t) { steps.push_back(done); }));
  EXPECT_TRUE(std::ranges::is_sorted(steps));  // never from the start again
  EXPECT_EQ(bench.store.finished, 1);
}

TEST(Upload, EndsWhenTheLinkStaysAway) {
  CutBench bench(1h);
  auto const begun = bench.loop.now();
  auto const result = upload(bench, mission_of(40), patient);
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().kind, base::ErrorKind::timed_out);
  EXPECT_LT(bench.loop.now() - begun, 100s);
}

}  // namespace
}  // namespace lapwing::mavlink
