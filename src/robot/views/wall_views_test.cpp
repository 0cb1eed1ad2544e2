#include "robot/views/wall_views.hpp"

#include <array>
#include <numbers>

#include <gtest/gtest.h>

namespace lapwing::robot {
namespace {

constexpr double south_rad = -std::numbers::pi / 2.0;
constexpr std::array mounts{CameraMount{.yaw_rad = 1.8, .pitch_rad = 0.35},
                            CameraMount{.yaw_rad = 0.87, .pitch_rad = 0.35}};

/// Free floor with a wall along x at y = 2 m, from 0 to 8 m; what came before the cameras is for the tests to say.
struct WallViews : ::testing::Test {
  WallViews() {
    for (std::int32_t x = -40; x < 200; ++x)
      for (std::int32_t y = -80; y < 80; ++y) {
        bool const is_wall = y == 40 && x >= 0 && x < 160;
        grid.set({x, y}, map::Evidence::of_probability(is_wall ? 0.9 : 0.1));
      }
  }
  static WallPoint at(double x_m) { return {.position = {x_m, 2.02}, .range_m = 2.0, .facing_rad = south_rad}; }
  void pass(double from_m, double to_m) {
    for (double x_m = from_m; x_m < to_m; x_m += 0.2) looks.pass(at(x_m));
  }
  void note(double from_m, double to_m, double clearness, LookBook::Outcome outcome) {
    for (double x_m = from_m; x_m < to_m; x_m += 0.4) looks.note(piece_of(at(x_m)), clearness, outcome);
  }
  /// 0.9 m wide.
  void open_doorway(double from_m) {
    for (std::int32_t x = 0; x < 18; ++x)
      grid.set({static_cast<std::int32_t>(from_m / 0.05) + x, 40}, map::Evidence::of_probability(0.1));
  }
  [[nodiscard]] std::optional<WallView> next(map::SitePoint const& here, WallChoice which = WallChoice::any) const {
    return next_wall_view(looks, grid, mounts, here, which);
  }

  map::OccupancyGrid grid{0.05};
  LookBook looks;
};

TEST_F(WallViews, AreNoneWhereAllIsClearOrNothingWasPassed) {
  EXPECT_FALSE(next({4.0, 0.5}));
  pass(2.0, 4.0);
  note(2.0, 4.0, 2.0 * LookBook::clear_px_m, LookBook::Outcome::blank);
  EXPECT_FALSE(next({4.0, 0.5}));
}

TEST_F(WallViews, LeaveAWallThatShowedNothingFromAfar) {
  pass(2.0, 4.0);
  note(2.0, 4.0, 1.2 * LookBook::noticed_px_m, LookBook::Outcome::blank);
  EXPECT_FALSE(next({4.0, 0.5}));
}

TEST_F(WallViews, ComeNearToWhatShowedSomethingThoughOtherWallsAreNearer) {
  pass(1.0, 7.0);
  looks.note(piece_of(at(2.1)), 1.2 * LookBook::noticed_px_m, LookBook::Outcome::poor);
  auto const view = next({3.5, 0.5});
  ASSERT_TRUE(view);
  EXPECT_EQ(view->piece, piece_of(at(2.1)));
  EXPECT_NEAR(view->view.from.y(), 0.8, 0.1);
}

TEST_F(WallViews, GoTheWholeWayToWhatShowedSomethingBeforeTheyShowWhatIsNear) {
  pass(0.2, 4.0);
  pass(7.4, 7.6);
  looks.note(piece_of(at(7.5)), 1.2 * LookBook::noticed_px_m, LookBook::Outcome::poor);
  auto const view = next({1.0, 0.5});
  ASSERT_TRUE(view);
  EXPECT_EQ(view->piece, piece_of(at(7.5)));
}

TEST_F(WallViews, ShowMuchOfAWallThatNoCameraLookedAt) {
  pass(1.0, 7.0);
  auto const view = next({4.0, 1.0});
  ASSERT_TRUE(view);
  EXPECT_GT(geo::distance_m(view->view.from, view->view.at), 2.2) << "from afar more is seen";
}

TEST_F(WallViews, AreNotThoseBehindAWallThatItWouldDriveRound) {
  // Through the wall the one on its northern side would be the nearer one.
  looks.pass({.position = {4.0, 2.08}, .range_m = 2.0, .facing_rad = -south_rad});
  looks.pass(at(7.0));
  auto const view = next({4.0, 0.8});
  ASSERT_TRUE(view);
  EXPECT_EQ(view->piece, piece_of(at(7.0)));
}

TEST_F(WallViews, AreOfTheWallsBesideDoorwaysWhereThoseAloneAreWanted) {
  pass(0.6, 5.4);
  EXPECT_FALSE(next({1.0, 0.5}, WallChoice::likely));
  open_doorway(6.0);
  pass(5.4, 6.0);
  auto const view = next({1.0, 0.5}, WallChoice::likely);
  ASSERT_TRUE(view);
  EXPECT_GT(view->view.at.x(), 5.0);
  EXPECT_LT(next({1.0, 0.5})->view.at.x(), 5.0) << "another one is nearer";
}

TEST_F(WallViews, AreOfWhatShowedSomethingAlsoWhereLikelyOnesAloneAreWanted) {
  pass(1.0, 7.0);
  looks.note(piece_of(at(5.1)), 1.2 * LookBook::noticed_px_m, LookBook::Outcome::poor);
  auto const view = next({1.0, 0.5}, WallChoice::likely);
  ASSERT_TRUE(view);
  EXPECT_EQ(view->piece, piece_of(at(5.1)));
}

TEST_F(WallViews, PassByASinglePieceForManyAtOnce) {
  pass(0.6, 0.9);
  pass(3.0, 7.0);
  auto const view = next({1.6, 0.0});
  ASSERT_TRUE(view);
  EXPECT_GT(view->view.at.x(), 2.9);
}

}  // namespace
}  // namespace lapwing::robot
