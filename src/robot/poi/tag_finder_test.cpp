#include "robot/poi/tag_finder.hpp"

#include <numbers>

#include <gtest/gtest.h>

namespace lapwing::robot {
namespace {

using namespace std::chrono_literals;

/// A robot that stands before a wall along x at y = 2 m, with a camera that looks at it.
struct TagFinderAtAWall : ::testing::Test {
  void SetUp() override {
    auto const site = geo::Site::make("site", geo::Wgs84::from_degrees(41.0, -8.0, 90.0));
    ASSERT_TRUE(site);
    live_map.put_site(*site);
    for (std::int32_t x = -40; x < 160; ++x)
      for (std::int32_t y = -100; y < 40; ++y) grid.set({x, y}, map::Evidence::of_probability(0.1));
    lay_wall(-2.0, 8.0);
    stand_at(1.0);
  }
  void lay_wall(double from_m, double to_m) {
    for (std::int32_t x = -40; x < 160; ++x) {
      double const at_m = (x + 0.5) * 0.05;
      grid.set({x, 40}, map::Evidence::of_probability(at_m > from_m && at_m < to_m ? 0.9 : 0.1));
    }
    put_grid();
  }
  /// All of the wall is in one picture.
  void shorten_wall() { lay_wall(0.5, 1.5); }
  void put_grid() {
    std::vector<map::TileKey> tiles;
    for (auto const& [key, tile] : grid.tiles()) tiles.push_back(key);
    ASSERT_TRUE(live_map.put_tiles({.site = "site", .floor = "", .name = "robot 1"}, grid, tiles,
                                   {.writer = "robot1", .at = loop.utc_now()}));
  }
  void stand_at(double x, double y = 0.4, double yaw_rad = 0.0) {
    registry.edit({"robot1"})
        .motion.site_pose.set({.site = "site", .floor = {}, .position = {x, y, 0.0}, .yaw_rad = yaw_rad}, loop.now());
  }
  /// Sees what `look` is now, in the middle of its picture; of the texts another one each time, where there are some.
  Eye eye() {
    return {.mount = {.x_m = 0.0, .yaw_rad = std::numbers::pi / 2.0},
            .look = [this]() -> base::Task<std::optional<Look>> {
              if (turns_by_rad != 0.0) stand_at(1.0, 0.4, turns_by_rad);
              if (!texts.empty() && !look.found.empty())
                look.found.front().what.text = texts[static_cast<std::size_t>(looked++) % texts.size()];
              co_return look;
            }};
  }
  std::optional<Viewpoint> next_view(TagFinder& finds) { return loop.run_until_done(finds.next_view()); }
  bool is_any_left(TagFinder& finds, WallChoice which) { return loop.run_until_done(finds.is_any_left(which)); }
  /// As the robot does for it: false when it asks for nothing.
  bool go_and_look(TagFinder& finds) {
    auto const view = next_view(finds);
    if (!view) return false;
    EXPECT_FALSE(finds.has_looked());
    stand_at(view->from.x(), view->from.y());
    pass(3s);
    return true;
  }
  [[nodiscard]] map::PointOfInterest point() const {
    return std::get<map::PointOfInterest>(on_map().front()->feature.content);
  }
  std::unique_ptr<TagFinder> finder() {
    TagFinder::Setup setup{.vehicle = "robot1", .grid = "robot 1", .eyes = {.for_tags = {eye()}}};
    setup.eyes.keep = [this](std::string jpeg) { return keep(std::move(jpeg)); };
    setup.clear_ways = [this] { return [is_open = is_open](double, double most_m) { return is_open ? most_m : 0.0; }; };
    return std::make_unique<TagFinder>(loop, registry, live_map, std::move(setup), base::Logger(hub, "test"));
  }
  base::Task<base::Result<std::string>> keep(std::string jpeg) {
    kept.push_back(std::move(jpeg));
    co_return std::string(63, 'a') + std::to_string(kept.size());
  }
  void pass(base::Duration time) {
    loop.run_until_done(
        [](base::Loop& on, base::Duration for_s) -> base::Task<> { co_await on.sleep(for_s); }(loop, time));
  }
  [[nodiscard]] std::vector<map::FeatureRecord const*> on_map() const {
    return live_map.within(map::LayerKind::points_of_interest, "site", std::nullopt, 100);
  }

  map::OccupancyGrid grid{0.05};
  base::LogHub hub;
  base::Loop loop{base::Loop::Pace{.unpaced = true, .begins_at = base::UtcTime(std::chrono::hours(24 * 365 * 30))}};
  vehicle::Registry registry{loop};
  map::LiveMap live_map{[this] { return loop.utc_now(); }};
  Look look{.found = {{.what = {.category = "sign",
                                .box = {.x = 460.0, .y = 350.0, .width = 40.0, .height = 20.0},
                                .score = 0.8,
                                .text = "221",
                                .kind = "office"},
                       .crop = "its letters"}}};
  bool is_open = false;       ///< where the map has a wall
  double turns_by_rad = 0.0;  ///< while it looks
  std::vector<std::string> texts;
  int looked = 0;
  std::vector<std::string> kept;
};

TEST_F(TagFinderAtAWall, PutsWhatIsReadThereOnTheMap) {
  auto const finds = finder();
  pass(3s);
  ASSERT_EQ(on_map().size(), 1U);
  auto const& point = std::get<map::PointOfInterest>(on_map().front()->feature.content);
  EXPECT_EQ(point.kind, "name tag");
  EXPECT_EQ(point.name, "221");
  EXPECT_EQ(point.text, "221 office");
  EXPECT_NEAR(point.position.x(), 1.0, 0.05);
  EXPECT_NEAR(point.position.y(), 2.0, 0.05);
  EXPECT_TRUE(point.covariance_m2);
  EXPECT_EQ(point.picture, std::string(63, 'a') + "1");
  EXPECT_EQ(finds->texts(), std::vector<std::string>{"221 office"});
}

TEST_F(TagFinderAtAWall, KeepsThePictureOfTheSightThatWasSurest) {
  auto const finds = finder();
  pass(700ms);
  EXPECT_EQ(kept, std::vector<std::string>{"its letters"});
  look.found.front().what.score = 0.9;
  look.found.front().crop = "sharper letters";
  pass(300ms);
  EXPECT_EQ(kept, std::vector<std::string>({"its letters", "sharper letters"}));
  look.found.front().what.score = 0.7;
  look.found.front().crop = "blurred letters";
  stand_at(1.5);
  pass(3s);
  EXPECT_EQ(kept.size(), 2U);
  EXPECT_EQ(std::get<map::PointOfInterest>(on_map().front()->feature.content).picture, std::string(63, 'a') + "2");
}

TEST_F(TagFinderAtAWall, LooksAtAPieceOfWallTwiceAndOnceMoreWhenThatWasBlurred) {
  auto const finds = finder();
  pass(5s);
  EXPECT_EQ(finds->pictures(), 2);
  look.is_sharp = false;
  stand_at(3.0);
  pass(5s);
  EXPECT_EQ(finds->pictures(), 5);
}

TEST_F(TagFinderAtAWall, TakesNoWallForBlankByAPictureThatIsSmeared) {
  look.found.clear();
  turns_by_rad = 0.2;
  auto const finds = finder();
  pass(700ms);
  EXPECT_EQ(finds->pictures(), 1);
  turns_by_rad = 0.0;
  stand_at(1.0);
  pass(3s);
  EXPECT_EQ(finds->pictures(), 2);
  pass(3s);
  EXPECT_EQ(finds->pictures(), 2) << "that one was sharp";
}

TEST_F(TagFinderAtAWall, TakesNoWordFromASignThatThePicturesEdgeCutsOff) {
  look.found.front().what.box.x = 1.0;
  auto const finds = finder();
  pass(5s);
  EXPECT_TRUE(on_map().empty());
  EXPECT_EQ(finds->pictures(), 3) << "it is looked at again";
}

TEST_F(TagFinderAtAWall, HangsNoSignOnADoorThatHasBeenOpenedSinceItWasMapped) {
  is_open = true;
  auto const finds = finder();
  pass(5s);
  EXPECT_GT(finds->pictures(), 0);
  EXPECT_TRUE(on_map().empty()) << "it hangs somewhere behind";
  is_open = false;
  stand_at(1.5);
  pass(3s);
  EXPECT_EQ(on_map().size(), 1U);
}

TEST_F(TagFinderAtAWall, BelievesAKindOfRoomAloneWhenItIsSeenTwice) {
  look.found.front().what.text.reset();
  look.found.front().what.score = 0.5;
  auto const finds = finder();
  pass(700ms);
  EXPECT_TRUE(on_map().empty());
  pass(300ms);
  ASSERT_EQ(on_map().size(), 1U);
  EXPECT_EQ(std::get<map::PointOfInterest>(on_map().front()->feature.content).text, "office");
}

TEST_F(TagFinderAtAWall, AsksToLookFromBeforeASignOfWhichItReadNoNumber) {
  shorten_wall();
  look.found.front().what.text.reset();
  auto const finds = finder();
  pass(3s);
  look.found.front().what.text = "223";
  look.found.front().crop = "sharper letters";
  auto const view = next_view(*finds);
  ASSERT_TRUE(view);
  EXPECT_NEAR(view->at.x(), 1.0, 0.1);
  EXPECT_NEAR(view->at.y(), 2.0, 0.1);
  EXPECT_NEAR(view->from.x(), 1.0, 0.1);
  EXPECT_LT(view->from.y(), 1.4);
  EXPECT_NEAR(view->bearing_rad, std::numbers::pi / 2.0, 1e-9);
  stand_at(4.0);
  pass(3s);
  EXPECT_FALSE(finds->has_looked()) << "not from anywhere";
  stand_at(view->from.x(), view->from.y());
  pass(3s);
  EXPECT_TRUE(finds->has_looked());
  EXPECT_EQ(point().name, "223");
  EXPECT_EQ(kept.back(), "sharper letters");
  EXPECT_FALSE(next_view(*finds)) << "it is sure now";
  EXPECT_EQ(finds->unread(), 0U);
}

TEST_F(TagFinderAtAWall, BelievesThatThereIsNoNumberWhenItReadsNoneFromBefore) {
  shorten_wall();
  look.found.front().what.text.reset();
  auto const finds = finder();
  pass(3s);
  EXPECT_TRUE(go_and_look(*finds));
  EXPECT_FALSE(next_view(*finds));
  EXPECT_EQ(point().name, "office");
}

TEST_F(TagFinderAtAWall, LooksAgainTwiceAndThenLeavesAnUnreadDoorOnTheMap) {
  shorten_wall();
  look.found.front().what.kind.reset();
  look.found.front().what.score = 0.3;
  texts = {"221", "227", "271", "277", "211"};
  auto const finds = finder();
  pass(3s);
  EXPECT_TRUE(on_map().empty());
  EXPECT_TRUE(go_and_look(*finds));
  EXPECT_TRUE(go_and_look(*finds));
  EXPECT_FALSE(go_and_look(*finds));
  EXPECT_EQ(finds->unread(), 1U);
  ASSERT_EQ(on_map().size(), 1U);
  EXPECT_EQ(point().kind, "door");
  EXPECT_EQ(point().name, "");
  EXPECT_EQ(point().text, "");
  EXPECT_FALSE(point().picture.empty());
  EXPECT_TRUE(finds->texts().empty());
}

TEST_F(TagFinderAtAWall, ForgetsWhatIsNoSignFromNearBy) {
  shorten_wall();
  look.found.front().what.score = 0.3;
  auto const finds = finder();
  pass(700ms);
  look.found.clear();
  EXPECT_TRUE(go_and_look(*finds));
  EXPECT_TRUE(go_and_look(*finds));
  EXPECT_FALSE(go_and_look(*finds));
  EXPECT_EQ(finds->unread(), 0U);
  EXPECT_TRUE(on_map().empty());
}

TEST_F(TagFinderAtAWall, AsksAgainWhenTheRobotDidNotGetThereAndThenTellsOfTheDoor) {
  shorten_wall();
  look.found.front().what.score = 0.3;
  auto const finds = finder();
  pass(700ms);
  stand_at(6.0);
  look.found.clear();
  ASSERT_TRUE(next_view(*finds));
  pass(3s);
  ASSERT_TRUE(next_view(*finds));
  pass(3s);
  EXPECT_FALSE(next_view(*finds));
  EXPECT_EQ(finds->unread(), 1U);
}

TEST_F(TagFinderAtAWall, DoesNotGoBackToAWallThatShowedNothingFromAfar) {
  shorten_wall();
  look.found.clear();
  stand_at(1.0, -0.4);
  auto const finds = finder();
  pass(3s);
  EXPECT_FALSE(next_view(*finds));
}

TEST_F(TagFinderAtAWall, GoesBackToASignThatWasSeenFromAfarAndNotReadAtAll) {
  look.found.front().what.text.reset();
  look.found.front().what.kind.reset();
  stand_at(1.0, -0.4);
  auto const finds = finder();
  pass(3s);
  look.found.front().what.text = "223";
  EXPECT_TRUE(go_and_look(*finds));
  EXPECT_EQ(point().name, "223");
}

TEST_F(TagFinderAtAWall, GoesBackToAWallBesideADoorwayThatItsCamerasDidNotFace) {
  for (std::int32_t x = 46; x < 64; ++x)
    for (std::int32_t y = 40; y < 60; ++y) grid.set({x, y}, map::Evidence::of_probability(0.1));
  put_grid();
  stand_at(1.5, 0.8, std::numbers::pi);
  auto const finds = finder();
  pass(3s);
  EXPECT_EQ(finds->pictures(), 0);
  EXPECT_TRUE(is_any_left(*finds, WallChoice::likely));
  EXPECT_TRUE(is_any_left(*finds, WallChoice::likely)) << "who asks does not look";
  auto const view = next_view(*finds);
  ASSERT_TRUE(view);
  EXPECT_NEAR(view->at.y(), 2.0, 0.05);
  EXPECT_GT(view->at.x(), 1.4);
  EXPECT_LT(view->at.x(), 2.3);
}

TEST_F(TagFinderAtAWall, ComparesWallsBesideTheLoop) {
  look.found.clear();
  stand_at(1.0, 0.4, std::numbers::pi);
  auto const finds = finder();
  pass(3s);
  auto choosing = finds->next_view();
  choosing.start();
  EXPECT_EQ(loop.jobs_on_pool(), 1U);
  pass(1s);
  ASSERT_TRUE(choosing.done());
  EXPECT_TRUE(choosing.take());
}

TEST_F(TagFinderAtAWall, LooksAtWallsFarFromDoorwaysThatItsCamerasDidNotFaceAndAtMuchOfThemAtOnce) {
  look.found.clear();
  stand_at(1.0, 0.4, std::numbers::pi);
  auto const finds = finder();
  pass(3s);
  EXPECT_EQ(finds->pictures(), 0);
  int looks = 0;
  EXPECT_TRUE(is_any_left(*finds, WallChoice::any));
  EXPECT_FALSE(is_any_left(*finds, WallChoice::likely)) << "there is no doorway";
  while (looks < 20 && go_and_look(*finds)) ++looks;
  EXPECT_FALSE(is_any_left(*finds, WallChoice::any));
  EXPECT_GE(looks, 3);
  EXPECT_LE(looks, 8) << "7 m of wall came before it, and a picture shows more than one";
}

TEST_F(TagFinderAtAWall, NoticesASignFromAfarAndReadsItFromNear) {
  stand_at(1.0, -2.5);
  auto const finds = finder();
  pass(3s);
  EXPECT_GT(finds->pictures(), 0);
  EXPECT_TRUE(on_map().empty());
  EXPECT_TRUE(go_and_look(*finds));
  ASSERT_EQ(on_map().size(), 1U);
  EXPECT_EQ(point().name, "221");
  EXPECT_NEAR(point().position.x(), 1.0, 0.3);
}

TEST_F(TagFinderAtAWall, LooksOnceWhereNothingIsWritten) {
  look.found.clear();
  auto const finds = finder();
  pass(5s);
  EXPECT_EQ(finds->pictures(), 1);
}

TEST_F(TagFinderAtAWall, TakesItsSignsAlongWhenTheMapMoves) {
  auto const finds = finder();
  pass(3s);
  ASSERT_EQ(on_map().size(), 1U);
  auto const pictures = finds->pictures();
  finds->move([](geo::Pose<geo::SiteFrame> const& before) -> geo::Pose<geo::SiteFrame> {
    return {{before.position.x() + 0.8, before.position.y()}, before.yaw_rad};
  });
  ASSERT_EQ(on_map().size(), 1U);
  EXPECT_NEAR(point().position.x(), 1.8, 0.05);
  stand_at(1.8);
  pass(3s);
  EXPECT_EQ(on_map().size(), 1U) << "it is the same sign";
  EXPECT_EQ(finds->pictures(), pictures) << "which has been looked at";
}

TEST_F(TagFinderAtAWall, ShowsASignOnceThatTwoPassagesHadPlacedApart) {
  auto const finds = finder();
  pass(3s);
  stand_at(2.5);
  pass(3s);
  ASSERT_EQ(on_map().size(), 2U);
  finds->move([](geo::Pose<geo::SiteFrame> const& before) -> geo::Pose<geo::SiteFrame> {
    bool const is_of_the_first = before.position.x() < 1.75;
    return {{is_of_the_first ? before.position.x() + 1.3 : before.position.x(), before.position.y()}, before.yaw_rad};
  });
  ASSERT_EQ(on_map().size(), 1U);
  EXPECT_EQ(point().name, "221");
  EXPECT_NEAR(point().position.x(), 2.4, 0.15);
  EXPECT_EQ(finds->texts(), std::vector<std::string>{"221 office"});
}

TEST_F(TagFinderAtAWall, ForgetsWhatTheRobotFoundAnotherTime) {
  {
    auto const earlier = finder();
    pass(3s);
  }
  ASSERT_EQ(on_map().size(), 1U);
  look.found.clear();
  auto const later = finder();
  EXPECT_TRUE(on_map().empty());
}

}  // namespace
}  // namespace lapwing::robot
