#include "autonomy/words/vocabulary.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "autonomy/words/lot_task.hpp"

namespace lapwing::autonomy {
namespace {

auto const place = geo::Wgs84::from_degrees(43.2585, -79.9201);

/// Gives commands by their names, with all arguments.
struct Block {
  tasks::Vocabulary words = vocabulary();
  std::unique_ptr<tasks::BuilderSession> session = words.builders.front().begin();

  base::Result<> add(std::string_view name, std::vector<tasks::Argument> const& arguments = {}) {
    auto const& commands = words.builders.front().commands;
    auto const found = std::ranges::find(commands, name, &tasks::CommandSpec::name);
    return session->add(static_cast<std::size_t>(found - commands.begin()), 0, arguments);
  }
};

TEST(LotBlock, BuildsTheStepsInTheirOrder) {
  Block block;
  ASSERT_TRUE(block.add("name", {std::string("Campus")}));
  ASSERT_TRUE(block.add("explore"));
  ASSERT_TRUE(block.add("moveTo", {place}));
  ASSERT_TRUE(block.add("moveAnyway", {place}));
  ASSERT_TRUE(block.add("wait", {std::int64_t{5}}));
  ASSERT_TRUE(block.add("comeHome"));
  auto const built = block.session->finish();
  ASSERT_TRUE(built);
  auto const& task = dynamic_cast<LotTask const&>(**built);
  EXPECT_EQ(task.name(), "Campus");
  std::vector<Step> const wanted{ExploreStep{}, MoveStep{place}, MoveStep{place, true}, WaitStep{5.0}, ComeHomeStep{}};
  EXPECT_EQ(task.steps(), wanted);
  EXPECT_EQ(task.reference_position(), place);
}

TEST(LotBlock, CountsThoseWithoutAName) {
  Block block;
  ASSERT_TRUE(block.add("explore"));
  auto const built = block.session->finish();
  ASSERT_TRUE(built);
  EXPECT_EQ((*built)->name(), "Lot_1");
  EXPECT_EQ((*built)->reference_position(), std::nullopt);
}

TEST(LotBlock, RefusesWhatNobodyCanFly) {
  Block block;
  ASSERT_TRUE(block.add("name", {std::string("Nothing")}));
  EXPECT_EQ(block.session->finish().error().message, "a lot needs a command that flies");
  EXPECT_EQ(block.add("wait", {-1.0}).error().message, "the time to wait must be 0 or more");
}

TEST(LotTask, SuitsWhatFlies) {
  LotTask const task("x", {ExploreStep{}});
  tasks::VehicleInfo info;
  info.type = "UAV";
  EXPECT_FALSE(task.unsuited(info));
  info.type = "UGV";
  EXPECT_EQ(task.unsuited(info), "a UGV does not fly over a car park");
}

}  // namespace
}  // namespace lapwing::autonomy
