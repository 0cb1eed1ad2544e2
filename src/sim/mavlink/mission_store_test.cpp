#include "sim/mavlink/mission_store.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <numbers>

#include "sim/testing/ground.hpp"

namespace lapwing::sim {
namespace {

using namespace std::chrono_literals;
using namespace mavlink;

constexpr Address ground{255, 190};
constexpr Address stranger{254, 1};

/// The store with everything round it recorded.
struct Desk {
  struct Sent {
    Address to;
    Message message;
  };
  MissionStore::Plans plans;
  std::vector<Sent> sent;
  std::vector<std::string> said;
  int changes = 0;
  int clears = 0;
  int zone_changes = 0;
  std::optional<geo::Wgs84> home;
  std::vector<MissionItem> went_to;
  base::Duration now{};
  ItemMaker make{geo::Wgs84::from_degrees(41.0, -8.0, 90.0)};
  MissionStore store{plans,
                     {.send = [this](Address to, Message message) { sent.push_back({to, std::move(message)}); },
                      .say = [this](MavSeverity, std::string text) { said.push_back(std::move(text)); },
                      .mission_changed = [this] { ++changes; },
                      .mission_cleared = [this] { ++clears; },
                      .zones_changed = [this] { ++zone_changes; },
                      .go_to =
                          [this](MissionItem const& item) {
                            went_to.push_back(item);
                            return MavMissionResult::accepted;
                          },
                      .home = [this] { return home; }}};

  void hear(Message const& message, Address from = ground) { EXPECT_TRUE(store.handle(message, from, now)); }
  void pass(base::Duration duration) {
    for (auto const end = now + duration; now < end;) {
      now += 50ms;
      store.tick(now);
    }
  }
  void count(int items, MissionType type = MissionType::mission, Address from = ground) {
    hear(MissionCount{.target = {}, .count = static_cast<std::uint16_t>(items), .type = type}, from);
  }
  void give(MissionItem item, int seq, Address from = ground) {
    item.seq = static_cast<std::uint16_t>(seq);
    hear(item, from);
  }
  void upload(std::vector<MissionItem> const& items) {
    count(static_cast<int>(items.size()));
    for (std::size_t i = 0; i < items.size(); ++i) give(items[i], static_cast<int>(i));
  }
  template <class M>
  std::vector<M> all() const {
    std::vector<M> found;
    for (auto const& one : sent) {
      if (auto const* message = std::get_if<M>(&one.message)) found.push_back(*message);
    }
    return found;
  }
  std::vector<int> requested() const {
    std::vector<int> seqs;
    for (auto const& request : all<MissionRequest>()) seqs.push_back(request.seq);
    return seqs;
  }
  std::vector<MavMissionResult> results() const {
    std::vector<MavMissionResult> found;
    for (auto const& ack : all<MissionAck>()) found.push_back(ack.result);
    return found;
  }
  MissionItem read(int seq) {
    sent.clear();
    hear(MissionRequestInt{.target = {}, .seq = static_cast<std::uint16_t>(seq)});
    auto const items = all<MissionItem>();
    EXPECT_EQ(items.size(), 1u);
    return items.empty() ? MissionItem{} : items[0];
  }
  std::vector<MissionItem> three() const {
    return {make.waypoint(0, 0, 0), make.waypoint(10, 0, 20), make.waypoint(20, 0, 30)};
  }
};

using Results = std::vector<MavMissionResult>;
using Seqs = std::vector<int>;
using enum MavMissionResult;

TEST(MissionUpload, AsksInOrderWithMissionRequestAndAcknowledges) {
  Desk desk;
  desk.upload(desk.three());
  EXPECT_EQ(desk.requested(), (Seqs{0, 1, 2}));
  EXPECT_TRUE(desk.all<MissionRequestInt>().empty());
  EXPECT_EQ(desk.results(), Results{accepted});
  EXPECT_EQ(desk.sent.front().to, ground);
  EXPECT_EQ(desk.said, std::vector<std::string>{"Flight plan received"});
  EXPECT_EQ(desk.plans.mission.size(), 3u);
}

TEST(MissionUpload, TakesFloatItemsWithOneWarning) {
  Desk desk;
  desk.count(3);
  auto items = desk.three();
  for (int i = 0; i < 3; ++i) {
    items[static_cast<std::size_t>(i)].form = ItemForm::floating;
    desk.give(items[static_cast<std::size_t>(i)], i);
  }
  EXPECT_EQ(desk.results(), Results{accepted});
  EXPECT_EQ(desk.said[0], "got MISSION_ITEM; GCS should send MISSION_ITEM_INT");
  EXPECT_EQ(desk.said.size(), 2u);
}

TEST(MissionUpload, RepeatsTheRequestEverySecondAndGivesUpAfterEight) {
  Desk desk;
  desk.count(3);
  desk.give(desk.three()[0], 0);
  desk.pass(7500ms);
  EXPECT_EQ(desk.requested(), (Seqs{0, 1, 1, 1, 1, 1, 1, 1, 1}));
  EXPECT_TRUE(desk.results().empty());
  desk.pass(1s);
  EXPECT_EQ(desk.results(), Results{operation_cancelled});
  EXPECT_EQ(desk.said.back(), "Mission upload timeout");
  EXPECT_FALSE(desk.store.receiving());
}

TEST(MissionUpload, AnswersAWrongNumberAndGoesOn) {
  Desk desk;
  desk.count(3);
  desk.give(desk.three()[0], 0);
  desk.give(desk.three()[0], 0);
  EXPECT_EQ(desk.results(), Results{invalid_sequence});
  desk.give(desk.three()[1], 1);
  desk.give(desk.three()[2], 2);
  EXPECT_EQ(desk.results(), (Results{invalid_sequence, accepted}));
}

TEST(MissionUpload, AnItemAfterTheEndIsAnError) {
  Desk desk;
  desk.upload(desk.three());
  desk.give(desk.three()[2], 2);
  EXPECT_EQ(desk.results(), (Results{accepted, error}));
}

TEST(MissionUpload, WorksWhenAllItemsComeWithoutWaiting) {
  Desk desk;
  desk.count(3);
  for (int i = 0; i < 3; ++i) desk.give(desk.three()[static_cast<std::size_t>(i)], i);
  EXPECT_EQ(desk.results(), Results{accepted});
  EXPECT_EQ(desk.requested(), (Seqs{0, 1, 2}));
}

TEST(MissionUpload, RestartsOnASecondCountOfTheSameStation) {
  Desk desk;
  desk.count(3);
  desk.give(desk.three()[0], 0);
  desk.count(2);
  desk.give(desk.three()[0], 0);
  desk.give(desk.three()[1], 1);
  EXPECT_EQ(desk.requested(), (Seqs{0, 1, 0, 1}));
  EXPECT_EQ(desk.results(), Results{accepted});
}

TEST(MissionUpload, DeniesAnotherStationAndDownloadsMeanwhile) {
  Desk desk;
  desk.count(3);
  desk.count(2, MissionType::mission, stranger);
  desk.hear(MissionRequestList{});
  EXPECT_EQ(desk.results(), (Results{denied, denied}));
  EXPECT_EQ(desk.sent[1].to, stranger);
  EXPECT_TRUE(desk.store.receiving());
}

TEST(MissionUpload, IsNotStoppedByClearAll) {
  Desk desk;
  desk.count(3);
  desk.give(desk.three()[0], 0);
  desk.hear(MissionClearAll{});
  EXPECT_EQ(desk.results(), Results{error});
  desk.give(desk.three()[1], 1);
  desk.give(desk.three()[2], 2);
  EXPECT_EQ(desk.results(), (Results{error, accepted}));
}

TEST(MissionUpload, RefusesBadItemsAtOnce) {
  auto const refused_with = [](MissionItem const& item) {
    Desk desk;
    desk.count(2);
    desk.give(desk.three()[0], 0);
    desk.give(item, 1);
    EXPECT_FALSE(desk.store.receiving());
    return desk.results().back();
  };
  Desk const desk;
  EXPECT_EQ(refused_with(ItemMaker::plain(MavCmd::do_change_altitude, {100, 0, 0, 0})), unsupported);
  auto local = desk.make.waypoint(0, 0, 10);
  local.frame = MavFrame::local_ned;
  EXPECT_EQ(refused_with(local), unsupported_frame);
  auto far_north = desk.make.waypoint(0, 0, 10);
  far_north.place.lat_rad = 95.0 * std::numbers::pi / 180.0;
  EXPECT_EQ(refused_with(far_north), invalid_param5_x);
  auto turns = desk.make.at(MavCmd::nav_loiter_turns, {0, 0, -10});
  turns.params[3] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(refused_with(turns), invalid_param4);
  turns.params = {std::numeric_limits<float>::quiet_NaN(), 0, 0, 0};
  EXPECT_EQ(refused_with(turns), invalid_param1);
}

TEST(MissionUpload, RefusesJumpsThatLeadNowhereAndHeightsBeyondTheSky) {
  auto const refused_with = [](MissionItem const& item) {
    Desk desk;
    desk.count(3);
    desk.give(desk.three()[0], 0);
    desk.give(item, 1);
    return desk.results().empty() ? accepted : desk.results().back();
  };
  EXPECT_EQ(refused_with(ItemMaker::plain(MavCmd::do_jump, {2, 1, 0, 0})), accepted);
  EXPECT_EQ(refused_with(ItemMaker::plain(MavCmd::do_jump, {3, 1, 0, 0})), error);
  EXPECT_EQ(refused_with(ItemMaker::plain(MavCmd::do_jump, {0, 1, 0, 0})), error);
  Desk const desk;
  EXPECT_EQ(refused_with(desk.make.waypoint(0, 0, 90000)), invalid_param7);
  auto waypoint = desk.make.waypoint(0, 0, 10);
  waypoint.params[0] = std::numeric_limits<float>::infinity();
  EXPECT_EQ(refused_with(waypoint), invalid_param1);
}

TEST(MissionUpload, OfASplineIsRefusedByPlanesAlone) {
  for (auto const family : {vehicle::Family::copter, vehicle::Family::rover, vehicle::Family::plane}) {
    auto const item = ItemMaker{geo::Wgs84::from_degrees(41.0, -8.0, 90.0)}.at(MavCmd::nav_spline_waypoint, {});
    EXPECT_EQ(refusal(item, Kind{family}, 2), family == vehicle::Family::plane ? unsupported : accepted);
  }
}

TEST(MissionUpload, IsNotAtomic) {
  Desk desk;
  desk.upload({desk.make.waypoint(0, 0, 0), desk.make.waypoint(1, 0, 11), desk.make.waypoint(2, 0, 12),
               desk.make.waypoint(3, 0, 13)});
  desk.count(3);
  EXPECT_EQ(desk.plans.mission.size(), 3u);
  desk.give(desk.make.waypoint(0, 0, 0), 0);
  desk.give(desk.make.waypoint(9, 0, 50), 1);
  desk.give(ItemMaker::plain(MavCmd::do_change_altitude), 2);
  EXPECT_EQ(desk.plans.mission[1].place.z_m, 50.0);
  EXPECT_EQ(desk.plans.mission[2].place.z_m, 12.0);
}

TEST(MissionUpload, OfNothingClears) {
  Desk desk;
  desk.upload(desk.three());
  desk.count(0);
  EXPECT_EQ(desk.results(), (Results{accepted, accepted}));
  EXPECT_TRUE(desk.plans.mission.empty());
  EXPECT_EQ(desk.clears, 1);
}

TEST(MissionUpload, HasRoomFor650Items) {
  Desk desk;
  desk.count(651);
  EXPECT_EQ(desk.results(), Results{no_space});
  EXPECT_EQ(desk.said[0], "Only 650 items are supported");
  desk.count(650);
  EXPECT_TRUE(desk.store.receiving());
}

TEST(MissionUpload, TellsOnlyRealChanges) {
  Desk desk;
  desk.upload(desk.three());
  auto const before = desk.changes;
  desk.upload(desk.three());
  EXPECT_EQ(desk.changes, before);
  auto items = desk.three();
  items[2].place.z_m = 31.0;
  desk.upload(items);
  EXPECT_EQ(desk.changes, before + 1);
}

TEST(MissionUpload, AnInjectedRefusalAbortsIt) {
  Desk desk;
  desk.store.refuse_item(1, invalid_param7);
  desk.upload(desk.three());
  EXPECT_EQ(desk.results()[0], invalid_param7);
}

TEST(MissionDownload, GivesHomeAsItemZeroOnceItIsKnown) {
  Desk desk;
  desk.upload(desk.three());
  EXPECT_EQ(desk.read(0).place.lat_rad, 0.0);
  desk.home = geo::Wgs84::from_degrees(41.5, -8.5, 77.0);
  EXPECT_EQ(desk.read(0).place.lat_rad, desk.home->lat_rad);
  EXPECT_EQ(desk.read(0).place.z_m, 77.0);
  EXPECT_EQ(desk.read(0).frame, MavFrame::global);
}

TEST(MissionDownload, CountsHomeAndGivesIntegerItems) {
  Desk desk;
  desk.upload(desk.three());
  desk.sent.clear();
  desk.hear(MissionRequestList{});
  EXPECT_EQ(desk.all<MissionCount>()[0].count, 3);
  EXPECT_EQ(desk.read(1).form, ItemForm::integer);
  EXPECT_EQ(desk.read(1).seq, 1);
  desk.hear(MissionAck{});
}

TEST(MissionDownload, AnswersTheOldRequestWithAFloatItemAndOneWarning) {
  Desk desk;
  desk.upload(desk.three());
  desk.hear(MissionRequest{.target = {}, .seq = 1});
  desk.hear(MissionRequest{.target = {}, .seq = 2});
  EXPECT_EQ(desk.all<MissionItem>()[0].form, ItemForm::floating);
  EXPECT_EQ(desk.said.size(), 2u);
  EXPECT_EQ(desk.said[1], "got MISSION_REQUEST; use MISSION_REQUEST_INT!");
}

TEST(MissionDownload, AnswersABadNumberWithTheCountAndAnError) {
  Desk desk;
  desk.upload(desk.three());
  desk.sent.clear();
  desk.hear(MissionRequestInt{.target = {}, .seq = 3});
  EXPECT_EQ(desk.all<MissionCount>().size(), 1u);
  EXPECT_EQ(desk.results(), Results{error});
}

TEST(MissionDownload, ReadsBackNormalised) {
  Desk desk;
  auto waypoint = desk.make.waypoint(10, 5, 12.345, 2.7F);
  waypoint.params = {2.7F, 5.0F, 1.0F, std::numeric_limits<float>::quiet_NaN()};
  waypoint.current = 1;
  auto global = waypoint;
  global.frame = MavFrame::global_int;
  auto terrain = waypoint;
  terrain.frame = MavFrame::global_terrain_alt_int;
  desk.upload({waypoint, waypoint, global, terrain, ItemMaker::plain(MavCmd::nav_return_to_launch),
               desk.make.at(MavCmd::nav_loiter_turns, {0, 0, -10}, {2.5F, 0, 30, 0}),
               desk.make.at(MavCmd::nav_loiter_time, {0, 0, -10}, {7.9F, 0, 30, 0}),
               desk.make.at(MavCmd::nav_land, {0, 0, 0})});
  auto const first = desk.read(1);
  EXPECT_EQ(first.frame, MavFrame::global_relative_alt);
  EXPECT_EQ(first.place.z_m, 12.34);
  EXPECT_EQ(first.place.lat_rad, waypoint.place.lat_rad);
  EXPECT_EQ(first.params, (std::array<float, 4>{2, 0, 0, 0}));
  EXPECT_EQ(first.current, 0);
  EXPECT_TRUE(first.autocontinue);
  EXPECT_EQ(desk.read(2).frame, MavFrame::global);
  EXPECT_EQ(desk.read(3).frame, MavFrame::global_terrain_alt);
  EXPECT_EQ(desk.read(4).frame, MavFrame::global);
  EXPECT_EQ(desk.read(5).params[0], 2.0F);
  EXPECT_EQ(desk.read(6).params[2], 1.0F);
  EXPECT_EQ(desk.read(7).params[3], 1.0F);
}

TEST(MissionPartialWrite, ReplacesARange) {
  Desk desk;
  desk.upload(desk.three());
  desk.sent.clear();
  desk.hear(MissionWritePartialList{.target = {}, .start = 1, .end = 2});
  desk.give(desk.make.waypoint(1, 1, 40), 1);
  desk.give(desk.make.waypoint(1, 1, 41), 2);
  EXPECT_EQ(desk.requested(), (Seqs{1, 2}));
  EXPECT_EQ(desk.results(), Results{accepted});
  EXPECT_EQ(desk.plans.mission[2].place.z_m, 41.0);
  desk.hear(MissionWritePartialList{.target = {}, .start = 2, .end = 7});
  EXPECT_EQ(desk.results().back(), error);
}

TEST(MissionClear, ClearsOneKindAtATime) {
  Desk desk;
  desk.upload(desk.three());
  desk.sent.clear();
  desk.hear(MissionClearAll{.target = {}, .type = MissionType::all});
  desk.hear(MissionRequestList{.target = {}, .type = MissionType::all});
  desk.hear(MissionClearAll{});
  EXPECT_EQ(desk.results(), (Results{unsupported, unsupported, accepted}));
  EXPECT_TRUE(desk.plans.mission.empty());
}

TEST(MissionItemNow, WithCurrentTwoIsAGuidedGoto) {
  Desk desk;
  auto item = desk.make.waypoint(10, 0, 15);
  item.current = 2;
  desk.give(item, 0);
  EXPECT_EQ(desk.results(), Results{accepted});
  EXPECT_EQ(desk.went_to.size(), 1u);
}

MissionItem zone(Desk const& desk, MavCmd command, float p1, double north) {
  auto item = desk.make.at(command, {north, 0, 0}, {p1});
  item.frame = MavFrame::global;
  item.type = MissionType::fence;
  return item;
}

TEST(FenceUpload, TakesPolygonsAndCircles) {
  Desk desk;
  desk.count(4, MissionType::fence);
  for (int i = 0; i < 3; ++i) desk.give(zone(desk, MavCmd::nav_fence_polygon_vertex_inclusion, 3, 100.0 * i), i);
  desk.give(zone(desk, MavCmd::nav_fence_circle_exclusion, 20, 10), 3);
  EXPECT_EQ(desk.results(), Results{accepted});
  EXPECT_EQ(desk.said, std::vector<std::string>{"Fence Indexed OK"});
  EXPECT_EQ(desk.plans.fence.size(), 4u);
  EXPECT_EQ(desk.zone_changes, 1);
  EXPECT_FALSE(desk.plans.fence[0].autocontinue);
  EXPECT_TRUE(desk.plans.mission.empty());
}

TEST(FenceUpload, OfNothingIsTakenAndToldLikeAnyOther) {
  Desk desk;
  desk.count(0, MissionType::fence);
  desk.hear(MissionClearAll{.target = {}, .type = MissionType::fence});
  desk.count(0, MissionType::mission);
  EXPECT_EQ(desk.results(), (Results{accepted, accepted, accepted}));
  EXPECT_EQ(desk.said, (std::vector<std::string>{"Fence Indexed OK", "Fence Indexed OK", "Flight plan received"}));
}

TEST(FenceUpload, RefusesAPolygonOfTwoAndForeignItems) {
  Desk desk;
  desk.count(2, MissionType::fence);
  for (int i = 0; i < 2; ++i) desk.give(zone(desk, MavCmd::nav_fence_polygon_vertex_inclusion, 2, 100.0 * i), i);
  EXPECT_EQ(desk.results(), Results{error});
  EXPECT_EQ(desk.said[0], "Invalid vertex count (2)");
  desk.count(1, MissionType::fence);
  desk.give(zone(desk, MavCmd::nav_waypoint, 0, 0), 0);
  EXPECT_EQ(desk.results().back(), unsupported);
  EXPECT_TRUE(desk.plans.fence.empty());
}

TEST(RallyUpload, TakesRallyPoints) {
  Desk desk;
  desk.count(1, MissionType::rally);
  auto point = zone(desk, MavCmd::nav_rally_point, 0, 50);
  point.type = MissionType::rally;
  desk.give(point, 0);
  EXPECT_EQ(desk.results(), Results{accepted});
  EXPECT_EQ(desk.plans.rally.size(), 1u);
}

// ---- over the wire

TEST(MissionSetCurrent, IsAnsweredByMissionCurrentAndABadNumberByNothing) {
  TestGround station("copter");
  station.boot();
  auto const make = station.maker();
  EXPECT_EQ(station.upload({make.waypoint(0, 0, 0), make.take_off(10), make.waypoint(10, 0, 10)}), accepted);
  station.send(MissionSetCurrent{.target = {}, .seq = 2});
  station.run_for(100ms);
  ASSERT_TRUE(station.last<MissionCurrent>().has_value());
  EXPECT_EQ(station.last<MissionCurrent>()->seq, 2);
  EXPECT_EQ(station.last<MissionCurrent>()->total, 2);
  EXPECT_EQ(station.last<MissionCurrent>()->state, MissionState::not_started);
  auto const from = station.heard.size();
  station.send(MissionSetCurrent{.target = {}, .seq = 9});
  station.run_for(1s);
  EXPECT_TRUE(station.all<MissionCurrent>(1, from).empty());
  EXPECT_EQ(station.command(MavCmd::do_set_mission_current, {9}), MavResult::denied);
  EXPECT_EQ(station.command(MavCmd::do_set_mission_current, {1}), MavResult::accepted);
}

TEST(MissionClear, InAutoLeavesTheVehicleHolding) {
  TestGround station("copter");
  auto const make = station.maker();
  station.fly({make.waypoint(0, 0, 0), make.take_off(10), make.waypoint(200, 0, 10)});
  station.run_for(15s);
  station.request(MessageId::mission_current, 5);
  station.send(MissionClearAll{});
  station.run_for(8s);
  EXPECT_EQ(station.last<MissionCurrent>()->state, MissionState::no_mission);
  EXPECT_EQ(station.last<MissionCurrent>()->seq, 0);
  EXPECT_LT(station.pilot().body().ground_speed_m_s(), 0.2);
  EXPECT_TRUE(station.pilot().armed());
}

}  // namespace
}  // namespace lapwing::sim
