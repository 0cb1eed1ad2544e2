#include "explore/lot/lot_map.hpp"

#include <random>

#include <gtest/gtest.h>

#include "explore/lot/belief.hpp"
#include "explore/testing/lot_pictures.hpp"

namespace lapwing::explore {
namespace {

using testing::after;
using testing::lot_map;
using testing::sight_at;
using testing::slot_at;

LotAddress const address = {.site = "lot", .writer = "drone 1"};

/// A row of six slots from (22, 20) on, each told with that chance.
LotSight row_from(double x, double y, double seconds, double taken_chance, double off_m = 0.0) {
  auto sight = sight_at(x, y, seconds);
  for (int i = 0; i < 6; ++i)
    sight.slots.push_back(
        {.outline = slot_at(22.0 + 2.5 * i + off_m, 20.0), .surety = 0.95, .taken_chance = taken_chance});
  return sight;
}

double parking_at(LotMap const& lot, double x, double y, double seconds = 0.0) {
  auto const& cells = lot.cells();
  auto const cell = Cell{static_cast<int>(x / 0.5), static_cast<int>(y / 0.5)} - cells.corner();
  return cells.parking_chance(cells.grid()[cell], after(seconds));
}

std::int8_t shade_at(LotOccupancy const& occupancy, double x, double y) {
  auto const column = static_cast<std::size_t>((x - occupancy.origin.x()) / occupancy.resolution_m);
  auto const row = static_cast<std::size_t>((y - occupancy.origin.y()) / occupancy.resolution_m);
  return occupancy.cells[row * static_cast<std::size_t>(occupancy.width) + column];
}

TEST(LotMap, KnowsNothingBeforeTheFirstPicture) {
  auto lot = lot_map();
  EXPECT_EQ(lot.coverage(), 0.0);
  EXPECT_NEAR(lot.unknown_bits(after(0.0)), 60.0 * 40.0 / slot_ground_m2, 1e-6);
  auto const occupancy = lot.occupancy(after(0.0));
  EXPECT_EQ(occupancy.width, 121);  // the last column begins where the area ends
  EXPECT_TRUE(std::ranges::all_of(occupancy.cells, [](auto shade) { return shade == -1; }));
  EXPECT_TRUE(lot.take_news(address).slots.empty());
}

TEST(LotMap, OnePictureTellsSlotsAndTheGroundBetween) {
  auto lot = lot_map();
  auto sight = row_from(28.0, 20.0, 0.0, 0.02);
  sight.slots[1].taken_chance = 0.98;
  sight.slots[2].taken_chance.reset();
  ASSERT_TRUE(lot.add(sight));
  auto const news = lot.take_news(address);
  ASSERT_EQ(news.slots.size(), 6U);
  for (auto const& feature : news.slots) EXPECT_FALSE(map::feature_fault(feature)) << *map::feature_fault(feature);
  auto const& taken = std::get<map::Slot>(news.slots[1].content);
  EXPECT_EQ(taken.state, map::SlotState::taken);
  EXPECT_EQ(taken.seen_by, "drone 1");
  EXPECT_EQ(taken.seen_at, after(0.0));
  EXPECT_EQ(std::get<map::Slot>(news.slots[0].content).state, map::SlotState::free);
  EXPECT_FALSE(std::get<map::Slot>(news.slots[2].content).taken_probability);
  EXPECT_EQ(news.tiles.size(), 1U);
  EXPECT_TRUE(lot.take_news(address).tiles.empty()) << "told once";

  EXPECT_GT(parking_at(lot, 22.0, 20.0), 0.9);
  EXPECT_LT(parking_at(lot, 20.0, 16.8), 0.2);
  EXPECT_EQ(parking_at(lot, 5.0, 5.0), 0.5);
  auto const occupancy = lot.occupancy(after(0.0));
  EXPECT_LT(shade_at(occupancy, 22.0, 20.0), 10);
  EXPECT_GT(shade_at(occupancy, 24.6, 20.0), 90);
  EXPECT_GT(shade_at(occupancy, 20.0, 16.8), 80);
  EXPECT_EQ(shade_at(occupancy, 5.0, 5.0), -1);
  auto const cell = lot.parking_grid().at(lot.parking_grid().cell_at({22.0, 20.0}));
  EXPECT_NEAR(cell.probability(), parking_at(lot, 22.0, 20.0), 0.01);
}

TEST(LotMap, TheSameSlotFromSeveralPicturesIsOneAndKeepsItsId) {
  auto lot = lot_map();
  std::mt19937 random(5);
  std::normal_distribution<double> off(0.0, 0.3);
  for (int i = 0; i < 20; ++i) lot.add(row_from(24.0 + 0.5 * i, 20.0 + (i % 3), 10.0 * i, 0.9, off(random)));
  ASSERT_EQ(lot.slots().slots().size(), 6U);
  for (std::size_t i = 0; i < 6; ++i) {
    auto const& slot = lot.slots().slots()[i];
    EXPECT_EQ(slot.id, "slot-" + std::to_string(i + 1));
    EXPECT_NEAR(middle_of(slot.outline).x(), 22.0 + 2.5 * static_cast<double>(i), 0.25);
    EXPECT_NEAR(sides_of(slot.outline).width_m, 2.5, 0.01);
  }
}

TEST(LotMap, ASlotOfTheMapKeepsItsIdThere) {
  auto lot = lot_map();
  lot.know("A17", slot_at(22.2, 20.1));
  lot.add(row_from(28.0, 20.0, 0.0, 0.9));
  EXPECT_EQ(lot.slots().slots()[0].id, "A17");
  EXPECT_EQ(lot.slots().slots().size(), 6U);
}

TEST(LotMap, OrderOfIndependentPicturesHardlyMatters) {
  // The first is as unsure of its place as its camera is, and every other one lies on it.
  std::vector<LotSight> sights;
  for (int i = 0; i < 6; ++i) sights.push_back(row_from(20.0 + 4.5 * i, 18.0 + (i % 2) * 5.0, 0.0, 0.3 + 0.1 * i));
  auto forward = lot_map();
  for (auto const& sight : sights) forward.add(sight);
  std::ranges::reverse(sights);
  auto backward = lot_map();
  for (auto const& sight : sights) backward.add(sight);
  ASSERT_EQ(forward.slots().slots().size(), backward.slots().slots().size());
  auto const chance_near = [](LotMap const& lot, double x) {
    for (auto const& slot : lot.slots().slots())
      if (std::abs(middle_of(slot.outline).x() - x) < 0.1) return lot.slots().taken_chance(slot, after(0.0));
    return -1.0;
  };
  for (int i = 0; i < 6; ++i)
    EXPECT_NEAR(chance_near(forward, 22.0 + 2.5 * i), chance_near(backward, 22.0 + 2.5 * i), 0.03) << i;
  for (double x = 15.0; x < 40.0; x += 0.5)
    EXPECT_NEAR(parking_at(forward, x, 20.3), parking_at(backward, x, 20.3), 2e-3) << x;
}

TEST(LotMap, ChancesStayChancesWhateverPicturesTell) {
  auto lot = lot_map();
  std::mt19937 random(11);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  for (int i = 0; i < 200; ++i) {
    auto sight = sight_at(60.0 * share(random), 40.0 * share(random), 3.0 * i * share(random));
    for (int k = 0; k < 5; ++k)
      sight.slots.push_back({.outline = slot_at(60.0 * share(random), 40.0 * share(random)),
                             .surety = std::round(share(random)),
                             .taken_chance = std::round(share(random))});
    lot.add(sight);
  }
  auto const& grid = lot.cells().grid();
  for (std::size_t i = 0; i < grid.size(); ++i) {
    auto const chance = lot.cells().parking_chance(grid.at_index(i), after(600.0));
    ASSERT_TRUE(chance > 0.0 && chance < 1.0) << chance;
  }
  for (auto const& slot : lot.slots().slots()) {
    auto const chance = lot.slots().taken_chance(slot, after(600.0));
    ASSERT_TRUE(chance >= 0.0 && chance <= 1.0) << chance;
  }
  for (auto const shade : lot.occupancy(after(600.0)).cells) ASSERT_TRUE(shade >= -1 && shade <= 100);
  EXPECT_LE(lot.coverage(), 1.0);
  EXPECT_TRUE(std::isfinite(lot.unknown_bits(after(600.0))));
}

TEST(LotMap, TheUnknownShrinksWithLooksAndGrowsAgainWithTime) {
  auto lot = lot_map();
  auto const before = lot.unknown_bits(after(0.0));
  lot.add(row_from(28.0, 20.0, 0.0, 0.05));
  auto const seen = lot.unknown_bits(after(0.0));
  EXPECT_LT(seen, before - 4.0);
  EXPECT_GT(lot.unknown_bits(after(3600.0)), seen + 3.0);
  EXPECT_GT(lot.unknown_bits(after(60.0 * 86400.0)), 0.99 * before) << "even the layout is forgotten in the end";
}

TEST(LotMap, ASlotThatOnlyAPassingCarShowedIsNone) {
  auto lot = lot_map();
  auto with_car = sight_at(28.0, 20.0, 0.0);
  // As `detect slots` tells a slot of which it saw no paint: by the car alone.
  with_car.slots.push_back({.outline = slot_at(28.0, 20.0), .surety = 0.6, .taken_chance = 0.98});
  with_car.cars.push_back({.outline = slot_at(28.0, 20.0), .chance = 0.98});
  lot.add(with_car);
  EXPECT_TRUE(lot.take_news(address).slots.empty()) << "one sight by a car alone is not told";
  auto const without = sight_at(31.0, 20.0, 3.0);
  lot.add(without);
  lot.add(sight_at(34.0, 20.0, 6.0));
  EXPECT_TRUE(lot.slots().slots().empty());
  EXPECT_TRUE(lot.take_news(address).slots.empty());
  EXPECT_LT(parking_at(lot, 28.0, 20.0), 0.3);
}

TEST(LotMap, GroundUnderACarThatDrivesIsNeitherParkingNorNot) {
  auto lot = lot_map();
  for (int i = 0; i < 4; ++i) {
    auto sight = sight_at(20.0 + 3.0 * i, 20.0, 1.0 * i);
    sight.cars.push_back({.outline = slot_at(18.0 + 3.0 * i, 20.0), .chance = 0.95});  // 3 m/s
    lot.add(sight);
  }
  EXPECT_LE(parking_at(lot, 27.0, 20.0), 0.5);
  EXPECT_LT(parking_at(lot, 21.0, 20.0), 0.4) << "seen empty before and after";
}

TEST(LotMap, WhereACarStandsPeopleParkPerhaps) {
  auto lot = lot_map();
  for (int i = 0; i < 4; ++i) {
    auto sight = sight_at(24.0 + 4.0 * i, 20.0, 4.0 * i);
    sight.cars.push_back({.outline = slot_at(28.0, 20.0), .chance = 0.95});
    lot.add(sight);
  }
  EXPECT_GT(parking_at(lot, 28.0, 20.0), 0.7);
}

TEST(LotMap, ASlotThatIsNotFoundAgainGoes) {
  auto lot = lot_map();
  lot.add(row_from(28.0, 20.0, 0.0, 0.1));
  EXPECT_EQ(lot.take_news(address).slots.size(), 6U);
  for (int i = 1; i < 6; ++i) lot.add(sight_at(26.0 + 5.0 * (i % 2), 20.0, 30.0 * i));
  auto const news = lot.take_news(address);
  EXPECT_EQ(news.gone.size(), 6U);
  EXPECT_TRUE(lot.slots().slots().empty());
}

TEST(LotMap, AnUnsurePlaceOfTheCameraTellsLess) {
  auto sure = lot_map();
  auto unsure = lot_map();
  auto sight = row_from(28.0, 20.0, 0.0, 0.99);
  sure.add(sight);
  sight.doubt.position_m = 2.0;
  unsure.add(sight);
  auto const& a = sure.slots().slots()[0];
  auto const& b = unsure.slots().slots()[0];
  EXPECT_GT(sure.slots().taken_chance(a, after(0.0)), unsure.slots().taken_chance(b, after(0.0)) + 0.1);
  // Just outside of the row the cells are less surely no parking.
  EXPECT_LT(parking_at(sure, 28.0, 16.7), parking_at(unsure, 28.0, 16.7));
}

TEST(LotMap, WhatIsTooCoarseOrTooFarIsNotSeen) {
  auto lot = lot_map();
  LotSight high = sight_at(28.0, 20.0, 0.0);
  high.view = testing::view_at(28.0, 20.0, 150.0);  // 14 cm a pixel
  EXPECT_FALSE(lot.add(high));
  EXPECT_EQ(lot.coverage(), 0.0);
  LotSight level = sight_at(28.0, 20.0, 0.0);
  level.view.site_from_camera = geo::camera_at({28.0, 20.0, 20.0}, 0.0, 1.4);
  lot.add(level);
  auto const& cells = lot.cells();
  EXPECT_FALSE(cells.grid()[(Cell{59, 40} - cells.corner())].is_seen) << "not below the camera, which looks away";
  EXPECT_FALSE(lot.add(sight_at(500.0, 20.0, 0.0)));
}

TEST(LotMap, APlaceIsInTheLotNearParkingThatWasSeen) {
  auto lot = lot_map();
  EXPECT_TRUE(lot.is_in_lot({50.0, 35.0}, after(0.0))) << "as long as nothing is known";
  EXPECT_FALSE(lot.is_in_lot({70.0, 20.0}, after(0.0)));
  lot.add(row_from(28.0, 20.0, 0.0, 0.1));
  EXPECT_TRUE(lot.is_in_lot({28.0, 20.0}, after(0.0)));
  EXPECT_TRUE(lot.is_in_lot({28.0, 28.0}, after(0.0)));
  EXPECT_FALSE(lot.is_in_lot({58.0, 38.0}, after(0.0)));
}

TEST(LotMap, RefusesWhatIsNoAreaWithTheReason) {
  auto const none = LotMap::make({{{{0.0, 0.0}, {1.0, 1.0}}}});
  ASSERT_FALSE(none);
  EXPECT_NE(none.error().message.find("corners"), std::string::npos);
  auto const huge = LotMap::make(testing::rectangle(5000.0, 5000.0));
  ASSERT_FALSE(huge);
  EXPECT_NE(huge.error().message.find("million"), std::string::npos);
  EXPECT_FALSE(LotMap::make(testing::rectangle(50.0, 50.0), {.found_share = 1.0}));
  EXPECT_FALSE(LotMap::make(testing::rectangle(50.0, 50.0), {.cell_m = 0.0}));
}

TEST(LotSight, PixelsOnTheGround) {
  auto const view = testing::view_at(10.0, 20.0);
  auto const ground = on_ground(view, {{{640.0, 360.0}, {700.0, 360.0}, {700.0, 300.0}, {640.0, 300.0}}});
  ASSERT_TRUE(ground);
  EXPECT_NEAR((*ground)[0].x(), 10.0, 1e-9);
  EXPECT_NEAR((*ground)[0].y(), 20.0, 1e-9);
  EXPECT_GT((*ground)[1].x(), 10.5);
  EXPECT_GT((*ground)[2].y(), 20.5);
  auto const level = geo::GroundView{.lens = view.lens, .site_from_camera = geo::camera_at({0.0, 0.0, 20.0}, 0.0, 1.5)};
  EXPECT_FALSE(on_ground(level, {{{640.0, 0.0}, {700.0, 0.0}, {700.0, 300.0}, {640.0, 300.0}}}));
}

}  // namespace
}  // namespace lapwing::explore
