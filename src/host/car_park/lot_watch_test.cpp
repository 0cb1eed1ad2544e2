// A drone flies over a row of slots, and who looks sees just those that are in the picture: what becomes of it on the
// map.
#include "host/car_park/lot_watch.hpp"

#include <algorithm>

#include <gtest/gtest.h>

namespace lapwing::host {
namespace {

using namespace std::chrono_literals;
using map::SlotState;

geo::Wgs84 const anchor = geo::Wgs84::from_degrees(41.178, -8.598, 90.0);
constexpr int slots = 12;

explore::Corners slot_at(int i) {
  double const x = 2.5 * i;
  return {{{x, 0.0}, {x + 2.5, 0.0}, {x + 2.5, 5.0}, {x, 5.0}}};
}

CarParkTruth row() {
  CarParkTruth truth{.anchor = anchor};
  for (int i = 0; i < slots; ++i) truth.slots.push_back({.outline = slot_at(i), .is_taken = i % 2 == 0});
  return truth;
}

struct LotWatchOverARow : ::testing::Test {
  base::Task<base::Result<LookFrame>> answer(LookFrame request) {
    ++questions;
    if (!error.empty()) co_return base::fail(base::ErrorKind::lost, error);
    if (request.head["look"] == car_park_truth) co_return truth_answer(row());
    auto const look = look_in(request);
    EXPECT_TRUE(look);
    looks.push_back(*look);
    auto const view = view_of(look->lens, look->pose, 0.0);
    explore::LotSight sight;
    for (int i = 0; i < slots; ++i) {
      auto const outline = slot_at(i);
      bool const is_seen =
          std::ranges::all_of(outline, [&](auto const& corner) { return geo::seen_at(view, corner).has_value(); });
      if (!is_seen) continue;
      double const taken = i % 2 == 0 ? 0.98 : 0.02;
      sight.slots.push_back({.outline = outline, .surety = 0.95, .taken_chance = taken});
    }
    co_return look_answer(sight);
  }

  base::Task<> wait() { co_await loop.sleep(100ms); }

  LotWatch make() {
    return LotWatch(loop, live_map,
                    {.world = "row.toml",
                     .ask = [this](LookFrame request) { return answer(std::move(request)); },
                     .drones = [this] { return drones; }},
                    base::Logger(hub, "car park"));
  }
  /// It flies to the east at 5 m/s.
  void fly(double from_x_m, double seconds, double up_m = 20.0) {
    auto const site = *geo::Site::make("default", anchor);
    auto const begin = loop.now();
    for (;;) {
      double const flown_s = base::to_seconds(loop.now() - begin);
      if (flown_s >= seconds) break;
      drones = {{.vehicle = {"7"}, .place = site.place_of({from_x_m + 5.0 * flown_s, 2.5, up_m}), .heading_rad = 0.0}};
      loop.run_until_done(wait());
    }
  }

  base::LogHub hub;
  base::Loop loop{{.unpaced = true}};
  map::LiveMap live_map{[this] { return loop.utc_now(); }};
  std::vector<DroneInTheAir> drones;
  std::string error;
  int questions = 0;
  std::vector<CarParkLook> looks;
};

TEST_F(LotWatchOverARow, PutsOnTheMapWhatADroneFliesOver) {
  auto watch = make();
  fly(-15.0, 12.0);
  auto const found = watch.on_the_map();
  ASSERT_EQ(found.size(), 12U);
  EXPECT_EQ(std::ranges::count(found, SlotState::taken, &map::Slot::state), 6);
  EXPECT_EQ(std::ranges::count(found, SlotState::free, &map::Slot::state), 6);
  EXPECT_EQ(found.front().seen_by, "7");
  EXPECT_GT(watch.coverage(), 0.7);
  std::optional<LotScore> score;
  loop.run_until_done([](LotWatch& watched, std::optional<LotScore>& told) -> base::Task<> {
    auto judged = co_await watched.judge();
    EXPECT_TRUE(judged);
    told = *judged;
  }(watch, score));
  EXPECT_EQ(score->found, 12);
  EXPECT_EQ(score->right, 12);
  EXPECT_EQ(score->invented, 0);
  EXPECT_LT(score->off_m, 0.01);
}

TEST_F(LotWatchOverARow, TakesPicturesByHowFarADroneHasGotOn) {
  auto watch = make();
  fly(0.0, 6.0);
  auto const all = looks.size();
  EXPECT_GE(all, 4U);
  EXPECT_LE(all, 10U);
  for (std::size_t i = 1; i < looks.size(); ++i)
    EXPECT_GT((looks[i].pose.position - looks[i - 1].pose.position).length(), 4.0);
}

TEST_F(LotWatchOverARow, LooksAtNothingFromTheGroundAndFarAway) {
  auto watch = make();
  fly(0.0, 2.0, 5.0);
  fly(500.0, 2.0);
  EXPECT_TRUE(looks.empty());
  EXPECT_EQ(watch.pictures(), 0);
}

TEST_F(LotWatchOverARow, LeavesOffWhereNobodyKnowsTheCarPark) {
  error = "nobody looks at pictures now";
  auto watch = make();
  fly(0.0, 6.0);
  EXPECT_EQ(questions, 1);
  EXPECT_TRUE(watch.on_the_map().empty());
}

}  // namespace
}  // namespace lapwing::host
