#include "mavlink/mission_transfer.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include <gtest/gtest.h>

#include "mavlink/fake_vehicle_test.hpp"

namespace lapwing::mavlink {
namespace {

using namespace testing;

std::vector<MissionItem> mission_of(std::size_t size) {
  std::vector<MissionItem> items(size);
  for (std::size_t i = 0; i < size; ++i) {
    items[i].seq = static_cast<std::uint16_t>(i);
    items[i].frame = MavFrame::global;
    items[i].command = MavCmd::nav_waypoint;
    items[i].place = {
        .lat_rad = 0.7 + 1e-5 * static_cast<double>(i), .lon_rad = -0.1, .z_m = 100.0 + static_cast<double>(i)};
  }
  return items;
}

base::Result<> upload(Bench& bench, std::vector<MissionItem> items, TransferOptions options = {},
                      TransferProgress progress = {}) {
  return bench.loop.run_until_done(upload_mission(bench.ground, Bench::target, std::move(items), MissionType::mission,
                                                  options, std::move(progress)));
}

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

TEST(Upload, FailsWhenTheVehicleFallsSilentAndSaysSoToIt) {
  Bench bench;
  MissionStore store(*bench.vehicle);
  store.silent_at = 2;
  auto const begun = bench.loop.now();
  auto const result = upload(bench, mission_of(4), {.restarts = 0});
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().kind, base::ErrorKind::timed_out);
  EXPECT_EQ(result.error().message, "vehicle 1 fell silent during the upload of mission items");
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

TEST(Download, BringsEveryItemBack) {
  Bench bench;
  MissionStore store(*bench.vehicle);
  ASSERT_TRUE(upload(bench, mission_of(6)));
  auto const got = bench.loop.run_until_done(download_mission(bench.ground, Bench::target));
  ASSERT_TRUE(got);
  EXPECT_TRUE(compare_readback(mission_of(6), got->items, MavAutopilot::px4).empty());
}

TEST(Download, ReportsRefusalAndSilence) {
  Bench bench;
  auto const silent = bench.loop.run_until_done(download_mission(bench.ground, Bench::target));
  ASSERT_FALSE(silent);
  EXPECT_EQ(silent.error().kind, base::ErrorKind::timed_out);
  bench.vehicle->on = [&](Message const& message) {
    if (std::get_if<MissionRequestList>(&message))
      bench.vehicle->answer(MissionAck{.result = MavMissionResult::denied});
  };
  auto const denied = bench.loop.run_until_done(download_mission(bench.ground, Bench::target));
  ASSERT_FALSE(denied);
  EXPECT_EQ(denied.error().kind, base::ErrorKind::refused);
}

/// As `lapwing mission` is: for a bad link that is not too much.
constexpr TransferOptions very_patient{.tries = 12, .outage_limit = 60s};

TEST(Download, DoesNotWaitForAVehicleThatIsHeardAndAnswersNothing) {
  Bench bench({.delay = 50ms});
  auto const begun = bench.loop.now();
  auto const got =
      bench.loop.run_until_done(download_mission(bench.ground, Bench::target, MissionType::mission, very_patient));
  ASSERT_FALSE(got);
  EXPECT_EQ(got.error().kind, base::ErrorKind::timed_out);
  EXPECT_EQ(got.error().message,
            "vehicle 1 is heard, but answers nothing about its mission items: asked 8 times in 10 s");
  EXPECT_GE(bench.loop.now() - begun, 10s);
  EXPECT_LT(bench.loop.now() - begun, 12s);
}

TEST(Upload, DoesNotWaitForAVehicleThatIsHeardAndAnswersNothing) {
  Bench bench({.delay = 50ms});
  auto const begun = bench.loop.now();
  auto const done = upload(bench, mission_of(3), very_patient);
  ASSERT_FALSE(done);
  EXPECT_NE(done.error().message.find("answers nothing"), std::string::npos) << done.error().message;
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
  auto const got =
      bench.loop.run_until_done(download_mission(bench.ground, Bench::target, MissionType::mission, very_patient));
  ASSERT_TRUE(got) << got.error().message;
  EXPECT_EQ(got->items.size(), 2u);
}

/// Nothing gets through for a time, either way.
base::Task<void> cut_after(base::Loop& loop, Bench& bench, base::Duration after, base::Duration lasting) {
  co_await loop.sleep(after);
  bench.hub.cut(true);
  co_await loop.sleep(lasting);
  bench.hub.cut(false);
}

constexpr TransferOptions patient{.outage_limit = 60s};

TEST(Upload, BeginsAnewWhenTheLinkIsBack) {
  Bench bench({.delay = 50ms});
  MissionStore store(*bench.vehicle);
  base::Scope scope(bench.loop);
  scope.spawn(cut_after(bench.loop, bench, 2s, 40s));
  auto const begun = bench.loop.now();
  ASSERT_TRUE(upload(bench, mission_of(40), patient));
  EXPECT_EQ(store.items.size(), 40u);
  EXPECT_LT(bench.loop.now() - begun, 50s);
}

TEST(Upload, GoesOnWithinTheVehiclesPatience) {
  Bench bench({.delay = 50ms});
  MissionStore store(*bench.vehicle);
  base::Scope scope(bench.loop);
  scope.spawn(cut_after(bench.loop, bench, 2s, 5s));
  std::vector<std::size_t> steps;
  ASSERT_TRUE(upload(bench, mission_of(40), patient, [&](std::size_t done, std::size_t) { steps.push_back(done); }));
  EXPECT_TRUE(std::ranges::is_sorted(steps));  // never from the start again
  EXPECT_EQ(store.finished, 1);
}

TEST(Upload, EndsWhenTheLinkStaysAway) {
  Bench bench({.delay = 50ms});
  MissionStore store(*bench.vehicle);
  base::Scope scope(bench.loop);
  scope.spawn(cut_after(bench.loop, bench, 2s, 1h));
  auto const begun = bench.loop.now();
  auto const result = upload(bench, mission_of(40), patient);
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().kind, base::ErrorKind::timed_out);
  EXPECT_LT(bench.loop.now() - begun, 100s);
}

TEST(Download, GoesOnWhereTheLinkWasLost) {
  Bench bench({.delay = 50ms});
  MissionStore store(*bench.vehicle);
  store.items = mission_of(40);
  base::Scope scope(bench.loop);
  scope.spawn(cut_after(bench.loop, bench, 2s, 50s));
  std::vector<std::size_t> steps;
  auto const got =
      bench.loop.run_until_done(download_mission(bench.ground, Bench::target, MissionType::mission, patient,
                                                 [&](std::size_t done, std::size_t) { steps.push_back(done); }));
  ASSERT_TRUE(got) << got.error().message;
  EXPECT_TRUE(compare_readback(mission_of(40), got->items, MavAutopilot::px4).empty());
  EXPECT_EQ(steps.size(), 40u);  // each once
}

TEST(Download, BeginsAnewWhenThePlanIsAnotherAfterTheOutage) {
  Bench bench({.delay = 50ms});
  MissionStore store(*bench.vehicle);
  store.items = mission_of(40);
  base::Scope scope(bench.loop);
  scope.spawn(cut_after(bench.loop, bench, 2s, 50s));
  auto other = mission_of(39);
  for (auto& item : other) item.place.z_m = 7.0;
  bool is_changed = false;
  auto const got = bench.loop.run_until_done(
      download_mission(bench.ground, Bench::target, MissionType::mission, patient, [&](std::size_t done, std::size_t) {
        if (done < 10 || is_changed) return;
        store.items = other;
        is_changed = true;
      }));
  ASSERT_TRUE(got) << got.error().message;
  EXPECT_TRUE(compare_readback(other, got->items, MavAutopilot::px4).empty());
}

TEST(Download, AsksForNoItemOfAPlanThatIsStillTheOneKnown) {
  Bench bench;
  MissionStore store(*bench.vehicle);
  store.items = mission_of(6);
  store.opaque_id = 0xC0FFEE01;
  HeldPlan const known{mission_of(6), 0xC0FFEE01};
  auto const get = [&] {
    return bench.loop.run_until_done(
        download_mission(bench.ground, Bench::target, MissionType::mission, {}, {}, known));
  };
  ASSERT_EQ(get()->items.size(), 6u);
  EXPECT_TRUE(bench.vehicle->all<MissionRequestInt>().empty());
  store.opaque_id = 2;
  EXPECT_EQ(get()->opaque_id, 2u);
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
    auto const got = bench.loop.run_until_done(download_mission(bench.ground, Bench::target));
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

MissionItem item(MavCmd command, std::array<float, 4> params = {}, MavFrame frame = MavFrame::global) {
  MissionItem result;
  result.command = command;
  result.params = params;
  result.frame = frame;
  result.place = {.lat_rad = 0.7, .lon_rad = -0.1, .z_m = 12.345};
  return result;
}

std::vector<Difference> compared(MissionItem const& sent, MissionItem const& got, MavAutopilot autopilot) {
  std::vector const a{item(MavCmd::nav_waypoint), sent};
  std::vector const b{item(MavCmd::nav_waypoint), got};
  return compare_readback(a, b, autopilot);
}

TEST(CompareReadback, ForgivesWhatArduPilotNormalises) {
  auto constexpr nan = std::numeric_limits<float>::quiet_NaN();
  auto const ardupilot = MavAutopilot::ardupilotmega;
  auto got = item(MavCmd::nav_waypoint, {2, 0, 0, 0}, MavFrame::global_relative_alt);
  got.place.z_m = 12.34;
  got.autocontinue = true;
  EXPECT_TRUE(
      compared(item(MavCmd::nav_waypoint, {2.7F, 50, 0, nan}, MavFrame::global_relative_alt_int), got, ardupilot)
          .empty());
  EXPECT_TRUE(compared(item(MavCmd::nav_loiter_turns, {2.5F, 0, 15, 0}), item(MavCmd::nav_loiter_turns, {2, 0, 15, 0}),
                       ardupilot)
                  .empty());
  EXPECT_TRUE(
      compared(item(MavCmd::nav_loiter_time, {30, 0, 50, 0}), item(MavCmd::nav_loiter_time, {30, 0, 1, 0}), ardupilot)
          .empty());
  EXPECT_TRUE(
      compared(item(MavCmd::nav_land, {0, 0, 0, nan}), item(MavCmd::nav_land, {0, 0, 0, 1}), ardupilot).empty());
  auto speed = item(MavCmd::do_change_speed, {0, 8.5F, -1, 0}, MavFrame::global_relative_alt);
  auto stored = speed;
  stored.frame = MavFrame::global;
  stored.place = {};
  EXPECT_TRUE(compared(speed, stored, ardupilot).empty());
}

/// As its 4.7 returns them.
TEST(CompareReadback, ForgivesWhatArduPilotDropsOfFencesAndRallyPoints) {
  auto const ardupilot = MavAutopilot::ardupilotmega;
  auto sent = item(MavCmd::nav_fence_return_point, {}, MavFrame::global_relative_alt);
  sent.type = MissionType::fence;
  auto got = sent;
  got.frame = MavFrame::global;
  got.place.z_m = 0.0;
  EXPECT_TRUE(compared(sent, got, ardupilot).empty());
  EXPECT_EQ(compared(sent, got, MavAutopilot::px4), std::vector<Difference>{"item 1: frame 0, sent 3"});
  got.place.lat_rad += 1e-6;
  EXPECT_EQ(compared(sent, got, ardupilot).size(), 1u);

  auto rally = item(MavCmd::nav_rally_point, {}, MavFrame::global_relative_alt);
  rally.type = MissionType::rally;
  auto cut = rally;
  cut.place.z_m = 12.0;
  EXPECT_TRUE(compared(rally, cut, ardupilot).empty());
  cut.place.z_m = 11.0;
  EXPECT_EQ(compared(rally, cut, ardupilot), std::vector<Difference>{"item 1: altitude 11.00 m, sent 12.35 m"});
}

TEST(CompareReadback, LeavesHomeToArduPilotOnly) {
  std::vector<MissionItem> const sent{item(MavCmd::nav_waypoint)};
  auto moved = sent;
  moved[0].place.lat_rad += 0.01;
  EXPECT_TRUE(compare_readback(sent, moved, MavAutopilot::ardupilotmega).empty());
  EXPECT_FALSE(compare_readback(sent, moved, MavAutopilot::px4).empty());
}

TEST(CompareReadback, SaysWhatDiffers) {
  auto const sent = item(MavCmd::nav_waypoint);
  auto const ardupilot = MavAutopilot::ardupilotmega;
  auto higher = sent;
  higher.place.z_m = 40;
  EXPECT_EQ(compared(sent, higher, ardupilot), std::vector<Difference>{"item 1: altitude 40.00 m, sent 12.35 m"});
  auto moved = sent;
  moved.place.lon_rad += 1e-6;
  ASSERT_EQ(compared(sent, moved, ardupilot).size(), 1u);
  EXPECT_EQ(compared(sent, moved, ardupilot)[0].rfind("item 1: position", 0), 0u);
  EXPECT_EQ(compared(sent, item(MavCmd::nav_land), ardupilot),
            std::vector<Difference>{"item 1: command NAV_LAND, sent NAV_WAYPOINT"});
  auto relative = sent;
  relative.frame = MavFrame::global_relative_alt;
  EXPECT_EQ(compared(sent, relative, ardupilot), std::vector<Difference>{"item 1: frame 3, sent 0"});
  EXPECT_EQ(
      compared(item(MavCmd::do_change_speed, {0, 8, -1, 0}), item(MavCmd::do_change_speed, {0, 3, -1, 0}), ardupilot),
      std::vector<Difference>{"item 1: parameter 2 of DO_CHANGE_SPEED is 3, sent 8"});
  EXPECT_EQ(compare_readback(mission_of(3), mission_of(2), ardupilot),
            std::vector<Difference>{"the vehicle holds 2 items, sent 3"});
}

}  // namespace
}  // namespace lapwing::mavlink
