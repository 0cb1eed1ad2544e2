#include "tasks/allocation.hpp"

#include <algorithm>

#include "tasks/testing/script.hpp"

namespace lapwing::tasks {
namespace {

using namespace testing;

/// "Y@a1 W@a2", in the order of the choices.
std::string text(base::Result<Allocation> const& allocation) {
  if (!allocation) return allocation.error().message;
  std::vector<std::string> parts;
  for (auto const& one : allocation->assignments) {
    parts.push_back(fmt::format("{}#{}@{}", one.task->name(), one.occurrence, one.vehicle.text));
  }
  std::string all;
  for (auto const& part : parts) all += (all.empty() ? "" : " ") + part;
  return all;
}

struct AllocationTest : ::testing::Test {
  TaskTree task(std::string_view name) { return stage.task(name); }
  std::string allocated(TaskTree const& tree, std::vector<std::string> const& picked) {
    return text(allocate(tree, stage.pick(picked)));
  }
  Stage stage;
};

/// A task with needs and a place, which those of the harness do not have.
class Survey final : public PlatformTask {
 public:
  Survey(std::string payload, std::optional<geo::Wgs84> where, std::string name = "survey")
      : payload_(std::move(payload)), where_(where), name_(std::move(name)) {}
  [[nodiscard]] std::string name() const override { return name_; }
  [[nodiscard]] std::optional<std::string> unsuited(VehicleInfo const& vehicle) const override {
    if (payload_.empty() || std::ranges::find(vehicle.payload, payload_) != vehicle.payload.end()) return std::nullopt;
    return "no payload " + payload_;
  }
  [[nodiscard]] std::optional<geo::Wgs84> reference_position() const override { return where_; }

 private:
  std::string payload_;
  std::optional<geo::Wgs84> where_;
  std::string name_;
};

TEST_F(AllocationTest, SequenceSharesTheFirstVehicle) {
  EXPECT_EQ(allocated(sequence(task("A:1"), task("B:1")), {"a1", "a2"}), "A#0@a1 B#1@a1");
}

TEST_F(AllocationTest, ConcurrentPartsGetDifferentVehicles) {
  EXPECT_EQ(allocated(concurrent(task("A:1"), task("B:1")), {"a1", "a2"}), "A#0@a1 B#1@a2");
}

TEST_F(AllocationTest, WhatAnyPartOfASequenceTookIsGoneForTheOthers) {
  auto const both = restricted(sequence(restricted(task("A:1"), {{"a1"}}), restricted(task("B:1"), {{"a2"}})),
                               {{"a1"}, {"a2"}, {"u1"}});
  EXPECT_EQ(allocated(concurrent(both, task("C:1")), {"a1", "a2", "u1"}), "A#0@a1 B#1@a2 C#2@u1");
}

TEST_F(AllocationTest, BranchesShareAndTheirUnionIsConsumed) {
  std::vector<Branch> const branches{{always(), concurrent(task("A:1"), task("B:1"))}, {always(), task("C:1")}};
  EXPECT_EQ(allocated(concurrent(*one_of(branches), task("D:1")), {"a1", "a2", "u1"}), "A#0@a1 B#1@a2 C#2@a1 D#3@u1");
  EXPECT_EQ(allocated(concurrent(all_of(branches), task("D:1")), {"a1", "a2", "u1"}), "A#0@a1 B#1@a2 C#2@a1 D#3@u1");
}

TEST_F(AllocationTest, GuardsAndWatchesAllocateAsTheirBody) {
  auto const guarded = watch(during(until(wait_for(always(), task("A:1")), never()), seconds(1)), procedure({}));
  EXPECT_EQ(allocated(guarded, {"a2"}), "A#0@a2");
}

TEST_F(AllocationTest, TasksWithoutVehiclesNeedNone) {
  auto const tree = concurrent(concurrent(doing([] {}), condition(always())), idle(seconds(1)));
  EXPECT_EQ(allocated(tree, {}), "");
}

TEST_F(AllocationTest, OneTaskValueInTwoPlacesGetsTwoVehicles) {  // case 51
  auto const home = task("R:0.3");
  auto const tree = concurrent(restricted(sequence(task("A:0.2"), home), {{"a1"}}),
                               restricted(sequence(task("B:0.4"), home), {{"a2"}}));
  EXPECT_EQ(allocated(tree, {"a1", "a2"}), "A#0@a1 R#1@a1 B#2@a2 R#3@a2");
}

TEST_F(AllocationTest, RestrictedPartsChooseFirst) {  // case 53
  auto const tree = concurrent(concurrent(idle(seconds(0)), concurrent(task("W:0.1"), task("X:0.1"))),
                               restricted(task("Y:0.1"), {{"a1"}}));
  EXPECT_EQ(allocated(tree, {"a1", "a2", "u1"}), "Y#2@a1 W#0@a2 X#1@u1");
}

TEST_F(AllocationTest, NestedRestrictionsIntersect) {
  auto const tree = restricted(restricted(task("A:1"), {{"a2"}, {"u1"}}), {{"a1"}, {"u1"}});
  EXPECT_EQ(allocated(tree, {"a1", "a2", "u1"}), "A#0@u1");
}

TEST_F(AllocationTest, TakesTheSuitableVehicleNearestToTheTask) {
  auto const near_a2 = performed(std::make_shared<Survey>("Camera", geo::Wgs84::from_degrees(41.02, -8.0)));
  EXPECT_EQ(allocated(near_a2, {"a1", "a2", "u1"}), "survey#0@a2");
  auto const anywhere = performed(std::make_shared<Survey>("Multibeam", std::nullopt));
  EXPECT_EQ(allocated(anywhere, {"a1", "a2", "u1"}), "survey#0@u1");
}

TEST_F(AllocationTest, VehicleOfUnknownPositionIsTheLastResortOfAPlacedTask) {
  auto lost_place = *stage.platform.find({"a1"});
  lost_place.position.reset();
  stage.platform.set_vehicle(lost_place);
  auto const placed = performed(std::make_shared<Survey>("Sidescan", geo::Wgs84::from_degrees(42.0, -8.0)));
  EXPECT_EQ(allocated(placed, {"a1", "u1"}), "survey#0@u1");
  EXPECT_EQ(allocated(placed, {"a1"}), "survey#0@a1");
}

TEST_F(AllocationTest, GivesEachTaskTheVehicleAtItsPlaceWhateverTheOrder) {
  auto const to = [](double lat) {
    return performed(
        std::make_shared<Survey const>("", geo::Wgs84::from_degrees(lat, -8.0), fmt::format("to {:.2f}", lat)));
  };
  EXPECT_EQ(allocated(concurrent(to(41.01), to(41.0)), {"a1", "a2"}), "to 41.01#0@a2 to 41.00#1@a1");
  EXPECT_EQ(allocated(concurrent(to(41.0), to(41.01)), {"a1", "a2"}), "to 41.00#0@a1 to 41.01#1@a2");
}

TEST_F(AllocationTest, OfVehiclesThatAreAboutAsNearTakesTheFirst) {
  auto near = *stage.platform.find({"a2"});
  near.position = geo::displaced(*stage.platform.find({"a1"})->position, {.north = 1.0});
  stage.platform.set_vehicle(near);
  auto const placed = performed(std::make_shared<Survey>("Camera", *near.position));
  EXPECT_EQ(allocated(placed, {"a1", "a2"}), "survey#0@a1");
}

TEST_F(AllocationTest, ASecondHalfStaysWithTheVehicleOfTheFirst) {
  auto const here = performed(std::make_shared<Survey>("Camera", geo::Wgs84::from_degrees(41.0, -8.0)));
  auto const there = performed(std::make_shared<Survey>("Camera", geo::Wgs84::from_degrees(41.01, -8.0)));
  EXPECT_EQ(allocated(sequence(here, there), {"a1", "a2"}), "survey#0@a1 survey#1@a1");
  EXPECT_EQ(allocated(concurrent(sequence(here, there), there), {"a1", "a2"}), "survey#0@a1 survey#1@a1 survey#2@a2");
}

TEST_F(AllocationTest, TellsWhoTookTheVehicles) {  // case 36
  auto const tree = concurrent(concurrent(task("A:0.1"), task("B:0.1")), task("C:0.1"));
  EXPECT_EQ(allocated(tree, {"a1", "a2"}), "No vehicles to run task C! (a1: taken by A; a2: taken by B)");
}

TEST_F(AllocationTest, TellsEveryReasonForRejection) {
  auto silent = *stage.platform.find({"u1"});
  silent.connected = false;
  stage.platform.set_vehicle(silent);
  auto const survey = performed(std::make_shared<Survey>("Multibeam", std::nullopt));
  auto const tree = restricted(survey, {{"a1"}, {"u1"}, {"u2"}});
  EXPECT_EQ(allocated(tree, {"a1", "a2", "u1"}),
            "No vehicles to run task survey! (a1: no payload Multibeam; a2: outside the task's vehicle set; u1: lost; "
            "u2: not picked, or released)");
}

TEST_F(AllocationTest, TellsThatNothingIsPicked) {
  EXPECT_EQ(allocated(task("A:1"), {}), "No vehicles to run task A! (no vehicle is picked)");
}

TEST_F(AllocationTest, SameVehicleInTwoRestrictedPartsFails) {
  auto const tree = concurrent(restricted(task("A:1"), {{"a1"}}), restricted(task("B:1"), {{"a1"}}));
  EXPECT_EQ(allocated(tree, {"a1", "a2"}),
            "No vehicles to run task B! (a1: taken by A; a2: outside the task's vehicle set)");
}

TEST_F(AllocationTest, RefusesTreesThatAreTooDeep) {
  auto tree = task("A:1");
  for (int i = 0; i < max_task_depth; ++i) tree = during(tree, seconds(1));
  EXPECT_EQ(allocated(tree, {"a1"}), "the task is nested deeper than 1000 levels");
}

TEST_F(AllocationTest, LongChainsAreFlatNotDeep) {
  auto tree = task("A:1");
  for (int i = 0; i < 2000; ++i) tree = sequence(task("A:1"), tree);
  EXPECT_EQ(tree->depth, 2);
  EXPECT_EQ(allocate(tree, stage.pick({"a1"}))->assignments.size(), 2001u);
}

}  // namespace
}  // namespace lapwing::tasks
