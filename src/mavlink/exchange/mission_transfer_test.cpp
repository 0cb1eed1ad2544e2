#include "mavlink/exchange/mission_transfer.hpp"

#include <gtest/gtest.h>

#include <tuple>

#include "mavlink/testing/mission_store.hpp"

namespace lapwing::mavlink {
namespace {

using namespace testing;

TEST(Download, BringsEveryItemBack) {
  Bench bench;
  MissionStore store(*bench.vehicle);
  ASSERT_TRUE(upload(bench, mission_of(6)));
  auto const got = download(bench);
  ASSERT_TRUE(got);
  EXPECT_TRUE(compare_readback(mission_of(6), got->items, MavAutopilot::px4).empty());
}

TEST(Download, ReportsRefusalAndSilence) {
  Bench bench;
  auto const silent = download(bench);
  ASSERT_FALSE(silent);
  EXPECT_EQ(silent.error().kind, base::ErrorKind::timed_out);
  bench.vehicle->on = [&](Message const& message) {
    if (std::get_if<MissionRequestList>(&message))
      bench.vehicle->answer(MissionAck{.result = MavMissionResult::denied});
  };
  auto const denied = download(bench);
  ASSERT_FALSE(denied);
  EXPECT_EQ(denied.error().kind, base::ErrorKind::refused);
}

TEST(Download, DoesNotWaitForAVehicleThatIsHeardAndAnswersNothing) {
  Bench bench({.delay = 50ms});
  auto const begun = bench.loop.now();
  auto const got = download(bench, very_patient);
  ASSERT_FALSE(got);
  EXPECT_EQ(got.error().kind, base::ErrorKind::timed_out);
  EXPECT_EQ(got.error().message,
            "vehicle 1 is heard, but answers nothing about its mission items: asked 8 times in 10 s");
  EXPECT_GE(bench.loop.now() - begun, 10s);
  EXPECT_LT(bench.loop.now() - begun, 12s);
}

TEST(Clear, DoesNotWaitForAVehicleThatIsHeardAndAnswersNothing) {
  Bench bench({.delay = 50ms});
  auto const begun = bench.loop.now();
  auto const done =
      bench.loop.run_until_done(clear_mission(bench.ground, Bench::target, MissionType::mission, very_patient));
  ASSERT_FALSE(done);
  EXPECT_NE(done.error().message.find("answers nothing"), std::string::npos) << done.error().message;
  EXPECT_LT(bench.loop.now() - begun, 12s);
}

base::Task<> hears_after(base::Loop& loop, MissionStore& store, base::Duration time) {
  co_await loop.sleep(time);
  store.silent = false;
}

/// Half of everything is lost: that nothing has been answered yet proves nothing.
TEST(Download, KeepsAskingWhereTheLinkLosesMuch) {
  Bench bench({.loss = 0.5, .seed = 3});
  MissionStore store(*bench.vehicle);
  store.items = mission_of(2);
  store.silent = true;
  base::Scope scope(bench.loop);
  scope.spawn(hears_after(bench.loop, store, 18s));
  auto const got = download(bench, very_patient);
  ASSERT_TRUE(got) << got.error().message;
  EXPECT_EQ(got->items.size(), 2u);
}

TEST(Download, GoesOnWhereTheLinkWasLost) {
  CutBench bench(50s);
  bench.store.items = mission_of(40);
  std::vector<std::size_t> steps;
  auto const got = download(bench, patient, [&](std::size_t done, std::size_t) { steps.push_back(done); });
  ASSERT_TRUE(got) << got.error().message;
  EXPECT_TRUE(compare_readback(mission_of(40), got->items, MavAutopilot::px4).empty());
  EXPECT_EQ(steps.size(), 40u);  // each once
}

TEST(Download, BeginsAnewWhenThePlanIsAnotherAfterTheOutage) {
  CutBench bench(50s);
  bench.store.items = mission_of(40);
  auto other = mission_of(39);
  for (auto& item : other) item.place.z_m = 7.0;
  bool is_changed = false;
  auto const got = download(bench, patient, [&](std::size_t done, std::size_t) {
    if (done < 10 || is_changed) return;
    bench.store.items = other;
    is_changed = true;
  });
  ASSERT_TRUE(got) << got.error().message;
  EXPECT_TRUE(compare_readback(other, got->items, MavAutopilot::px4).empty());
}

TEST(Download, AsksForNoItemOfAPlanThatIsStillTheOneKnown) {
  Bench bench;
  MissionStore store(*bench.vehicle);
  store.items = mission_of(6);
  store.opaque_id = 0xC0FFEE01;
  HeldPlan const known{mission_of(6), 0xC0FFEE01};
  ASSERT_EQ(download(bench, {}, {}, known)->items.size(), 6u);
  EXPECT_TRUE(bench.vehicle->all<MissionRequestInt>().empty());
  store.opaque_id = 2;
  EXPECT_EQ(download(bench, {}, {}, known)->opaque_id, 2u);
  EXPECT_EQ(bench.vehicle->all<MissionRequestInt>().size(), 6u);
}

TEST(Clear, EmptiesTheVehicleAndReportsRefusal) {
  Bench bench;
  MissionStore store(*bench.vehicle);
  store.items = mission_of(2);
  EXPECT_TRUE(bench.loop.run_until_done(clear_mission(bench.ground, Bench::target)));
  EXPECT_TRUE(store.items.empty());
  bench.vehicle->on = [&](Message const& message) {
    if (auto const* clear = std::get_if<MissionClearAll>(&message))
      bench.vehicle->answer(MissionAck{.result = MavMissionResult::unsupported, .type = clear->type});
  };
  auto const refused = bench.loop.run_until_done(clear_mission(bench.ground, Bench::target, MissionType::fence));
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().message, "vehicle 1 refused the clearing of fence items: command not supported");
}

/// loss, one-way delay in ms, duplication
class BadLink : public ::testing::TestWithParam<std::tuple<double, int, double>> {};

/// Up to a third lost, every exchange completes. Beyond, it may also end with the reason; never half and never for
/// ever.
TEST_P(BadLink, CarriesAMissionThereAndBack) {
  auto const [loss, delay_ms, duplication] = GetParam();
  bool const may_fail = loss > 0.4;
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    Bench bench({.loss = loss,
                 .duplication = duplication,
                 .delay = std::chrono::milliseconds(delay_ms),
                 .jitter = std::chrono::milliseconds(delay_ms / 4),
                 .seed = seed});
    MissionStore store(*bench.vehicle);
    auto const sent = mission_of(30);
    auto const result = upload(bench, sent);
    if (may_fail && !result) {
      EXPECT_EQ(result.error().kind, base::ErrorKind::timed_out) << result.error().message;
      continue;
    }
    ASSERT_TRUE(result) << result.error().message << " with seed " << seed;
    EXPECT_TRUE(compare_readback(sent, store.items, MavAutopilot::px4).empty());
    auto const got = download(bench);
    if (may_fail && !got) {
      EXPECT_EQ(got.error().kind, base::ErrorKind::timed_out) << got.error().message;
      continue;
    }
    ASSERT_TRUE(got) << got.error().message << " with seed " << seed;
    EXPECT_TRUE(compare_readback(sent, got->items, MavAutopilot::px4).empty());
  }
}

INSTANTIATE_TEST_SUITE_P(Upload, BadLink,
                         ::testing::Combine(::testing::Values(0.0, 0.1, 0.3, 0.5), ::testing::Values(0, 200, 1000),
                                            ::testing::Values(0.0, 0.1)));

}  // namespace
}  // namespace lapwing::mavlink
