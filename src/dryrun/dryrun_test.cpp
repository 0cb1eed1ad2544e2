#include <cmath>

#include <gtest/gtest.h>

#include "dryrun/analysis.hpp"
#include "dryrun/missions.hpp"
#include "dryrun/recorder.hpp"
#include "dryrun/text.hpp"
#include "dryrun/words.hpp"
#include "missions/mission_task.hpp"

namespace lapwing::dryrun {
namespace {

using namespace std::chrono_literals;
using base::Duration;
using Kind = tasks::TaskEvent::Kind;

std::vector<VehicleRecord> crew(int count) {
  std::vector<VehicleRecord> vehicles;
  for (int i = 1; i <= count; ++i) {
    VehicleRecord vehicle;
    vehicle.id = std::to_string(i);
    vehicle.name = "copter " + vehicle.id;
    vehicles.push_back(std::move(vehicle));
  }
  return vehicles;
}

Sample sample(double north, double up, double used_mah = 0.0) {
  return {.place_m = {north, 0.0, -up},
          .mode = "AUTO",
          .remaining = 1.0 - used_mah / 5000.0,
          .used_mah = used_mah,
          .voltage_v = 12.0,
          .in_the_air = up > 0.0,
          .moves = false};
}

tasks::TaskEvent event(Duration time, Kind kind, std::string task, std::string detail = {}) {
  return {.time = base::TimePoint(time),
          .kind = kind,
          .task = std::move(task),
          .vehicle = vehicle::VehicleId{"1"},
          .detail = std::move(detail),
          .subject = {}};
}

TEST(Recorder, CountsEnergyAndTimeInTheAir) {
  Recorder recorder(crew(1), {});
  recorder.sample(0s, std::vector{sample(0, 0)});
  recorder.sample(1s, std::vector{sample(0, 5, 100)});
  recorder.sample(3s, std::vector{sample(10, 5, 250)});
  auto const record = recorder.finish(3s);
  auto const& copter = record.vehicles.front();
  EXPECT_EQ(copter.under_way, 3s);
  EXPECT_NEAR(copter.charge.back().used_wh, 3.0, 1e-5);
  EXPECT_TRUE(copter.ends_in_the_air);
  ASSERT_EQ(copter.modes.size(), 1U);
  EXPECT_EQ(copter.modes.front().mode, "AUTO");
}

TEST(Recorder, CountsOnWhenAPackWasChanged) {
  Recorder recorder(crew(1), {});
  recorder.sample(0s, std::vector{sample(0, 5, 100)});
  recorder.sample(1s, std::vector{sample(0, 5, 350)});
  recorder.sample(2s, std::vector{sample(0, 0, 0)});
  recorder.sample(3s, std::vector{sample(0, 5, 250)});
  auto const record = recorder.finish(3s);
  auto const& charge = record.vehicles.front().charge;
  EXPECT_NEAR(charge[2].used_wh, 3.0, 1e-5);
  EXPECT_NEAR(charge.back().used_wh, 6.0, 1e-5);
  EXPECT_NEAR(charge.back().remaining, 0.95, 1e-5);
}

TEST(Recorder, KeepsMemoryBoundedAndTheEnds) {
  Recorder recorder(crew(2), {.max_points = 200});
  Duration now{};
  for (int i = 0; i < 500; ++i, now += recorder.period())
    recorder.sample(now, std::vector{sample(i, 1, i * 0.1), sample(-i, 1, i * 0.1)});
  auto const record = recorder.finish(now);
  EXPECT_GT(record.sample_period, 200ms);
  for (auto const& vehicle : record.vehicles) {
    EXPECT_LE(vehicle.track.size(), 101U);
    EXPECT_GE(vehicle.track.size(), 40U);
    EXPECT_EQ(vehicle.track.size(), vehicle.charge.size());
    EXPECT_EQ(vehicle.track.front().time, 0s);
    EXPECT_NEAR(vehicle.track.back().place_m.north * (vehicle.id == "1" ? 1 : -1), 499.0, 1e-9);
    EXPECT_NEAR(vehicle.charge.back().used_wh, 49.9 * 12.0 * 1e-3, 0.01);
    for (std::size_t i = 1; i < vehicle.track.size(); ++i) EXPECT_LT(vehicle.track[i - 1].time, vehicle.track[i].time);
  }
}

TEST(Recorder, TurnsEventsIntoSpans) {
  Recorder recorder(crew(1), {.max_tasks = 3});
  recorder.note(event(0s, Kind::alloc, "a"));
  recorder.note(event(1s, Kind::start, "a"));
  recorder.note(event(5s, Kind::done, "a"));
  recorder.note(event(5s, Kind::start, "b"));
  recorder.note(event(7s, Kind::error, "b", "refused"));
  recorder.note(event(8s, Kind::start, "a"));
  recorder.note(event(9s, Kind::start, "too many"));
  auto const record = recorder.finish(10s);
  auto const& spans = record.vehicles.front().tasks;
  ASSERT_EQ(spans.size(), 3U);
  EXPECT_EQ(spans[0].ending, TaskSpan::End::done);
  EXPECT_EQ(spans[0].end, 5s);
  EXPECT_EQ(spans[1].ending, TaskSpan::End::failed);
  EXPECT_EQ(spans[1].reason, "refused");
  EXPECT_EQ(spans[2].ending, TaskSpan::End::running);
  EXPECT_EQ(spans[2].end, 10s);
  EXPECT_EQ(record.vehicles.front().tasks_left_out, 1U);
}

TEST(Recorder, KeepsTheScriptsWordsByLine) {
  Recorder recorder({}, {});
  recorder.say(1s, "one\ntw");
  recorder.say(2s, "o\nthree");
  auto const record = recorder.finish(3s);
  ASSERT_EQ(record.remarks.size(), 3U);
  EXPECT_EQ(record.remarks[1].text, "two");
  EXPECT_EQ(record.remarks[1].time, 2s);
  EXPECT_EQ(record.remarks[2].text, "three");
}

TEST(Analysis, SplitsFiguresBySpan) {
  Recorder recorder(crew(1), {});
  for (int i = 0; i <= 10; ++i) recorder.sample(i * 1s, std::vector{sample(2 * i, i, 10 * i)});
  auto const record = recorder.finish(10s);
  auto const first = figures(record.vehicles[0], 0s, 4s);
  auto const second = figures(record.vehicles[0], 4s, 10s);
  EXPECT_NEAR(first.path_m + second.path_m, 10.0 * std::sqrt(5.0), 1e-9);
  EXPECT_NEAR(first.battery_used, 40.0 / 5000.0, 1e-6);
  EXPECT_NEAR(second.energy_wh, 60.0 * 12.0 * 1e-3, 1e-5);
  EXPECT_EQ(first.highest_m, 4.0);
}

TEST(Analysis, ParkedVehiclesDoNotCountAsNear) {
  Recorder recorder(crew(2), {});
  for (int i = 0; i <= 20; ++i) {
    auto parked = sample(3, 0);
    recorder.sample(i * 1s, std::vector{sample(i < 10 ? 0 : 5 * (i - 9), 20), parked});
  }
  auto const record = recorder.finish(20s);
  auto const analysis = analyse(record, {});
  ASSERT_EQ(analysis.pairs.size(), 1U);
  EXPECT_EQ(analysis.pairs[0].approach.time, 11s);  // 10 m from its place, 7 m from the other and 20 m above
  EXPECT_NEAR(analysis.pairs[0].approach.level_m, 7.0, 1e-9);
}

TEST(Analysis, NobodyIsNearWhenNobodyLeaves) {
  Recorder recorder(crew(2), {});
  recorder.sample(0s, std::vector{sample(0, 0), sample(4, 0)});
  recorder.sample(9s, std::vector{sample(0, 30), sample(4, 0)});
  EXPECT_TRUE(analyse(recorder.finish(9s), {}).pairs.empty());
}

TEST(Text, TellsWhatMatters) {
  Recorder recorder(crew(2), {});
  for (int i = 0; i <= 30; ++i) recorder.sample(i * 1s, std::vector{sample(3 * i, 20, i), sample(90 - 3 * i, 20, i)});
  recorder.note(event(1s, Kind::start, "there"));
  recorder.note(event(29s, Kind::done, "there"));
  recorder.say(2s, "off we go\n");
  auto record = recorder.finish(30s);
  record.script = "x.dolphin";
  record.outcome = "unfinished";
  record.waiting_for = {"waitFor (line 3)"};
  plan::Fence const fence{{{.name = "field",
                            .kind = plan::Zone::Kind::inclusion,
                            .polygons = {{{{{-10, -10}, {-10, 10}, {60, 10}, {60, -10}}}}},
                            .lowest_m = {},
                            .highest_m = 120.0}}};
  auto const text = to_text(record, analyse(record, fence), fence);
  for (auto const* words : {"x.dolphin: unfinished after 0:30", "waitFor (line 3)", "copter 1: 90.0 m of path", "there",
                            "off we go", "0.00 m  copter 1 and copter 2 at 0:15", "2 breaches",
                            "inside 'field', up to 120.0 m above home", "30.0 m outside", "still in the air"}) {
    EXPECT_NE(text.find(words), std::string::npos) << words << " is not in\n" << text;
  }
}

TEST(Missions, ReadHeightsInTheFrameOfEachItem) {
  plan::Mission mission{.name = "m", .home = std::nullopt, .planned_home = std::nullopt, .items = {}};
  auto const add = [&](mavlink::MavFrame frame, double lat_deg, double z_m) {
    auto const place = geo::Wgs84::from_degrees(lat_deg, lat_deg == 0.0 ? 0.0 : -8.0, z_m);
    mavlink::MissionItem item;
    item.command = mavlink::MavCmd::nav_waypoint;
    item.frame = frame;
    item.place = {.lat_rad = place.lat_rad, .lon_rad = place.lon_rad, .z_m = z_m};
    mission.items.push_back(item);
  };
  add(mavlink::MavFrame::global, 41.0, 120.0);
  add(mavlink::MavFrame::global_relative_alt, 41.001, 20.0);
  add(mavlink::MavFrame::global_relative_alt, 0.0, 30.0);  // above where it is
  FlightRecord record;
  record.home = geo::Wgs84::from_degrees(41.0, -8.0, 90.0);
  TaskSpan span;
  span.name = "m";
  span.task = std::make_shared<missions::MissionTask const>(mission);
  record.vehicles.emplace_back().tasks.push_back(span);
  auto const tables = missions_of(record);
  ASSERT_EQ(tables.size(), 1U);
  auto const& rows = tables.front().items;
  ASSERT_EQ(rows.size(), 3U);
  EXPECT_NEAR(rows[0].place->alt_m, 120.0, 1e-9);
  EXPECT_NEAR(rows[1].place->alt_m, 110.0, 1e-9);
  EXPECT_NEAR(rows[1].place_m->down, -20.0, 1e-9);
  EXPECT_NEAR(rows[2].place->alt_m, 120.0, 1e-9);
  EXPECT_NEAR(rows[2].place_m->north, rows[1].place_m->north, 1e-6);
}

TEST(Recorder, AFreshBatteryTakesNothingBack) {
  Recorder recorder(crew(1), {});
  for (int i = 0; i <= 10; ++i) recorder.sample(i * 1s, std::vector{sample(i, 1, i <= 5 ? 10 * i : 10 * (i - 5))});
  auto const record = recorder.finish(10s);
  EXPECT_NEAR(figures(record.vehicles[0], 0s, 10s).energy_wh, (50.0 + 40.0) * 12.0 * 1e-3, 0.01);
}

TEST(Words, ReadWell) {
  EXPECT_EQ(clock_text(0s), "0:00");
  EXPECT_EQ(clock_text(125s), "2:05");
  EXPECT_EQ(clock_text(3725s), "1:02:05");
  EXPECT_EQ(length_text(0.123), "0.12 m");
  EXPECT_EQ(length_text(99.96), "100 m");
  EXPECT_EQ(length_text(12345), "12.35 km");
  EXPECT_EQ(number_text(-0.04, 1), "0.0");
  EXPECT_EQ(number_text(-0.06, 1), "-0.1");
  EXPECT_EQ(place_text({0.2, -0.4, 0}), "at home");
  EXPECT_EQ(place_text({-12, 0, 0}), "12 m south of home");
  EXPECT_EQ(place_text({5, -3, 0}), "5 m north and 3 m west of home");
  EXPECT_EQ(difference_text(100, 104), "+4 %");
  EXPECT_EQ(difference_text(0, 104), "");
}

}  // namespace
}  // namespace lapwing::dryrun
