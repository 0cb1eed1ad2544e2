#include <algorithm>
#include <functional>
#include <string>

#include <gtest/gtest.h>

#include "plan/plausibility/judge.hpp"

namespace lapwing::plan::plausibility {
namespace {

using namespace std::chrono_literals;
using geo::Wgs84;
using mavlink::MavCmd;
using mavlink::MavFrame;
using mavlink::MissionItem;
using vehicle::Autopilot;
using vehicle::Family;

constexpr double ground_m = 90.0;
constexpr Wgs84 field = Wgs84::from_degrees(41.1780, -8.5980, ground_m);

Wgs84 at(double north_m, double east_m = 0.0, double up_m = 30.0) {
  return geo::displaced(field, {.north = north_m, .east = east_m, .down = -up_m});
}
Wgs84 degrees(double lat, double lon, double alt_m = ground_m + 30.0) {
  return Wgs84::from_degrees(lat, lon, alt_m);
}

MissionItem item(MavCmd command, Wgs84 place, MavFrame frame = MavFrame::global) {
  MissionItem made;
  made.command = command;
  made.frame = frame;
  made.place = {.lat_rad = place.lat_rad, .lon_rad = place.lon_rad, .z_m = place.alt_m};
  return made;
}
MissionItem above_home(MavCmd command, Wgs84 place, double up_m) {
  place.alt_m = up_m;
  return item(command, place, MavFrame::global_relative_alt);
}
MissionItem take_off(double alt_m = ground_m + 30.0) {
  return item(MavCmd::nav_takeoff, {field.lat_rad, field.lon_rad, alt_m});
}
MissionItem go(Wgs84 place) {
  return item(MavCmd::nav_waypoint, place);
}
MissionItem land(Wgs84 place = field) {
  return item(MavCmd::nav_land, place);
}
Mission mission(std::vector<MissionItem> items, std::optional<Wgs84> home = field) {
  return {.name = "M", .home = home, .items = std::move(items)};
}

Situation standing(Family family = Family::copter, Autopilot autopilot = Autopilot::ardupilot) {
  return {.vehicle = "copter 1",
          .family = family,
          .autopilot = autopilot,
          .position = field,
          .home = field,
          .on_ground = true};
}
Situation in_air(Wgs84 place = at(300)) {
  auto now = standing();
  now.position = place;
  now.on_ground = false;
  return now;
}
Situation with(Situation situation, std::function<void(Situation&)> const& change) {
  change(situation);
  return situation;
}

std::string text(Findings const& findings) {
  std::string all;
  for (auto const& finding : findings)
    all += (finding.severity == Severity::refuse ? "refuse: " : "warn: ") + to_text(finding) + "\n";
  return all;
}
bool has(Findings const& findings, Rule rule) {
  return std::ranges::find(findings, rule, &Finding::rule) != findings.end();
}

struct Wrong {
  std::string name;
  Mission mission;
  Situation situation;
  Rule rule;
  std::string words = {};  ///< some that are said
  bool refuses = true;
};

std::vector<Wrong> wrong_missions() {
  auto const lisbon = degrees(38.7223, -9.1393, 20);
  auto const at_lisbon = [&](double alt_m) { return Wgs84{lisbon.lat_rad, lisbon.lon_rad, alt_m}; };
  auto const flight = [](std::vector<MissionItem> on_the_way, std::optional<Wgs84> home = field) {
    on_the_way.insert(on_the_way.begin(), take_off());
    on_the_way.push_back(land());
    return mission(std::move(on_the_way), home);
  };
  auto const square = GeoFence{.zones = {{.area = GeoCircle{field, 200.0}}}};
  auto const tower =
      GeoFence{.zones = {{.name = "tower", .kind = Zone::Kind::exclusion, .area = GeoCircle{at(100), 20.0}}}};
  return {
      // Where.
      {"the script of Lisbon", mission({item(MavCmd::nav_takeoff, at_lisbon(50)), land(lisbon)}, lisbon), standing(),
       Rule::home_moved, "another place"},
      {"home 400 m beside", flight({}, at(400, 0, 0)), standing(), Rule::home_moved, "400 m"},
      {"home 150 m beside", flight({}, at(0, 150, 0)), standing(), Rule::home_moved, "150 m"},
      {"home moved in the air", mission({go(at(300))}, at(300, 300, 0)), in_air(at(0, 0, 30)), Rule::home_moved},
      {"home swapped", flight({}, degrees(-8.5980, 41.1780, 90)), standing(), Rule::home_moved, "swapped"},
      {"home east instead of west", flight({}, degrees(41.1780, 8.5980, 90)), standing(), Rule::home_moved, "its sign"},
      {"home at zero", flight({}, degrees(0, 0, 90)), standing(), Rule::zero_coordinates},
      {"a place at zero", flight({go(degrees(0, 0))}), standing(), Rule::zero_coordinates},
      {"a place nearly at zero", flight({go(degrees(0.001, 0))}), standing(), Rule::zero_coordinates},
      {"a place swapped", flight({go(degrees(-8.5981, 41.1781))}), standing(), Rule::too_far, "swapped"},
      {"a place east instead of west", flight({go(degrees(41.178, 8.598))}), standing(), Rule::too_far, "its sign"},
      {"a place south instead of north", flight({go(degrees(-41.178, -8.598))}), standing(), Rule::too_far, "its sign"},
      {"a digit", flight({go(degrees(41.278, -8.598))}), standing(), Rule::too_far, "11.1 km"},
      {"a degree", flight({go(degrees(42.178, -8.598))}), standing(), Rule::too_far, "111 km"},
      {"no home, first place in Lisbon", mission({take_off(), go(at_lisbon(120)), land()}, std::nullopt), standing(),
       Rule::too_far},
      {"60 km for a plane", flight({go(at(60'000))}), standing(Family::plane), Rule::too_far},
      {"12 km for a rover", mission({go(at(12'000, 0, 0))}), standing(Family::rover), Rule::too_far},
      {"ends that are far from each other", flight({go(at(9'000)), go(at(-9'000))}), standing(), Rule::too_far,
       "from item"},
      {"outside its fence", flight({go(at(300))}), with(standing(), [&](auto& s) { s.fence = square; }),
       Rule::outside_fence},
      {"through a no-fly zone", flight({go(at(200))}), with(standing(), [&](auto& s) { s.fence = tower; }),
       Rule::outside_fence, "tower"},
      {"longer than the battery", flight({go(at(9'000))}), with(standing(), [](auto& s) { s.endurance = 900s; }),
       Rule::battery, "min", false},
      // Height.
      {"home without altitude", flight({}, degrees(41.178, -8.598, 0)), standing(), Rule::home_height, "add 90"},
      {"everything above the ground instead of above the sea",
       mission({take_off(30), go(at(100, 0, 30 - ground_m)), land(degrees(41.178, -8.598, 0))},
               degrees(41.178, -8.598, 0)),
       standing(), Rule::home_height, "above the ground"},
      {"home above the ellipsoid", flight({}, degrees(41.178, -8.598, 145)), standing(), Rule::home_height},
      {"take-off to 20 above the sea", mission({take_off(20), land()}), standing(), Rule::take_off_height, "is 110"},
      {"take-off to home's altitude", mission({take_off(90), land()}), standing(), Rule::take_off_height},
      {"take-off to a metre", mission({take_off(91), land()}), standing(), Rule::take_off_height, "", false},
      {"a file's take-off to nothing", mission({above_home(MavCmd::nav_takeoff, field, 0)}, std::nullopt), standing(),
       Rule::take_off_height},
      {"a place 30 m below home", flight({go(at(100, 0, -30))}), standing(), Rule::below_ground, "30 m below"},
      {"a place 10 m below home, relative", flight({above_home(MavCmd::nav_waypoint, at(100), -10)}), standing(),
       Rule::below_ground},
      {"goPos without a height", flight({go(degrees(41.179, -8.598, 0))}), standing(), Rule::below_ground, "above sea"},
      {"along the ground", flight({go(at(100, 0, 0))}), standing(), Rule::below_ground, "", false},
      {"a plane that lands 60 m under the ground",
       mission({take_off(), go(at(300)), land(degrees(41.178, -8.598, 30))}), standing(Family::plane),
       Rule::below_ground},
      {"600 m up", flight({go(at(100, 0, 600))}), standing(), Rule::ceiling},
      {"150 m up", flight({go(at(100, 0, 150))}), standing(), Rule::ceiling, "120 m", false},
      {"the sea's altitude above home", flight({above_home(MavCmd::nav_waypoint, at(100), 850)}, std::nullopt),
       with(standing(), [](auto& s) { s.home->alt_m = s.position->alt_m = 820.0; }), Rule::ceiling, "above sea level"},
      // Sequence.
      {"no take-off", mission({go(at(100)), land()}), standing(), Rule::no_take_off},
      {"no take-off with PX4", mission({go(at(100)), land()}), standing(Family::copter, Autopilot::px4),
       Rule::no_take_off, "", false},
      {"no take-off for a VTOL", mission({go(at(100)), land()}), standing(Family::vtol), Rule::no_take_off},
      {"nothing to fly", mission({}), standing(), Rule::empty_mission},
      {"landing on another", flight({}),
       with(standing(),
            [](auto& s) {
              s.position = at(0, 10, 0);
              s.neighbours = {{.name = "copter 2", .stands = field}};
            }),
       Rule::shared_pad, "copter 2", false},
      {"landing where another lands", flight({}),
       with(standing(), [](auto& s) { s.neighbours = {{.name = "copter 2", .lands_at = {at(0, 1, 0)}}}; }),
       Rule::shared_pad, "", false},
      {"another's pad for a home", mission({take_off(), go(at(100))}),
       with(standing(),
            [](auto& s) {
              s.position = at(0, 16, 0);
              s.neighbours = {{.name = "copter 2", .stands = field}};
            }),
       Rule::shared_pad, "each other's pads", false},
  };
}

TEST(Plausibility, RefusesOrWarnsOfWhatNoPilotWouldFly) {
  auto const cases = wrong_missions();
  EXPECT_GE(cases.size(), 40u);
  for (auto const& one : cases) {
    auto const findings = judge(one.mission, one.situation, {});
    EXPECT_TRUE(has(findings, one.rule)) << one.name << "\n" << text(findings);
    EXPECT_NE(text(findings).find(one.words), std::string::npos) << one.name << "\n" << text(findings);
    EXPECT_EQ(refusal(findings) != nullptr, one.refuses) << one.name << "\n" << text(findings);
  }
}

struct Right {
  std::string name;
  Mission mission;
  Situation situation;
};

/// What people fly.
std::vector<Right> right_missions() {
  auto const flight = [](std::vector<MissionItem> on_the_way, std::optional<Wgs84> home = field) {
    on_the_way.insert(on_the_way.begin(), take_off());
    on_the_way.push_back(land());
    return mission(std::move(on_the_way), home);
  };
  auto const lanes = [](double length_m, int count, double up_m) {
    std::vector<MissionItem> items;
    for (int i = 0; i < count; ++i) {
      items.push_back(go(at(i % 2 == 0 ? length_m : 0.0, 40.0 * i, up_m)));
      items.push_back(go(at(i % 2 == 0 ? length_m : 0.0, 40.0 * (i + 1), up_m)));
    }
    return items;
  };
  auto const file = [](std::vector<MissionItem> items) { return mission(std::move(items), std::nullopt); };
  auto const return_item = item(MavCmd::nav_return_to_launch, {});
  auto const wide = GeoFence{.zones = {{.area = GeoCircle{field, 1'000.0}}}};
  MissionItem lower;
  lower.command = MavCmd::do_change_altitude;
  lower.params = {ground_m + 20.0F, 0.0F, 0.0F, 0.0F};
  MissionItem wait;
  wait.command = MavCmd::nav_delay;
  auto const by_foot = with(standing(), [](auto& s) { s.position = at(12, -9, 0); });
  auto const unknown = Situation{.family = Family::copter, .autopilot = Autopilot::ardupilot};
  return {
      {"up and down", flight({}), standing()},
      {"a survey of 2 km", flight(lanes(2'000, 20, 60)), standing()},
      {"a survey of 10 km by 3 km", flight(lanes(10'000, 3, 100)), standing()},
      {"a small survey at 10 m", flight(lanes(60, 4, 10)), standing()},
      {"a plane at 110 m over 5 km", mission({take_off(), go(at(5'000, 0, 110)), go(at(5'000, 5'000, 110)), land()}),
       standing(Family::plane)},
      {"a plane 20 km out", mission({take_off(), go(at(20'000, 0, 100)), return_item}), standing(Family::plane)},
      {"a plane that is thrown, on its way", mission({go(at(500, 0, 60)), land()}),
       with(in_air(), [](auto& s) { s.family = Family::plane; })},
      {"a VTOL",
       mission(
           {item(MavCmd::nav_vtol_takeoff, at(0, 0, 30)), go(at(3'000, 0, 100)), item(MavCmd::nav_vtol_land, field)}),
       standing(Family::vtol)},
      {"a rover without altitudes",
       mission({go(degrees(41.1785, -8.598, 0)), go(degrees(41.1785, -8.597, 0))}, degrees(41.178, -8.598, 0)),
       standing(Family::rover)},
      {"a rover with its field's altitude", mission({go(at(300, 0, 0)), go(at(0, 300, 0))}), standing(Family::rover)},
      {"a rover that has driven away and has the same home", mission({go(at(500, 0, 0))}),
       with(standing(Family::rover), [](auto& s) { s.position = at(700, 200, 0); })},
      {"a boat on a lake", mission({go(at(2'000, 0, 0)), go(at(0, 2'000, 0))}), standing(Family::boat)},
      {"a submarine 20 m down", mission({go(at(50, 0, -20)), go(at(50, 50, -40)), go(at(0, 0, 0))}),
       standing(Family::sub)},
      {"a submarine down by relative heights", file({above_home(MavCmd::nav_waypoint, at(50), -15)}),
       standing(Family::sub)},
      {"a file in relative heights",
       file({above_home(MavCmd::nav_takeoff, field, 20), above_home(MavCmd::nav_waypoint, at(200), 40), return_item}),
       standing()},
      {"a file whose take-off says 0, 0",
       file({above_home(MavCmd::nav_takeoff, {}, 20), above_home(MavCmd::nav_waypoint, at(200), 40),
             above_home(MavCmd::nav_land, {}, 0)}),
       standing()},
      {"a file over terrain",
       file({above_home(MavCmd::nav_takeoff, field, 20),
             item(MavCmd::nav_waypoint, at(500, 0, 60 - ground_m), MavFrame::global_terrain_alt)}),
       standing()},
      {"no home", mission({take_off(), go(at(200)), land()}, std::nullopt), standing()},
      {"landing 300 m away from home", mission({take_off(), go(at(200)), land(at(300, 0, 0))}), standing()},
      {"landing in a valley", mission({take_off(), go(at(200)), land(at(300, 0, -40))}), standing()},
      {"landing point without a height", mission({take_off(), go(at(200)), land(degrees(41.179, -8.598, 0))}),
       standing()},
      {"up a hill", flight({go(at(200, 0, 40)), go(at(400, 0, 70)), go(at(600, 0, 110))}), standing()},
      {"exactly at the ceiling", flight({go(at(200, 0, 120))}), standing()},
      {"home a few steps away", flight({}), by_foot},
      {"home 90 m away, across the field", flight({}, at(90, 0, 0)), standing()},
      {"home's altitude from a map, 12 m off", flight({}, at(0, 0, 12)), standing()},
      {"a field at sea level without an altitude",
       mission({take_off(30), go(degrees(41.1785, -8.598, 30)), land(degrees(41.178, -8.598, 0))},
               degrees(41.178, -8.598, 0)),
       with(standing(), [](auto& s) { s.position->alt_m = s.home->alt_m = 3.0; })},
      {"back home at home's altitude", flight({go(at(200)), go(field)}), standing()},
      {"home again, from the air", mission({go(field), land()}), in_air(at(800, 300, 40))},
      {"the second half, begun in the air", mission({go(at(-2'000)), land()}), in_air(at(4'000))},
      {"another home where it has landed", mission({take_off(), go(at(700)), land(at(600, 0, 0))}, at(600, 0, 0)),
       with(standing(), [](auto& s) { s.position = at(600, 0, 0); })},
      {"starting on the hill above its home", flight({go(at(700, 0, 60))}),
       with(standing(), [](auto& s) { s.position = at(800, 0, 60); })},
      {"PX4", flight({go(at(300))}), standing(Family::copter, Autopilot::px4)},
      {"waiting before the take-off", mission({wait, take_off(), go(at(100)), land()}), standing()},
      {"lower on the way", flight({go(at(200, 0, 60)), lower}), standing()},
      {"inside its fence", flight({go(at(300))}), with(standing(), [&](auto& s) { s.fence = wide; })},
      {"within its battery", flight({go(at(1'000))}), with(standing(), [](auto& s) { s.endurance = 900s; })},
      {"round and round until somebody ends it", flight({item(MavCmd::nav_loiter_unlim, at(100))}),
       with(standing(), [](auto& s) { s.endurance = 60s; })},
      {"beside another on a pad of its own", flight({}),
       with(standing(),
            [](auto& s) { s.neighbours = {{.name = "copter 2", .stands = at(0, 4, 0), .lands_at = {at(0, 4, 0)}}}; })},
      {"with two steps' GPS error", flight({}),
       with(standing(),
            [](auto& s) {
              s.position = at(1.5, 1, 2);
              s.neighbours = {{.name = "copter 2", .stands = at(0, 6, 0)}};
            })},
      {"nothing is known of the vehicle", flight({go(at(5'000))}), unknown},
  };
}

TEST(Plausibility, HasNothingToSayOfWhatPeopleFly) {
  auto const cases = right_missions();
  EXPECT_GE(cases.size(), 40u);
  for (auto const& one : cases) {
    auto const findings = judge(one.mission, one.situation, {});
    EXPECT_TRUE(findings.empty()) << one.name << "\n" << text(findings);
  }
}

TEST(Plausibility, LetsPassWhatIsAllowedByNameAndKeepsTheReason) {
  auto const far = mission({take_off(), go(at(60'000)), land()});
  Settings settings;
  ASSERT_TRUE(add_allowance(settings, "too_far=the tanker waits there"));
  auto const findings = judge(far, standing(), settings);
  EXPECT_EQ(refusal(findings), nullptr);
  ASSERT_TRUE(has(findings, Rule::too_far));
  EXPECT_EQ(findings.front().allowed_because, "the tanker waits there");
}

TEST(Plausibility, GoesByTheLimitsThatAreSet) {
  auto const high = mission({take_off(), go(at(100, 0, 150)), land()});
  Settings settings;
  ASSERT_TRUE(add_limit(settings, "ceiling=200"));
  EXPECT_TRUE(judge(high, standing(), settings).empty());
  ASSERT_TRUE(add_limit(settings, "ceiling=40"));
  EXPECT_TRUE(has(judge(high, standing(), settings), Rule::ceiling));
  ASSERT_TRUE(add_limit(settings, "endurance=30"));
  EXPECT_TRUE(has(judge(high, standing(), settings), Rule::battery));
}

TEST(Plausibility, TellsWhichSettingsThereAre) {
  Settings settings;
  EXPECT_EQ(add_allowance(settings, "too_fr=x").error().hint, "did you mean too_far?");
  EXPECT_EQ(add_allowance(settings, "too_far").error().message, "too_far is allowed without a reason");
  EXPECT_EQ(add_limit(settings, "ceilng=5").error().hint, "did you mean ceiling?");
  EXPECT_FALSE(add_limit(settings, "ceiling"));
  EXPECT_FALSE(add_limit(settings, "ceiling=nan"));
  EXPECT_FALSE(add_limit(settings, "ceiling=-3"));
  for (auto const& limit : limit_names())
    EXPECT_TRUE(set_limit(settings.limits, limit.name, limit.least)) << limit.name;
  for (auto const name : rule_names()) EXPECT_EQ(to_string(*rule_from(name)), name);
}

// ---- without a vehicle

TEST(PlausibilityAlone, SaysWhatCannotBeMeantAnywhere) {
  auto const low = judge_alone(mission({take_off(20), go(at(100)), land()}), {});
  EXPECT_TRUE(has(low, Rule::take_off_height)) << text(low);
  auto const zero = judge_alone(mission({take_off(), go(degrees(0, 0))}), {});
  EXPECT_TRUE(has(zero, Rule::zero_coordinates)) << text(zero);
  auto const swapped = judge_alone(mission({take_off(), go(degrees(-8.598, 41.178))}), {});
  EXPECT_NE(text(swapped).find("swapped"), std::string::npos) << text(swapped);
  auto const under = judge_alone(mission({take_off(), go(at(50, 0, -30))}), {});
  EXPECT_TRUE(has(under, Rule::below_ground)) << text(under);
  EXPECT_TRUE(has(judge_alone(mission({}), {}), Rule::empty_mission));
}

TEST(PlausibilityAlone, DoesNotGuessWhereAndByWhomItIsFlown) {
  for (auto const& one : right_missions())
    EXPECT_TRUE(judge_alone(one.mission, {}).empty()) << one.name << "\n" << text(judge_alone(one.mission, {}));
  auto const high = mission({take_off(ground_m + 380), go(at(200, 0, 480))});
  EXPECT_TRUE(judge_alone(high, {}).empty());
  auto const begun_in_the_air = mission({go(at(100)), land()});
  EXPECT_TRUE(judge_alone(begun_in_the_air, {}).empty());
}

TEST(PlausibilityAlone, KnowsThatWhatHasLandedMustTakeOffAgain) {
  auto const lands = mission({take_off(), go(at(100)), land()});
  auto const stays = mission({take_off(), go(at(100))});
  auto const home = mission({go(field), land()});
  EXPECT_TRUE(has(judge_order(lands, home, {}), Rule::no_take_off));
  EXPECT_TRUE(judge_order(stays, home, {}).empty());
  EXPECT_TRUE(judge_order(lands, lands, {}).empty());
  EXPECT_TRUE(judge_order(home, home, {}).empty()) << "nobody knows whether it flies";
}

// ---- commands by hand

TEST(PlausibilityOfCommands, RefusesWhatTheHandDidNotMean) {
  auto const up = in_air(at(100, 0, 20));
  auto const go_to = [&](Wgs84 place, std::optional<double> height_m = std::nullopt) {
    return judge(GoTo{place, height_m}, up, {});
  };
  EXPECT_TRUE(has(go_to(degrees(0, 0)), Rule::zero_coordinates));
  EXPECT_TRUE(has(go_to(degrees(38.7223, -9.1393)), Rule::too_far));
  EXPECT_TRUE(has(go_to(at(60'000)), Rule::too_far));
  EXPECT_NE(text(go_to(degrees(-8.598, 41.178))).find("swapped"), std::string::npos);
  EXPECT_TRUE(has(go_to(at(100), -20.0), Rule::below_ground));
  EXPECT_TRUE(has(go_to(at(100), 0.0), Rule::below_ground));
  EXPECT_TRUE(has(go_to(at(100), 5'000.0), Rule::ceiling));
  EXPECT_NE(text(go_to(at(100), 120.5)).find("ceiling of 120 m"), std::string::npos);
  EXPECT_NE(refusal(judge_take_off(500.0, standing(), {})), nullptr);
  EXPECT_NE(refusal(judge_take_off(0.2, standing(), {})), nullptr);
  EXPECT_TRUE(has(judge_take_off(1.5, standing(), {}), Rule::take_off_height));
  auto const tired = with(up, [](auto& s) { s.endurance = 60s; });
  EXPECT_NE(refusal(judge(GoTo{at(2'000), 30.0}, tired, {})), nullptr);
  EXPECT_TRUE(has(judge(GoTo{at(500), 30.0}, tired, {}), Rule::battery));
  auto const fenced = with(up, [](auto& s) { s.fence = GeoFence{.zones = {{.area = GeoCircle{field, 200.0}}}}; });
  EXPECT_TRUE(has(judge(GoTo{at(500), 30.0}, fenced, {}), Rule::outside_fence));
}

TEST(PlausibilityOfCommands, LetsPassWhatAnOperatorDoes) {
  auto const up = in_air(at(100, 0, 20));
  for (auto const& place : {at(0), at(300, 200), at(1'500), at(4'000)}) {
    EXPECT_TRUE(judge(GoTo{place, 30.0}, up, {}).empty());
    EXPECT_TRUE(judge(GoTo{place, std::nullopt}, up, {}).empty());
  }
  EXPECT_TRUE(judge(GoTo{at(12'000), 100.0}, with(up, [](auto& s) { s.family = Family::plane; }), {}).empty());
  EXPECT_TRUE(judge(GoTo{at(500), std::nullopt}, standing(Family::rover), {}).empty());
  EXPECT_TRUE(judge(GoTo{at(100), -20.0}, standing(Family::sub), {}).empty());
  for (double const height_m : {2.0, 10.0, 60.0, 120.0})
    EXPECT_TRUE(judge_take_off(height_m, standing(), {}).empty()) << height_m;
}

TEST(PlausibilityOfCommands, StartsNoMissionThatIsNotThere) {
  auto none = standing();
  none.items_held = 0;
  EXPECT_NE(text(judge_start(std::nullopt, none, {})).find("copter 1 holds no mission"), std::string::npos);
  EXPECT_NE(refusal(judge_start(mission({}), standing(), {})), nullptr);
  EXPECT_TRUE(judge_start(std::nullopt, standing(), {}).empty()) << "what is not known is not judged";
  EXPECT_TRUE(judge_start(mission({take_off(), land()}), standing(), {}).empty());
  EXPECT_NE(refusal(judge_start(mission({go(at(100))}), standing(), {})), nullptr);
}

}  // namespace
}  // namespace lapwing::plan::plausibility
