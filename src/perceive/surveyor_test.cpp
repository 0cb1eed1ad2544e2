#include "perceive/surveyor.hpp"

#include <algorithm>
#include <map>
#include <numbers>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "base/text/utc_text.hpp"
#include "explore/simulated/car_park.hpp"

namespace lapwing::perceive {
namespace {

using namespace std::chrono_literals;

auto const anchor = geo::Wgs84::from_degrees(43.2585, -79.9201, 100.0);
constexpr double step_s = 0.25;

base::UtcTime at(double seconds) {
  return base::UtcTime(std::chrono::hours(24 * 365 * 50)) +
         std::chrono::duration_cast<base::UtcTime::duration>(base::from_seconds(seconds));
}

video::BodyPlace place(geo::Point3<geo::SiteFrame> const& where, double yaw_rad) {
  return {where, Eigen::Quaterniond(Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitZ()))};
}

SurveyOrder order_for(explore::CarPark const& park) {
  auto const site = geo::Site::make("lot", anchor).value();
  SurveyOrder order;
  for (auto const& corner : park.area().rings.front())
    order.area.push_back(site.place_of(geo::Point3<geo::SiteFrame>(corner.x(), corner.y(), 0.0)));
  order.planner.camera = geo::pinhole(1280, 720, 1.0821);
  return order;
}

/// A drone that is where it was told to be, at 5 m/s.
struct Flight {
  explore::CarPark park{1};
  SurveyOrder order = order_for(park);
  geo::Point3<geo::SiteFrame> home{park.home().x(), park.home().y(), 0.0};
  geo::Point3<geo::SiteFrame> drone = home + geo::Vector3<geo::SiteFrame>(0.0, 0.0, 10.0);
  double yaw_rad = 0.0;
  double now_s = 0.0;
  double home_by_s = std::numeric_limits<double>::infinity();
  bool shows_slots = true;

  Conclusion step(Surveyor& surveyor, bool explores) {
    News news{.now = at(now_s), .drone = place(drone, yaw_rad), .flying_s = home_by_s - now_s, .explores = explores};
    news.sight = park.look(
        {.lens = order.planner.camera, .site_from_camera = geo::camera_at(drone, yaw_rad + order.camera_yaw_rad, 0.0)},
        at(now_s), now_s);
    if (!shows_slots) news.sight->slots.clear();
    auto conclusion = surveyor.think(std::move(news));
    now_s += step_s;
    if (!conclusion.goal) return conclusion;
    constexpr double speed_m_s = 5.0;
    auto const way = conclusion.goal->place - drone;
    double const share = std::min(1.0, speed_m_s * step_s / std::max(1e-6, way.v.norm()));
    drone = drone + share * way;
    yaw_rad = conclusion.goal->yaw_rad;
    return conclusion;
  }
};

TEST(Surveyor, LeadsUntilTheCarParkIsKnown) {
  Flight flight;
  auto surveyor = Surveyor::make(flight.order, {.anchor = anchor, .home = flight.home}, {}).value();
  std::optional<std::string> report;
  for (int i = 0; i < 1600 && !report; ++i) report = flight.step(surveyor, true).report;
  ASSERT_TRUE(report);
  EXPECT_NE(report->find("nothing more to learn"), std::string::npos) << *report;
  auto const after = flight.step(surveyor, true);
  EXPECT_FALSE(after.goal);
  EXPECT_FALSE(after.report) << "it is told once";
  EXPECT_EQ(after.sees_lot, true);
  EXPECT_GT(after.figures.coverage, 0.98);
  EXPECT_GT(after.figures.slots, 0.97 * static_cast<double>(flight.park.slots().size()));

  // Told to explore again, it looks again, and has nothing to do.
  (void)flight.step(surveyor, false);
  EXPECT_TRUE(flight.step(surveyor, true).report);
}

TEST(Surveyor, SaysWhatToDoWhenItFoundNoSlotAtAll) {
  Flight flight;
  flight.shows_slots = false;
  auto surveyor = Surveyor::make(flight.order, {.anchor = anchor, .home = flight.home}, {}).value();
  std::optional<std::string> report;
  for (int i = 0; i < 1600 && !report; ++i) report = flight.step(surveyor, true).report;
  ASSERT_TRUE(report);
  EXPECT_NE(report->find("% of the area seen, no slot found: fly higher"), std::string::npos) << *report;
}

TEST(Surveyor, LeadsOnlyWhileTheDroneExplores) {
  Flight flight;
  auto surveyor = Surveyor::make(flight.order, {.anchor = anchor, .home = flight.home}, {}).value();
  EXPECT_FALSE(flight.step(surveyor, false).goal);
  EXPECT_TRUE(flight.step(surveyor, true).goal);
  EXPECT_FALSE(flight.step(surveyor, false).goal);
}

TEST(Surveyor, StaysBetweenTheHoverHeights) {
  Flight flight;
  HoverHeights const heights{.lowest_m = 8.0, .desired_m = 9.0, .highest_m = 12.0};
  flight.home = {flight.home.x(), flight.home.y(), 3.0};
  auto surveyor = Surveyor::make(flight.order, {.anchor = anchor, .home = flight.home}, heights).value();
  for (int i = 0; i < 40; ++i) {
    auto const goal = flight.step(surveyor, true).goal;
    ASSERT_TRUE(goal);
    EXPECT_GT(goal->place.z(), 3.0 + 8.0);
    EXPECT_LT(goal->place.z(), 3.0 + 12.0);
  }
  ASSERT_TRUE(surveyor.adapt(flight.home, {.lowest_m = 14.0, .desired_m = 15.0, .highest_m = 16.0}));
  EXPECT_GT(flight.step(surveyor, true).goal->place.z(), 3.0 + 14.0);
}

TEST(Surveyor, TurnsTheDroneSoThatItsCameraLooksRight) {
  Flight ahead;
  Flight aside;
  aside.order.camera_yaw_rad = 0.5;
  auto one = Surveyor::make(ahead.order, {.anchor = anchor, .home = ahead.home}, {}).value();
  auto other = Surveyor::make(aside.order, {.anchor = anchor, .home = aside.home}, {}).value();
  aside.yaw_rad = ahead.yaw_rad - 0.5;
  auto const goal = ahead.step(one, true).goal;
  auto const turned = aside.step(other, true).goal;
  ASSERT_TRUE(goal && turned);
  EXPECT_NEAR(geo::wrap_pi(goal->yaw_rad - turned->yaw_rad), 0.5, 1e-9);
  EXPECT_EQ(goal->place, turned->place);
}

TEST(Surveyor, EndsWhenItsTimeIsOver) {
  Flight flight;
  flight.order.most_s = 20.0;
  auto surveyor = Surveyor::make(flight.order, {.anchor = anchor, .home = flight.home}, {}).value();
  std::optional<std::string> report;
  while (!report && flight.now_s < 40.0) report = flight.step(surveyor, true).report;
  ASSERT_TRUE(report);
  EXPECT_NE(report->find("is over: time"), std::string::npos) << *report;
  EXPECT_LT(flight.now_s, 22.0);
}

TEST(Surveyor, IsOverHomeBeforeItsEnergyIsSpent) {
  Flight flight;
  flight.home_by_s = 60.0;
  auto surveyor = Surveyor::make(flight.order, {.anchor = anchor, .home = flight.home}, {}).value();
  std::optional<std::string> report;
  while (!report && flight.now_s < flight.home_by_s) report = flight.step(surveyor, true).report;
  ASSERT_TRUE(report);
  EXPECT_NE(report->find("is over: energy"), std::string::npos) << *report;
  EXPECT_GT(flight.now_s, 30.0) << "it has surveyed as long as it could";
  auto const turned_at_m = flight.drone.z();
  auto const far_m = [&] { return std::hypot(flight.drone.x() - flight.home.x(), flight.drone.y() - flight.home.y()); };
  EXPECT_GT(far_m(), 10.0) << "it was not there by chance";
  while (far_m() > 1.0 && flight.now_s < flight.home_by_s) EXPECT_FALSE(flight.step(surveyor, true).report);
  EXPECT_LE(far_m(), 1.0);
  // It waits there, at its height, and is not led any more when it is told otherwise.
  for (int i = 0; i < 40; ++i) {
    auto const goal = flight.step(surveyor, true).goal;
    ASSERT_TRUE(goal);
    EXPECT_EQ(goal->place.z(), turned_at_m);
  }
  EXPECT_LE(far_m(), 1.0);
  EXPECT_FALSE(flight.step(surveyor, false).goal);
}

TEST(Surveyor, AnswersWhetherAPlaceIsInTheLot) {
  Flight flight;
  auto surveyor = Surveyor::make(flight.order, {.anchor = anchor, .home = flight.home}, {}).value();
  auto const inside = explore::middle_of(flight.park.slots().front().outline);
  EXPECT_EQ(surveyor.think({.now = at(0.0), .wanted = inside}).is_in_lot, true);
  EXPECT_EQ(surveyor.think({.now = at(0.0), .wanted = map::SitePoint(900.0, 0.0)}).is_in_lot, false);
  EXPECT_FALSE(surveyor.think({.now = at(0.0)}).is_in_lot);
}

TEST(Surveyor, LosesALotInWhichItFindsNoSlot) {
  Flight flight;
  flight.order.lot_lost = 5s;
  auto surveyor = Surveyor::make(flight.order, {.anchor = anchor, .home = flight.home}, {}).value();
  explore::LotSight const empty{
      .vehicle = "d",
      .at = at(0.0),
      .view = {.lens = flight.order.planner.camera,
               .site_from_camera = geo::camera_at(
                   {flight.park.area().rings[0][0].x(), flight.park.area().rings[0][0].y(), 10.0}, 0.0, 0.0)}};
  std::optional<bool> sees;
  for (double s = 0.0; s < 5.5; s += step_s) {
    auto sight = empty;
    sight.at = at(s);
    sees = surveyor.think({.now = at(s), .sight = sight}).sees_lot;
    if (s < 4.0) {
      EXPECT_FALSE(sees) << "nobody knows yet";
    }
  }
  EXPECT_EQ(sees, false);
}

TEST(Surveyor, WritesWhatItFound) {
  Flight flight;
  auto surveyor = Surveyor::make(flight.order, {.anchor = anchor, .home = flight.home}, {}).value();
  for (int i = 0; i < 240; ++i) (void)flight.step(surveyor, true);
  auto const json = nlohmann::json::parse(surveyor.slots_text(at(flight.now_s + 10.0)));
  ASSERT_GT(json["features"].size(), 20U);
  EXPECT_EQ(json["survey"]["slots"], json["features"].size());
  EXPECT_EQ(json["survey"]["is_over"], false);
  auto const line = nlohmann::json::parse(surveyor.slots_line());
  EXPECT_EQ(line["features"].size(), json["features"].size());
  EXPECT_GT(line["survey"]["coverage"], 0.3);
  EXPECT_EQ(line["survey"]["begun"], base::utc_text(at(0.0)));
  auto const& slot = json["features"][0];
  EXPECT_EQ(slot["geometry"]["type"], "Polygon");
  EXPECT_NEAR(slot["geometry"]["coordinates"][0][0][0].get<double>(), anchor.lon_deg(), 0.005);
  EXPECT_GE(slot["properties"]["age_s"].get<double>(), 10.0);
  EXPECT_TRUE(slot["properties"].contains("taken_probability"));
}

/// What a process that was killed has left, and what its successor makes of it.
struct TakenUp {
  Surveyor surveyor;
  std::map<std::string, nlohmann::json> before;
  double coverage = 0.0;
};

std::map<std::string, nlohmann::json> slots_of(Surveyor const& surveyor) {
  std::map<std::string, nlohmann::json> slots;
  auto const line = nlohmann::json::parse(surveyor.slots_line());
  for (auto const& slot : line["features"]) slots.emplace(slot["id"], slot["properties"]);
  return slots;
}

double coverage_of(Surveyor const& surveyor) {
  return nlohmann::json::parse(surveyor.slots_line())["survey"]["coverage"];
}

TakenUp taken_up(Flight& flight, int steps) {
  SurveyGround const ground{.anchor = anchor, .home = flight.home};
  auto first = Surveyor::make(flight.order, ground, {}).value();
  for (int i = 0; i < steps; ++i) (void)flight.step(first, true);
  auto const text = first.memory(at(flight.now_s), at(0.0));
  flight.now_s += 2.0;
  auto second = Surveyor::make(flight.order, ground, {}).value();
  second.recall(read_memory(text, second.site()).value(), at(flight.now_s));
  return {.surveyor = std::move(second), .before = slots_of(first), .coverage = coverage_of(first)};
}

TEST(Surveyor, TakesUpTheMapOfAnEarlierProcess) {
  Flight flight;
  auto const [surveyor, before, coverage] = taken_up(flight, 240);
  ASSERT_GT(before.size(), 20U);
  auto const after = slots_of(surveyor);
  for (auto const& [id, properties] : before) {
    ASSERT_TRUE(after.contains(id)) << id;
    EXPECT_EQ(after.at(id), properties) << id << ": state and age are those of before";
  }
  EXPECT_LT(after.size(), before.size() + 5U);
  EXPECT_NEAR(coverage_of(surveyor), coverage, 0.005);
  EXPECT_EQ(nlohmann::json::parse(surveyor.slots_line())["survey"]["begun"], base::utc_text(at(0.0)));
}

TEST(Surveyor, SurveysOnWithTheMapOfAnEarlierProcess) {
  Flight whole;
  auto undisturbed = Surveyor::make(whole.order, {.anchor = anchor, .home = whole.home}, {}).value();
  while (!whole.step(undisturbed, true).report) ASSERT_LT(whole.now_s, 600.0);

  Flight flight;
  auto [surveyor, before, coverage] = taken_up(flight, 400);
  while (!flight.step(surveyor, true).report) ASSERT_LT(flight.now_s, 600.0);
  EXPECT_LT(flight.now_s, 1.15 * whole.now_s) << "nothing is flown twice";
  auto const after = slots_of(surveyor);
  auto const kept = std::ranges::count_if(before, [&](auto const& one) { return after.contains(one.first); });
  EXPECT_GT(static_cast<double>(kept), 0.97 * static_cast<double>(before.size()));
  EXPECT_GT(after.size(), before.size()) << "and new ones have other ids";
}

TEST(Surveyor, OfAnEarlierProcessThatWasOverSaysNothingTwice) {
  Flight flight;
  flight.order.most_s = 20.0;
  auto [surveyor, before, coverage] = taken_up(flight, 120);
  auto const conclusion = flight.step(surveyor, true);
  EXPECT_FALSE(conclusion.report);
  EXPECT_FALSE(conclusion.goal);
  EXPECT_EQ(conclusion.figures.ending, "time");
}

TEST(Surveyor, RefusesWhatIsNoArea) {
  Flight flight;
  flight.order.area.resize(2);
  EXPECT_FALSE(Surveyor::make(flight.order, {.anchor = anchor}, {}));
}

}  // namespace
}  // namespace lapwing::perceive
