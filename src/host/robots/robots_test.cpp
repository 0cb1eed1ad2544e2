// End to end in simulated time: a building with a robot whose board runs the firmware's program, its line, the map made
// of its laser and wheels alone, a script that drives it, and what the report and the page are told.
#include "host/robots/robots.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "base/testing/temporary_folder.hpp"
#include "host/robots/robots_feed.hpp"
#include "host/session/console.hpp"
#include "host/session/session.hpp"

namespace lapwing::host {
namespace {

using namespace std::chrono_literals;
using nlohmann::json;

/// Two rooms of 4 by 4 m with a doorway of 1 m between them.
constexpr auto two_rooms = R"(
name = "Two rooms"
origin = [20.0, -10.0]
wall_thickness_m = 0.1

[[wall]]
line = [[0, 0], [8, 0], [8, 4], [0, 4]]
closed = true
[[wall]]
line = [[4, 0], [4, 1.5]]
[[wall]]
line = [[4, 2.5], [4, 4]]

[[start]]
at = [1.5, 2]
)";
constexpr double free_m2 = 7.9 * 3.9 - 0.3;  // between the walls

struct RobotsInABuilding : ::testing::Test {
  void SetUp() override {
    auto const added = session.add_robots({"sim:" + folder.write("rooms.toml", two_rooms)},
                                          geo::Wgs84::from_degrees(41.178, -8.598, 90.0));
    ASSERT_TRUE(added) << added.error().message;
  }
  /// Runs the script to its end and gives the outcome's word.
  std::string run(std::string const& script) {
    auto const started = session.host.start("test.dolphin", script);
    EXPECT_TRUE(started) << session.host.rendered_diagnostics();
    if (!started) return "does not check";
    session.run_to_end(30min);
    return outcome_word(*session.host.outcome());
  }
  [[nodiscard]] sim::building::Building& building() { return *session.buildings.front()->building; }

  base::testing::TemporaryFolder folder;
  Session session{{.speedup = 0.0, .log_level = base::LogLevel::error, .seed = 1}};
};

TEST_F(RobotsInABuilding, MapTheFloorAndComeBack) {
  auto const start = building().robot(0).body().pose();
  EXPECT_EQ(run("robot = pick { type 'UGV'; payload 'Laser'; timeout 60 }\n"
                "execute robot: drive { name 'Rooms'; explore(); returnToStart() }\n"
                "message \"${coverage(robot) > 0.95}\""),
            "done")
      << session.host.outcome()->message;
  EXPECT_TRUE(building().collisions().empty());
  EXPECT_LT(geo::distance_m(building().robot(0).body().pose().position, start.position), 0.6);

  auto const report = json::parse(to_json(session.report()));
  auto const& robot = report["vehicles"][0];
  EXPECT_EQ(robot["id"], "robot1");
  EXPECT_EQ(robot["type"], "robot");
  EXPECT_GE(robot["robot"]["coverage"].get<double>(), 0.95);
  EXPECT_NEAR(robot["robot"]["free_m2"].get<double>(), free_m2, 0.08 * free_m2);
  EXPECT_EQ(robot["robot"]["collisions"], 0);
  ASSERT_EQ(robot["robot"]["drives"].size(), 1U);
  EXPECT_EQ(robot["robot"]["drives"][0]["name"], "Rooms");
  EXPECT_EQ(robot["robot"]["drives"][0]["outcome"], "done");
  EXPECT_EQ(robot["robot"]["drives"][0]["error"], "");
  // That no camera looked at each piece of wall from near is all that may be left.
  auto const remark = robot["robot"]["drives"][0].value("remark", std::string());
  EXPECT_TRUE(remark.empty() || remark.starts_with("explore: walls without a doorway are left")) << remark;

  // On the map where the building stands, and told to the page.
  auto const& grid = session.live_map.grids().at({"default", "", "robot 1"}).grid;
  geo::Point<geo::SiteFrame> const other_room(20.0 + 6.0, -10.0 + 2.0);
  auto const cell = grid.cell_at(grid.site_from_grid().inverse() * other_room);
  EXPECT_LT(grid.at(cell).probability(), 0.2);
  RobotsFeed feed(session.robots, session.live_map);
  auto const revision = feed.refresh(session.loop.now());
  auto const told = json::parse(feed.since(0, session.loop.now(), 1 << 20).frames.front().content);
  EXPECT_GT(revision, 0u);
  EXPECT_EQ(told["robots"][0]["id"], "robot1");
  EXPECT_TRUE(told["robots"][0]["frontiers"].empty());
  EXPECT_GT(told["robots"][0]["spread"]["major_m"].get<double>(), 0.0);
}

/// Sees one sign wherever it is in the picture of a camera that looks to the left, by the truth; nothing is rendered,
/// and the wall between the rooms hides it.
struct RobotsWithAStandInEye : RobotsInABuilding {
  void SetUp() override {
    RobotsInABuilding::SetUp();
    camera.yaw_rad = 1.57;
    robot::Eyes eyes;
    robot::CameraMount const mount{.x_m = camera.x_m, .yaw_rad = camera.yaw_rad};
    eyes.for_tags.push_back({.mount = mount, .look = [this] { return look(); }});
    eyes.photographer = {.mount = mount, .take = [] { return photograph(); }};
    eyes.keep = [this](std::string jpeg) { return keep(std::move(jpeg)); };
    session.robots.open_eyes(*session.robots.robots().front(), std::move(eyes));
  }
  base::Task<std::optional<robot::Look>> look() {
    auto const at = sim::building::pixel_of(sign, camera_on(building().robot(0).body().pose(), camera), camera);
    robot::Look seen;
    ++looks;
    bool const is_in_its_room = building().robot(0).body().pose().position.x() > 4.0;
    if (is_in_its_room && at && at->x() > 40.0 && at->x() < camera.width - 40.0 && at->y() > 20.0 &&
        at->y() < camera.height - 20.0)
      seen.found.push_back({.what = {.category = "sign",
                                     .box = {.x = at->x() - 20.0, .y = at->y() - 10.0, .width = 40.0, .height = 20.0},
                                     .score = 0.9,
                                     .text = "221"},
                            .crop = "its letters"});
    if (!seen.found.empty() && !is_before_the_sign() && reads == Reads::from_before) {
      seen.found.front().what.text.reset();
      seen.found.front().what.kind = "meeting room";
    }
    if (!seen.found.empty() && reads == Reads::another_each_time) {
      seen.found.front().what.text = std::to_string(100 + looks);
      seen.found.front().what.score = 0.3;
    }
    co_return seen;
  }
  /// Nearer than 1.7 m, and not aslant.
  [[nodiscard]] bool is_before_the_sign() const {
    auto const& at = session.buildings.front()->building->robot(0).body().pose().position;
    double const off_m = sign.y() - at.y();
    return off_m < 1.7 && std::abs(sign.x() - at.x()) < 0.4 * off_m;
  }
  static base::Task<base::Result<robot::Photograph>> photograph() {
    co_return robot::Photograph{.jpeg = "all", .thumbnail = "small", .width_px = 960, .height_px = 720};
  }
  base::Task<base::Result<std::string>> keep(std::string jpeg) {
    kept.push_back(std::move(jpeg));
    co_return std::string(63, 'a') + static_cast<char>('0' + kept.size() % 10);
  }

  sim::building::CameraSettings camera;
  Eigen::Vector3d const sign{6.0, 3.95, 1.5};  ///< on the far wall of the other room
  enum class Reads { always, from_before, another_each_time } reads = Reads::always;
  int looks = 0;
  std::vector<std::string> kept;
};

TEST_F(RobotsWithAStandInEye, FindADoorGoToItAndPhotographIt) {
  EXPECT_EQ(run("robot = pick { type 'UGV'; payload 'Camera'; timeout 60 }\n"
                "execute robot: drive { explore() } / { foundDoors(robot) >= 1 } >>\n"
                "    drive { explore(); driveTo 'room 221'; photograph() }\n"
                "message \"${foundDoors(robot)}\""),
            "done")
      << session.host.outcome()->message;
  auto const& map = session.live_map;
  auto const tags = map.within(map::LayerKind::points_of_interest, "default", std::nullopt, 10);
  ASSERT_EQ(tags.size(), 1U);
  auto const& tag = std::get<map::PointOfInterest>(tags.front()->feature.content);
  EXPECT_EQ(tag.name, "221");
  EXPECT_NEAR(tag.position.x(), 20.0 + sign.x(), 0.2) << "on the site";
  EXPECT_NEAR(tag.position.y(), -10.0 + sign.y(), 0.2);
  EXPECT_NEAR(tag.height_m, sign.z(), 0.1);
  EXPECT_FALSE(tag.picture.empty());
  EXPECT_LT(geo::distance_m(building().robot(0).body().pose().position, {sign.x(), sign.y()}), 1.5) << "before it";

  auto const pictures = map.within(map::LayerKind::pictures, "default", std::nullopt, 10);
  ASSERT_EQ(pictures.size(), 1U);
  auto const& picture = std::get<map::Picture>(pictures.front()->feature.content);
  EXPECT_EQ(picture.vehicle, "robot1");
  EXPECT_TRUE(picture.site_from_camera);
  EXPECT_EQ(kept.back(), "small");
  auto const report = json::parse(to_json(session.report()))["vehicles"][0]["robot"];
  EXPECT_EQ(report["doors"], 1);
  EXPECT_EQ(report["signs"], json::parse(R"(["221"])"));
}

TEST_F(RobotsWithAStandInEye, GoBeforeASignOfWhichTheyReadAPart) {
  reads = Reads::from_before;
  EXPECT_EQ(run("robot = pick { type 'UGV'; payload 'Camera'; timeout 60 }\n"
                "execute robot: drive { explore(); driveTo 'room 221'; returnToStart() }"),
            "done")
      << session.host.outcome()->message;
  auto const tags = session.live_map.within(map::LayerKind::points_of_interest, "default", std::nullopt, 10);
  ASSERT_EQ(tags.size(), 1U);
  EXPECT_EQ(std::get<map::PointOfInterest>(tags.front()->feature.content).text, "221 meeting room");
  EXPECT_TRUE(building().collisions().empty());
}

TEST_F(RobotsWithAStandInEye, LeaveASignThatCannotBeReadOnTheMapAsADoor) {
  reads = Reads::another_each_time;
  EXPECT_EQ(run("robot = pick { type 'UGV'; payload 'Camera'; timeout 60 }\n"
                "execute robot: drive { explore() }"),
            "done")
      << session.host.outcome()->message;
  auto const tags = session.live_map.within(map::LayerKind::points_of_interest, "default", std::nullopt, 10);
  ASSERT_EQ(tags.size(), 1U);
  auto const& door = std::get<map::PointOfInterest>(tags.front()->feature.content);
  EXPECT_EQ(door.kind, "door");
  EXPECT_EQ(door.text, "");
  EXPECT_FALSE(door.picture.empty());
  auto const report = json::parse(to_json(session.report()))["vehicles"][0]["robot"];
  EXPECT_EQ(report["doors"], 0);
  EXPECT_EQ(report["drives"][0]["remark"], "explore: 1 sign could not be read");
}

TEST_F(RobotsInABuilding, AreGuardedByWhatTheyHaveSeen) {
  EXPECT_EQ(run("robot = pick { id 'robot1'; timeout 60 }\n"
                "execute robot: drive { explore() } / { coverage(robot) > 0.3 }"),
            "done");
  auto const& survey = session.robots.robots().front()->survey();
  EXPECT_GT(survey->coverage, 0.3);
  EXPECT_LT(survey->coverage, 0.95) << "it was stopped before the end";
}

TEST_F(RobotsInABuilding, AreStoppedByTheEmergencyStopOfAll) {
  base::Scope scope(session.loop);
  scope.spawn([](Session& here) -> base::Task<> {
    auto const& robot = *here.robots.robots().front();
    while (!robot.has_been_heard() || robot.state().motion.track_m < 1.0) co_await here.loop.sleep(100ms);
    here.all_control.emergency_stop(std::nullopt, "anna");
  }(session));
  EXPECT_EQ(run("robot = pick { id 'robot1'; timeout 60 }\nexecute robot: drive { explore() }"), "halted");
  session.loop.run_until_done([](Session& here) -> base::Task<> { co_await here.loop.sleep(2s); }(session));
  EXPECT_TRUE(session.robots.robots().front()->is_killed());
  EXPECT_LT(std::abs(building().robot(0).body().speed_m_s()), 0.01);
}

TEST(Robots, SayWhatIsWrongWithABuilding) {
  base::testing::TemporaryFolder const folder;
  auto const file = folder.write("broken.toml", "[[wall]]\nline = 7\n");
  Session session{{.speedup = 0.0, .log_level = base::LogLevel::error}};
  auto const anchor = geo::Wgs84::from_degrees(41.0, -8.0);
  auto const broken = session.add_robots({"sim:" + file}, anchor);
  ASSERT_FALSE(broken);
  EXPECT_NE(broken.error().message.find("broken.toml"), std::string::npos) << broken.error().message;
  EXPECT_FALSE(session.add_robots({"sim:" + (folder.path() / "none.toml").string()}, anchor));
}

}  // namespace
}  // namespace lapwing::host
