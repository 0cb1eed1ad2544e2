#include "host/car_park/car_park_look.hpp"

#include <limits>

#include <gtest/gtest.h>

namespace lapwing::host {
namespace {

using namespace std::chrono_literals;
using nlohmann::json;

CarParkLook some_look() {
  return {.place = {.world = "/parks/small.toml", .anchor = geo::Wgs84::from_degrees(41.178, -8.598, 90.0)},
          .lens = geo::pinhole(960, 720, 1.0821),
          .at = base::UtcTime(1'700'000'000s),
          .pose = {{1.5, 2.0, 30.5}, 0.52}};
}

TEST(CarParkLook, IsReadAsItWasWritten) {
  auto const look = some_look();
  auto const read = look_in(look_request(look));
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(read->place.world, look.place.world);
  EXPECT_NEAR(read->place.anchor->lat_deg(), 41.178, 1e-12);
  EXPECT_EQ(read->at, look.at);
  EXPECT_EQ(read->lens.width_px, 960);
  EXPECT_NEAR(read->lens.focal_x_px, look.lens.focal_x_px, 1e-9);
  EXPECT_EQ(read->pose.position.x(), 1.5);
  EXPECT_EQ(read->pose.position.z(), 30.5);
  EXPECT_EQ(read->pose.yaw_rad, 0.52);
}

TEST(CarParkLook, HasNoAnchorWhereNoneIsKnown) {
  auto look = some_look();
  look.place.anchor.reset();
  auto const read = look_in(look_request(look));
  ASSERT_TRUE(read);
  EXPECT_FALSE(read->place.anchor);
}

TEST(CarParkLook, RefusesWhatIsNoRequest) {
  auto const good = look_request(some_look());
  for (auto const& [key, value] : std::initializer_list<std::pair<char const*, json>>{
           {"world", ""},
           {"world", 3},
           {"at", "yesterday"},
           {"anchor", {91.0, 0.0, 0.0}},
           {"width", 0},
           {"width", "wide"},
           {"height", 100'000},
           {"view_rad", 3.1},
           {"pose", {1.0, 2.0, 3.0}},
           {"pose", {1.0, 2.0, 3.0, std::numeric_limits<double>::infinity()}}}) {
    auto bad = good;
    bad.head[key] = value;
    auto const read = look_in(bad);
    ASSERT_FALSE(read) << key << ' ' << value;
    EXPECT_EQ(read.error().kind, base::ErrorKind::invalid_input);
    bad.head.erase(key);
    EXPECT_EQ(look_in(bad).has_value(), std::string_view(key) == "anchor") << key;
  }
}

TEST(CarParkSight, IsReadAsItWasWritten) {
  explore::LotSight sight;
  sight.slots.push_back({.outline = {{{0.0, 0.0}, {2.5, 0.0}, {2.5, 5.0}, {0.0, 5.0}}}, .surety = 0.9});
  sight.slots.push_back(
      {.outline = {{{2.5, 0.0}, {5.0, 0.0}, {5.0, 5.0}, {2.5, 5.0}}}, .surety = 0.6, .taken_chance = 0.97});
  sight.cars.push_back({.outline = {{{3.0, 0.5}, {4.8, 0.5}, {4.8, 4.9}, {3.0, 4.9}}}, .chance = 0.8});
  auto const read = sight_in(look_answer(sight), some_look(), -1.0);
  ASSERT_TRUE(read && *read);
  ASSERT_EQ((*read)->slots.size(), 2U);
  EXPECT_FALSE((*read)->slots[0].taken_chance);
  EXPECT_EQ((*read)->slots[1].taken_chance, 0.97);
  EXPECT_EQ((*read)->slots[1].outline[2].y(), 5.0);
  EXPECT_EQ((*read)->cars.front().chance, 0.8);
  EXPECT_EQ((*read)->at, some_look().at);
  EXPECT_NEAR((*read)->view.height_m(), 31.5, 1e-12);
}

TEST(CarParkSight, IsNoneWhereNoGroundWasSeen) {
  auto const read = sight_in(look_answer(std::nullopt), some_look(), 0.0);
  ASSERT_TRUE(read);
  EXPECT_FALSE(*read);
}

TEST(CarParkSight, RefusesWhatIsNoAnswer) {
  auto const slot = [](json outline, json surety) {
    return LookFrame{.head = {{"slots", {{{"outline", std::move(outline)}, {"surety", std::move(surety)}}}},
                              {"cars", json::array()}}};
  };
  json const square{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  EXPECT_TRUE(sight_in(slot(square, 0.5), some_look(), 0.0));
  EXPECT_FALSE(sight_in(slot(square, 1.5), some_look(), 0.0));
  EXPECT_FALSE(sight_in(slot({{0, 0}, {1, 0}, {1, 1}}, 0.5), some_look(), 0.0));
  EXPECT_FALSE(sight_in(slot({{0, 0}, {1, 0}, {1, 1}, {0, 1e9}}, 0.5), some_look(), 0.0));
  EXPECT_FALSE(sight_in({.head = {{"slots", 3}, {"cars", json::array()}}}, some_look(), 0.0));
  auto const refused = sight_in(refusal("no such world"), some_look(), 0.0);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().message, "no such world");
}

TEST(CarParkTruth, IsReadAsItWasWritten) {
  CarParkTruth const truth{.anchor = geo::Wgs84::from_degrees(1.0, 2.0, 3.0),
                           .ground_m = -0.5,
                           .slots = {{{{{0.0, 0.0}, {2.5, 0.0}, {2.5, 5.0}, {0.0, 5.0}}}, true}}};
  auto const read = truth_in(truth_answer(truth));
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_NEAR(read->anchor.lon_deg(), 2.0, 1e-12);
  EXPECT_EQ(read->ground_m, -0.5);
  ASSERT_EQ(read->slots.size(), 1U);
  EXPECT_TRUE(read->slots.front().is_taken);
  EXPECT_FALSE(truth_in({.head = {{"anchor", {1.0, 2.0, 3.0}}, {"ground_m", 0.0}}}));
}

TEST(CarParkTruth, IsAskedForAtAPlaceAndATime) {
  auto const read = truth_question_in(truth_request(some_look().place, some_look().at));
  ASSERT_TRUE(read);
  EXPECT_EQ(read->place.world, some_look().place.world);
  EXPECT_EQ(read->at, some_look().at);
  EXPECT_FALSE(truth_question_in({}));
}

}  // namespace
}  // namespace lapwing::host
