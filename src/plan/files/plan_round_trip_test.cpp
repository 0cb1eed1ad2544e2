// Random plans through every format: what is read is what was written, less what the writer said would be lost.
#include <cmath>
#include <limits>
#include <random>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "plan/files/plan_file.hpp"

namespace lapwing::plan {
namespace {

using mavlink::MavCmd;
using mavlink::MavFrame;
using mavlink::MissionItem;

class Dice {
 public:
  explicit Dice(unsigned seed) : random_(seed) {}
  int upto(int most) { return std::uniform_int_distribution(0, most)(random_); }
  bool is_one_in(int n) { return upto(n - 1) == 0; }
  template <class T>
  T one_of(std::vector<T> const& choices) {
    return choices[static_cast<std::size_t>(upto(static_cast<int>(choices.size()) - 1))];
  }
  /// To 1e-7 degrees, as vehicles have it.
  geo::Wgs84 place() {
    return geo::Wgs84::from_degrees(upto(1'800'000'000) / 1e7 - 90.0, upto(2'000'000'000) / 1e7 - 100.0,
                                    upto(99'999) / 100.0);
  }
  float param() {
    if (is_one_in(5)) return std::numeric_limits<float>::quiet_NaN();
    if (is_one_in(3)) return static_cast<float>(upto(1000)) / 7.0F;
    return static_cast<float>(upto(100)) - 20.0F;
  }

 private:
  std::mt19937 random_;
};

MissionItem random_item(Dice& dice, int count) {
  MissionItem item;
  item.command = dice.one_of<MavCmd>({MavCmd::nav_waypoint, MavCmd::nav_takeoff, MavCmd::nav_loiter_time,
                                      MavCmd::nav_land, MavCmd::do_change_speed, MavCmd::do_set_servo, MavCmd::do_jump,
                                      MavCmd::do_set_roi_location, MavCmd::nav_return_to_launch, MavCmd::nav_delay});
  for (auto& param : item.params) param = dice.param();
  item.autocontinue = !dice.is_one_in(4);
  item.frame = dice.one_of<MavFrame>({MavFrame::global, MavFrame::global_relative_alt, MavFrame::global_terrain_alt});
  if (dice.is_one_in(20)) item.frame = MavFrame::local_ned;
  if (dice.is_one_in(30)) item.command = MavCmd{31010};
  if (mavlink::has_place(item.command) && mavlink::is_global(item.frame)) {
    auto const place = dice.place();
    item.place = {.lat_rad = place.lat_rad, .lon_rad = place.lon_rad, .z_m = place.alt_m};
  } else {
    item.place = {.x = dice.upto(500) - 250.0, .y = dice.upto(9) / 10.0, .z_m = dice.upto(100) / 10.0};
    if (!mavlink::has_place(item.command)) item.frame = MavFrame::mission;
  }
  if (item.command == MavCmd::do_jump) {
    item.params[0] = static_cast<float>(1 + dice.upto(count - 1));
    item.params[1] = static_cast<float>(dice.upto(6) - 1);
  }
  return item;
}

GeoRing random_ring(Dice& dice) {
  GeoRing ring;
  for (int i = 3 + dice.upto(4); i > 0; --i) {
    auto corner = dice.place();
    corner.alt_m = 0.0;
    ring.push_back(corner);
  }
  return ring;
}

GeoZone random_zone(Dice& dice) {
  GeoZone zone{.kind = dice.is_one_in(2) ? Zone::Kind::inclusion : Zone::Kind::exclusion, .area = {}};
  if (dice.is_one_in(3)) zone.name = dice.one_of<std::string>({"field", "mast & \"wires\" <2>", "Wiese \xC3\xBC"});
  if (dice.is_one_in(5)) zone.lowest = HeightLimit{dice.upto(100) / 10.0, dice.is_one_in(2)};
  if (dice.is_one_in(5)) zone.highest = HeightLimit{100.5 + dice.upto(100), dice.is_one_in(2)};
  if (dice.is_one_in(3)) {
    auto center = dice.place();
    center.alt_m = 0.0;
    zone.area = GeoCircle{center, 0.5 + dice.upto(1000)};
    return zone;
  }
  std::vector<GeoPolygon> polygons(dice.is_one_in(4) ? 2 : 1);
  for (auto& polygon : polygons)
    for (int rings = dice.is_one_in(4) ? 2 : 1; rings > 0; --rings) polygon.rings.push_back(random_ring(dice));
  zone.area = std::move(polygons);
  return zone;
}

/// A survey as QGroundControl stores one, of the two items from `first` on.
Pattern random_survey(std::size_t first) {
  auto const stored = [](std::size_t id) {
    return nlohmann::json{{"type", "SimpleItem"}, {"doJumpId", id},       {"command", 0},
                          {"frame", 0},           {"autoContinue", true}, {"params", nlohmann::json::array()}};
  };
  nlohmann::json const survey{
      {"type", "ComplexItem"},
      {"complexItemType", "survey"},
      {"angle", 77.5},
      {"polygon", {{41.0, -8.0}, {41.1, -8.0}, {41.0, -8.1}}},
      {"TransectStyleComplexItem",
       {{"version", 2}, {"TurnAroundDistance", 10.25}, {"Items", {stored(first + 1), stored(first + 2)}}}}};
  return {.first = first, .count = 2, .json = survey.dump()};
}

Plan random_plan(unsigned seed) {
  Dice dice(seed);
  Plan plan;
  if (!dice.is_one_in(3)) plan.mission.planned_home = dice.place();
  int const count = dice.is_one_in(5) ? 0 : 1 + dice.upto(11);
  for (int i = 0; i < count; ++i) plan.mission.items.push_back(random_item(dice, count));
  if (count >= 5 && dice.is_one_in(2))
    plan.patterns.push_back(random_survey(static_cast<std::size_t>(dice.upto(2)) + 1));
  if (dice.is_one_in(4))
    plan.patterns.push_back({.first = static_cast<std::size_t>(count),
                             .count = 0,
                             .json = R"({"Layers":3,"complexItemType":"StructureScan","type":"ComplexItem"})"});
  if (dice.is_one_in(2)) plan.cruise_speed_m_s = 15.5;
  if (dice.is_one_in(2)) plan.hover_speed_m_s = 5.0;
  plan.firmware_type = dice.one_of<int>({0, 3, 12});
  plan.vehicle_type = dice.one_of<int>({0, 1, 2});
  for (int i = dice.upto(4); i > 0; --i) plan.fence.zones.push_back(random_zone(dice));
  if (dice.is_one_in(3)) plan.fence.breach_return = dice.place();
  for (int i = dice.upto(3); i > 0; --i)
    plan.rally.push_back({dice.place(), dice.is_one_in(3) ? MavFrame::global : MavFrame::global_relative_alt});
  return plan;
}

std::string text_of(geo::Wgs84 const& place) {
  return fmt::format("{:.9f} {:.9f} {:.6f}", place.lat_deg(), place.lon_deg(), place.alt_m);
}
std::string text_of(std::optional<geo::Wgs84> const& place) {
  return place ? text_of(*place) : "none";
}
std::string text_of(std::optional<HeightLimit> const& limit) {
  return limit ? fmt::format("{} {}", limit->height_m, limit->is_above_sea) : "none";
}

std::string text_of(MissionItem const& item) {
  bool const is_placed = mavlink::has_place(item.command) && mavlink::is_global(item.frame);
  return fmt::format(
      "{} frame {} params {} auto {} at {}\n", to_string(item.command), static_cast<int>(item.frame),
      fmt::join(item.params, " "), item.autocontinue,
      is_placed ? text_of(position_of(item)) : fmt::format("{} {} {}", item.place.x, item.place.y, item.place.z_m));
}

std::string text_of(GeoZone const& zone) {
  auto text = fmt::format("zone '{}' {} {} {}:", zone.name, static_cast<int>(zone.kind), text_of(zone.lowest),
                          text_of(zone.highest));
  if (auto const* circle = std::get_if<GeoCircle>(&zone.area))
    return fmt::format("{} {} radius {}\n", text, text_of(circle->center), circle->radius_m);
  for (auto const& polygon : std::get<std::vector<GeoPolygon>>(zone.area)) {
    text += " polygon";
    for (auto const& ring : polygon.rings) {
      text += " ring";
      for (auto const& corner : ring) text += ", " + text_of(corner);
    }
  }
  return text + "\n";
}

/// Everything in a plan but its name. Stored items of patterns stand in the mission.
std::string text_of(Plan const& plan) {
  auto text = fmt::format("home {} {} speeds {} {} for {} {}\n", text_of(plan.mission.home),
                          text_of(plan.mission.planned_home), plan.cruise_speed_m_s.value_or(-1.0),
                          plan.hover_speed_m_s.value_or(-1.0), plan.firmware_type, plan.vehicle_type);
  for (auto const& item : plan.mission.items) text += text_of(item);
  for (auto const& pattern : plan.patterns) {
    auto json = nlohmann::json::parse(pattern.json);
    if (json.contains("TransectStyleComplexItem")) json["TransectStyleComplexItem"]["Items"] = nullptr;
    text += fmt::format("pattern {} {} {}\n", pattern.first, pattern.count, json.dump());
  }
  for (auto const& zone : plan.fence.zones) text += text_of(zone);
  text += fmt::format("breach return {}\n", text_of(plan.fence.breach_return));
  for (auto const& point : plan.rally)
    text += fmt::format("rally {} {}\n", static_cast<int>(point.frame), text_of(point.place));
  return text;
}

class RoundTrip : public ::testing::TestWithParam<PlanFormat> {};

TEST_P(RoundTrip, LosesWhatWasSaidAndNothingElse) {
  for (unsigned seed = 1; seed <= 300; ++seed) {
    auto const plan = random_plan(seed);
    auto const reduced = reduce(plan, GetParam());
    auto const written = write_plan(plan, GetParam());
    if (!written) {
      EXPECT_TRUE(reduced.plan.mission.items.empty()) << written.error().message;
      continue;
    }
    EXPECT_EQ(written->lost, reduced.lost);
    auto const back = read_plan("a", written->text);
    ASSERT_TRUE(back) << back.error().message << " with seed " << seed << "\n" << written->text;
    ASSERT_EQ(text_of(back->plan), text_of(reduced.plan)) << "with seed " << seed << "\n" << written->text;
    // What is left can be written without a loss.
    EXPECT_TRUE(reduce(back->plan, GetParam()).lost.empty());
    if (!reduced.lost.empty()) continue;
    // What nobody called lost is there.
    EXPECT_EQ(back->plan.mission.items.size(), plan.mission.items.size());
    EXPECT_EQ(back->plan.fence.zones.size(), plan.fence.zones.size());
    EXPECT_EQ(back->plan.rally.size(), plan.rally.size());
    EXPECT_EQ(back->plan.patterns.size(), plan.patterns.size());
  }
}

INSTANTIATE_TEST_SUITE_P(Of, RoundTrip,
                         ::testing::Values(PlanFormat::qgc_plan, PlanFormat::way_points, PlanFormat::kml,
                                           PlanFormat::kmz, PlanFormat::geojson));

TEST(RoundTripOfGeoJson, LosesOnlyWhatNoFileHolds) {
  for (unsigned seed = 1; seed <= 300; ++seed) {
    for (auto const& lost : reduce(random_plan(seed), PlanFormat::geojson).lost) {
      bool const is_expected = lost.contains("command 31010 is not known here") ||
                               lost.contains("has its place in frame 1") || lost.contains("which is not there") ||
                               lost.starts_with("the pattern");
      EXPECT_TRUE(is_expected) << lost;
    }
  }
}

TEST(Reduce, TakesJumpsAlongWithWhatTheyLeadTo) {
  Plan plan;
  plan.mission.items.resize(4);
  plan.mission.items[0].command = MavCmd::nav_waypoint;
  plan.mission.items[1].command = MavCmd{31010};
  plan.mission.items[2] = {.command = MavCmd::do_jump, .params = {2.0F, 1.0F}};
  plan.mission.items[3] = {.command = MavCmd::do_jump, .params = {1.0F, 1.0F}};
  auto const reduced = reduce(plan, PlanFormat::qgc_plan);
  ASSERT_EQ(reduced.plan.mission.items.size(), 2u);
  EXPECT_EQ(reduced.plan.mission.items[1].params[0], 1.0F);
  EXPECT_EQ(reduced.lost,
            (std::vector<std::string>{"item 2: command 31010 is not known here, so neither is what its parameters are",
                                      "item 3: DO_JUMP leads to item 2, which is not there"}));
}

TEST(Reduce, SaysWhatKmlAndWayPointFilesCannotHold) {
  auto plan = random_plan(1);
  plan = {};
  plan.mission.items.resize(2);
  plan.mission.items[0].command = MavCmd::nav_waypoint;
  plan.mission.items[1].command = MavCmd::do_set_servo;
  plan.rally.push_back({});
  plan.hover_speed_m_s = 5.0;
  EXPECT_EQ(
      reduce(plan, PlanFormat::kml).lost,
      (std::vector<std::string>{"item 2: DO_SET_SERVO has no place, and KML holds places", "cruise and hover speed"}));
  EXPECT_EQ(reduce(plan, PlanFormat::way_points).lost,
            (std::vector<std::string>{"cruise and hover speed", "1 rally points: a way point file holds one list"}));
}

TEST(Reduce, LeavesOutHeightsThatCouldNotBeReadAgain) {
  Plan plan;
  plan.mission.items.resize(2);
  for (auto& item : plan.mission.items) item.command = MavCmd::nav_waypoint;
  plan.mission.items[1].place.z_m = std::nan("");  // as vehicles may hold it
  for (auto const format : {PlanFormat::qgc_plan, PlanFormat::way_points, PlanFormat::kml, PlanFormat::geojson}) {
    auto const written = write_plan(plan, format).value();
    EXPECT_EQ(written.lost, std::vector<std::string>{"item 2: NAV_WAYPOINT has no place and height on Earth"});
    EXPECT_TRUE(read_plan("again", written.text));
  }
}

TEST(WritePlan, RefusesToWriteNothing) {
  Plan plan;
  plan.mission.items.resize(1);
  plan.mission.items[0].command = MavCmd::do_set_servo;
  EXPECT_EQ(write_plan(plan, PlanFormat::kml).error().message,
            "nothing of the plan can be written: item 1: DO_SET_SERVO has no place, and KML holds places");
}

}  // namespace
}  // namespace lapwing::plan
