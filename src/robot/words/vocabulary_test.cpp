#include "robot/words/vocabulary.hpp"

#include <gtest/gtest.h>

#include "robot/words/drive_task.hpp"

namespace lapwing::robot {
namespace {

/// Gives commands by their names, with all arguments.
struct Block {
  tasks::Vocabulary words = vocabulary();
  std::unique_ptr<tasks::BuilderSession> session = words.builders.front().begin();

  base::Result<> add(std::string_view name, std::vector<tasks::Argument> const& arguments, std::size_t overload = 0) {
    auto const& commands = words.builders.front().commands;
    auto const found = std::ranges::find(commands, name, &tasks::CommandSpec::name);
    return session->add(static_cast<std::size_t>(found - commands.begin()), overload, arguments);
  }
};

TEST(DriveBlock, BuildsTheStepsInTheirOrder) {
  Block block;
  ASSERT_TRUE(block.add("name", {std::string("Office")}));
  ASSERT_TRUE(block.add("explore", {std::string("tour")}));
  ASSERT_TRUE(block.add("driveTo", {std::string("room 221")}, 1));
  ASSERT_TRUE(block.add("driveTo", {geo::Wgs84::from_degrees(41.0, -8.0)}));
  ASSERT_TRUE(block.add("wait", {std::int64_t{5}}));
  ASSERT_TRUE(block.add("photograph", {}));
  ASSERT_TRUE(block.add("returnToStart", {}));
  auto const built = block.session->finish();
  ASSERT_TRUE(built);
  auto const& task = dynamic_cast<DriveTask const&>(**built);
  EXPECT_EQ(task.name(), "Office");
  std::vector<Step> const wanted{ExploreStep{"tour"},
                                 DriveToNameStep{"room 221"},
                                 DriveToPlaceStep{geo::Wgs84::from_degrees(41.0, -8.0)},
                                 WaitStep{5.0},
                                 PhotographStep{},
                                 ReturnStep{}};
  EXPECT_EQ(task.steps(), wanted);
  EXPECT_EQ(task.reference_position()->lat_deg(), 41.0);
}

TEST(DriveBlock, CountsThoseWithoutAName) {
  Block block;
  ASSERT_TRUE(block.add("returnToStart", {}));
  EXPECT_EQ((*block.session->finish())->name(), "Drive_1");
  auto second = block.words.builders.front().begin();
  ASSERT_TRUE(second->add(3, 0, {}));
  EXPECT_EQ((*second->finish())->name(), "Drive_2");
}

TEST(DriveBlock, RefusesWhatNobodyCanDrive) {
  Block block;
  ASSERT_TRUE(block.add("name", {std::string("Nothing")}));
  EXPECT_EQ(block.session->finish().error().message, "a drive needs a command that drives");
  EXPECT_EQ(block.add("wait", {-1.0}).error().message, "the time to wait must be 0 or more");
  EXPECT_EQ(block.add("driveTo", {std::string()}, 1).error().message, "driveTo needs the name of a place");
}

TEST(DriveTask, SuitsWhatDrivesOnTheGround) {
  DriveTask const task("x", {ReturnStep{}});
  tasks::VehicleInfo info;
  info.type = "UGV";
  EXPECT_FALSE(task.unsuited(info));
  info.type = "UAV";
  EXPECT_EQ(task.unsuited(info), "a UAV does not drive on a floor");
}

TEST(DriveTask, ThatPhotographsSuitsWhatHasACamera) {
  DriveTask const task("x", {ReturnStep{}, PhotographStep{}});
  tasks::VehicleInfo info;
  info.type = "UGV";
  EXPECT_FALSE(task.unsuited(info)) << "what it carries is not known";
  info.payload = {"Laser"};
  EXPECT_EQ(task.unsuited(info), "no payload Camera");
  info.payload.emplace_back("Camera");
  EXPECT_FALSE(task.unsuited(info));
}

}  // namespace
}  // namespace lapwing::robot
