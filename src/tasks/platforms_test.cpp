#include "tasks/platforms.hpp"

#include "tasks/testing/script.hpp"

namespace lapwing::tasks {
namespace {

using namespace testing;

/// What only boats can do.
class Swim final : public PlatformTask {
 public:
  [[nodiscard]] std::string name() const override { return "swim"; }
  [[nodiscard]] std::optional<std::string> unsuited(VehicleInfo const&) const override { return std::nullopt; }
  [[nodiscard]] std::optional<geo::Wgs84> reference_position() const override { return std::nullopt; }
};

class SwimSession final : public BuilderSession {
 public:
  base::Result<> add(std::size_t, std::size_t, std::span<Argument const>) override { return {}; }
  base::Result<std::shared_ptr<PlatformTask const>> finish() override { return std::make_shared<Swim const>(); }
};

BuilderSpec swim_block(std::string_view doc = "Swims.") {
  return {.name = "swim",
          .commands = {{.name = "depth", .overloads = {{{{.name = "m"}}}}, .doc = "How deep."}},
          .doc = doc,
          .begin = [] { return std::make_unique<SwimSession>(); }};
}

VehicleInstruction blow_horn(std::string_view doc = "Blows it.") {
  return {.name = "blowHorn", .parameters = {{.name = "times"}}, .doc = doc, .usage = "takes vehicles and a number"};
}

VehicleInfo boat(std::string id) {
  VehicleInfo info;
  info.id = {std::move(id)};
  info.type = "USV";
  return info;
}

/// Harness with vehicles of its own: boats that swim and have a horn, and know no other tasks.
class Boats final : public HarnessPlatform {
 public:
  explicit Boats(base::Loop& loop, Vocabulary vocabulary = {{swim_block()}, {blow_horn()}})
      : HarnessPlatform(loop, std::move(vocabulary)), loop_(loop) {}
  [[nodiscard]] std::vector<VehicleInfo> vehicles() const override { return boats; }
  [[nodiscard]] std::optional<VehicleInfo> find(VehicleId const& id) const override {
    auto const found = std::ranges::find(boats, id, &VehicleInfo::id);
    return found == boats.end() ? std::nullopt : std::optional(*found);
  }
  [[nodiscard]] base::Result<std::shared_ptr<PlatformTask const>> named_task(std::string_view name) const override {
    if (name == "broken") return base::fail(base::ErrorKind::io, "broken.plan cannot be read");
    if (name == "regatta") return std::make_shared<Swim const>();
    return base::fail(base::ErrorKind::not_found, "no such regatta");
  }
  [[nodiscard]] std::vector<std::string> plan_names() const override { return plans; }
  [[nodiscard]] base::TimePoint all_heard_by() const override { return base::TimePoint(seconds(7)); }
  void set_connection_timeout(VehicleId const& id, base::Duration) override { said.push_back("timeout " + id.text); }
  base::Result<> perform(InstructionCall const& call, VehicleId const& id) override {
    said.push_back(fmt::format("{} {} {}", call.name, id.text, std::get<double>(call.arguments.front())));
    return {};
  }
  base::Task<void> settle() override {
    co_await loop_.sleep(seconds(3));
    said.emplace_back("settled");
  }
  void arrive(std::string id) {
    boats.push_back(boat(std::move(id)));
    vehicles_changed().notify_all();
  }

  std::vector<VehicleInfo> boats{boat("b1"), boat("b2")};
  std::vector<std::string> said;
  std::vector<std::string> plans{"regatta"};

 private:
  [[nodiscard]] base::Result<std::optional<base::Duration>> length_of(PlatformTask const& task,
                                                                      VehicleInfo const& /*vehicle*/) const override {
    if (task.name() == "swim") return std::optional(seconds(2));
    return base::fail(base::ErrorKind::refused, "boats only swim");
  }
  base::Loop& loop_;
};

struct PlatformsTest : ::testing::Test {
  PlatformsTest() {
    hub.add_sink([this](base::LogRecord const& record) { lines.push_back(record.text); });
    EXPECT_TRUE(both.add("test", stage.platform));
    EXPECT_TRUE(both.add("boats", boats));
  }
  Allocation allocated(TaskTree const& tree, std::vector<std::string> const& ids) {
    std::vector<VehicleInfo> vehicles;
    for (auto const& id : ids) vehicles.push_back(*both.find({id}));
    auto const result =
        allocate(tree, vehicles, [this](auto const& task, auto const& one) { return both.unsuited(task, one); });
    EXPECT_TRUE(result) << result.error().message;
    return *result;
  }

  Stage stage;
  Boats boats{stage.loop};
  base::LogHub hub;
  std::vector<std::string> lines;
  Platforms both{stage.loop, base::Logger(hub, "platforms")};
};

TEST_F(PlatformsTest, HaveTheVehiclesWordsAndPlansOfAll) {
  std::vector<std::string> ids;
  for (auto const& info : both.vehicles()) ids.push_back(info.id.text);
  EXPECT_EQ(ids, (Trace{"a1", "a2", "u1", "u2", "b1", "b2"}));
  EXPECT_EQ(both.vocabulary().builders.at(0).name, "swim");
  EXPECT_EQ(both.vocabulary().instructions.at(0).name, "blowHorn");
  EXPECT_EQ(both.plan_names(), Trace{"regatta"});
  EXPECT_EQ((*both.named_task("regatta"))->name(), "swim");
  EXPECT_EQ((*both.named_task("A:1"))->name(), "A");
  EXPECT_EQ(both.named_task("broken").error().message, "broken.plan cannot be read")
      << "it is known, so it is no other's";
  EXPECT_EQ(both.named_task("x").error().message, "there is no plan called 'x'") << "as the first says it";
  EXPECT_EQ(both.all_heard_by(), boats.all_heard_by());
}

TEST_F(PlatformsTest, SendEachTaskToThePlatformOfItsVehicle) {
  auto const tree = sequence(concurrent(stage.task("A:1"), performed(*both.named_task("regatta"))), stage.task("B:1"));
  Execution execution(tree, allocated(tree, {"b1", "a1"}), both, stage.observer());
  EXPECT_TRUE(stage.loop.run_until_done(run(stage.loop, execution)).is_done());
  EXPECT_EQ(stage.trace, (Trace{"0.0 START A@a1", "0.0 START swim@b1", "1.0 DONE A@a1", "2.0 DONE swim@b1",
                                "2.0 START B@a1", "3.0 DONE B@a1"}));
}

TEST_F(PlatformsTest, SayWhyAVehicleOfAnotherPlatformCannot) {
  auto const unsuited = [this](auto const& task, auto const& one) { return both.unsuited(task, one); };
  auto const failed = allocate(performed(*both.named_task("regatta")), {*both.find({"a1"})}, unsuited);
  EXPECT_EQ(failed.error().message, "No vehicles to run task swim! (a1: swim is a task of another platform)");
  EXPECT_EQ(allocate(stage.task("A:1"), {*both.find({"b1"})}, unsuited).error().message,
            "No vehicles to run task A! (b1: boats only swim)");
}

TEST_F(PlatformsTest, TellAVehicleByThePlatformThatHasIt) {
  std::vector<Argument> const arguments{2.0};
  InstructionCall const horn{.name = "blowHorn", .arguments = arguments};
  EXPECT_TRUE(both.perform(horn, {"b2"}));
  EXPECT_EQ(both.perform(horn, {"a1"}).error().message, "these vehicles know no blowHorn");
  EXPECT_EQ(both.perform(horn, {"z"}).error().kind, base::ErrorKind::lost);
  both.set_connection_timeout({"b1"}, seconds(9));
  both.set_connection_timeout({"a1"}, seconds(9));
  EXPECT_EQ(boats.said, (Trace{"blowHorn b2 2", "timeout b1"}));
  EXPECT_EQ(stage.platform.find({"a1"})->connection_timeout, seconds(9));
}

TEST_F(PlatformsTest, WaitUntilAllHaveSettled) {
  stage.loop.run_until_done(both.settle());
  EXPECT_EQ(boats.said, Trace{"settled"});
  EXPECT_EQ(stage.now_s(), 3.0);
}

TEST_F(PlatformsTest, TellWhenAVehicleOfAnyOfThemComes) {
  auto arrived = both.vehicles_changed().wait_for([this] { return both.find({"b3"}).has_value(); }, seconds(10));
  stage.loop.post([this] { boats.arrive("b3"); });
  EXPECT_TRUE(stage.loop.run_until_done(std::move(arrived)));
  EXPECT_LT(stage.now_s(), 1.0);
}

TEST_F(PlatformsTest, GiveNobodyAVehicleWhoseIdTwoOfThemHave) {
  auto noticed = both.vehicles_changed().wait_for([this] { return !lines.empty(); }, seconds(10));
  stage.loop.post([this] { boats.arrive("a1"); });
  EXPECT_TRUE(stage.loop.run_until_done(std::move(noticed)));
  auto const conflict = "conflict: test and boats each have a vehicle a1";
  EXPECT_EQ(lines, Trace{fmt::format("{}: neither is commanded until one of them has another id", conflict)});
  auto const info = both.find({"a1"});
  EXPECT_FALSE(info->connected);
  EXPECT_EQ(info->conflict, conflict);
  EXPECT_EQ(std::ranges::count(both.vehicles(), VehicleId{"a1"}, &VehicleInfo::id), 1);
  EXPECT_EQ(allocate(stage.task("A:1"), {*info}).error().message,
            fmt::format("No vehicles to run task A! (a1: {})", conflict));
  auto const run = both.start(*stage.platform.named_task("A:1"), {"a1"});
  EXPECT_EQ(run->state(), RunState::failed);
  EXPECT_EQ(run->error(), conflict);
  EXPECT_TRUE(run->vehicle_failed());
  EXPECT_EQ(both.perform({.name = "blowHorn"}, {"a1"}).error().message, conflict);
  EXPECT_TRUE(boats.said.empty());
  std::erase_if(boats.boats, [](auto const& one) { return one.id.text == "a1"; });
  auto over = both.vehicles_changed().wait_for([this] { return lines.size() > 1; }, seconds(10));
  stage.loop.post([this] { boats.vehicles_changed().notify_all(); });
  EXPECT_TRUE(stage.loop.run_until_done(std::move(over)));
  EXPECT_EQ(lines.back(), "there is one vehicle a1 again");
  EXPECT_TRUE(both.find({"a1"})->connected);
}

TEST(Platforms, ShareAWordThatSaysTheSameOnBoth) {
  Stage stage;
  Boats some(stage.loop);
  Boats others(stage.loop);
  others.plans.clear();
  Platforms both(stage.loop, {});
  EXPECT_TRUE(both.add("some", some));
  EXPECT_TRUE(both.add("others", others));
  EXPECT_EQ(both.vocabulary().builders.size(), 1u);
  EXPECT_EQ(both.vocabulary().instructions.size(), 1u);
}

TEST(Platforms, RefuseAWordThatMeansSomethingElseOnAnother) {
  Stage stage;
  Boats boats(stage.loop);
  auto other_command = swim_block();
  other_command.commands[0].overloads[0].parameters[0].dimension = Dimension::length;
  VehicleInstruction instruction_swim = blow_horn();
  instruction_swim.name = "swim";
  std::vector<std::pair<Vocabulary, std::string>> const cases{
      {{{swim_block("Otherwise.")}, {}}, "the block word swim has two meanings"},
      {{{other_command}, {}}, "the block word swim has two meanings"},
      {{{}, {blow_horn("Otherwise.")}}, "the instruction blowHorn has two meanings"},
      {{{}, {instruction_swim}}, "the instruction swim has two meanings"}};
  for (auto const& [words, complaint] : cases) {
    HarnessPlatform other(stage.loop, words);
    Platforms both(stage.loop, {});
    EXPECT_TRUE(both.add("boats", boats));
    auto const added = both.add("other", other);
    ASSERT_FALSE(added) << complaint;
    EXPECT_EQ(added.error().message, "other does not go with the platforms before it: " + complaint);
    EXPECT_EQ(both.vehicles().size(), 2u) << "it has not joined";
  }
}

TEST(Platforms, RefuseAPlanThatTwoOfThemHave) {
  Stage stage;
  Boats some(stage.loop);
  Boats others(stage.loop);
  Platforms both(stage.loop, {});
  EXPECT_TRUE(both.add("some", some));
  EXPECT_EQ(both.add("others", others).error().message, "others has a plan 'regatta', as another platform has");
}

}  // namespace
}  // namespace lapwing::tasks
