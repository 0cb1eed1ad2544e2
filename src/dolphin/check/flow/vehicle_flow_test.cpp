#include <gtest/gtest.h>

#include <array>
#include <memory>
#include <string>

#include "dolphin/check/checker.hpp"
#include "dolphin/syntax/parser.hpp"
#include "tasks/platform.hpp"

/// What the checker knows of vehicles and tasks of a platform that is not the fleet: its block `dive { }` suits UUVs
/// only.
namespace lapwing::dolphin {
namespace {

class Dive final : public tasks::PlatformTask {
 public:
  [[nodiscard]] std::string name() const override { return "Dive"; }
  [[nodiscard]] std::string kind() const override { return "dive"; }
  [[nodiscard]] std::optional<std::string> unsuited(tasks::VehicleInfo const& vehicle) const override {
    return vehicle.type == "UUV" ? std::nullopt : std::optional("a " + vehicle.type + " cannot dive");
  }
  [[nodiscard]] std::optional<geo::Wgs84> reference_position() const override { return std::nullopt; }
};

class DiveSession final : public tasks::BuilderSession {
 public:
  base::Result<> add(std::size_t, std::size_t, std::span<tasks::Argument const>) override { return {}; }
  base::Result<std::shared_ptr<tasks::PlatformTask const>> finish() override { return std::make_shared<Dive const>(); }
};

std::string complaints(std::string const& script) {
  base::SourceFile const source("t", script);
  base::Diagnostics diagnostics(source);
  tasks::Vocabulary vocabulary;
  vocabulary.builders.push_back(
      {.name = "dive", .commands = {}, .doc = "Dives.", .begin = [] { return std::make_unique<DiveSession>(); }});
  auto const program = parse(diagnostics);
  check(program, vocabulary, diagnostics);
  return render(diagnostics);
}

TEST(VehicleFlow, RefusesTasksThatThePickedTypeCannotDo) {
  EXPECT_EQ(complaints("v = pick { type 'UGV' }\nd = dive { }\nexecute v: d >> idle(1)"),
            "t:3:9: error: v does not suit this dive: a UGV cannot dive [unsuited-vehicle]\n"
            "    3 | execute v: d >> idle(1)\n"
            "      |         ^ pick another type, or leave out what it cannot do\n"
            "t:1:5: note: picked here\n"
            "    1 | v = pick { type 'UGV' }\n"
            "      |     ^~~~\n"
            "t:2:5: note: made here\n"
            "    2 | d = dive { }\n"
            "      |     ^~~~\n");
}

TEST(VehicleFlow, RefusesTasksThatNoneOfThePickedTypesCanDo) {
  auto const text = complaints("v = pick { type 'UGV' } + pick { type 'UAV' }\nexecute v: dive { }");
  EXPECT_NE(text.find("t:2:9: error: v does not suit this dive: a UGV cannot dive [unsuited-vehicle]"),
            std::string::npos)
      << text;
}

TEST(VehicleFlow, SaysNothingOfTypesThatItDoesNotKnow) {
  EXPECT_EQ(complaints("v = pick { type 'UUV' }\nexecute v: dive { }"), "");
  EXPECT_EQ(complaints("v = pick { }\nexecute v: dive { }"), "");
  EXPECT_EQ(complaints("v = pick { type ask('which?') }\nexecute v: dive { }"), "");
  EXPECT_EQ(complaints("v = pick { type 'UGV' } + pick { type 'UUV' }\nexecute v: dive { }"), "");
  EXPECT_EQ(complaints("v = pick { type 'UGV' }\nif (PI > 3) { v = pick { type 'UUV' } }\nexecute v: dive { }"), "");
}

TEST(VehicleFlow, FollowsNoVariableThatAClosureOrFunctionAssigns) {
  EXPECT_EQ(complaints("v = pick { }\nc = { v = pick { } }\nrelease v\nc()\nexecute v: dive { }"), "");
  EXPECT_EQ(complaints("v = pick { }\ndef f() { v = pick { } }\nrelease v\nf()\nexecute v: dive { }"), "");
}

TEST(VehicleFlow, FollowsVehiclesWithinFunctions) {
  auto const text = complaints("def f(v) {\n  release v\n  execute v: dive { }\n}\nf(pick { })");
  EXPECT_NE(text.find("t:3:11: error: dive { } cannot run on v: its vehicles are released [used-after-release]"),
            std::string::npos)
      << text;
}

TEST(VehicleFlow, ReportsNothingTwiceForOneExecute) {
  auto const text = complaints("v = pick { type 'UGV' }\nrelease v\nexecute v: dive { } | dive { } | dive { }");
  EXPECT_NE(text.find("used-after-release"), std::string::npos) << text;
  EXPECT_EQ(text.find("too-few-vehicles"), std::string::npos) << text;
  EXPECT_EQ(text.find("unsuited-vehicle"), std::string::npos) << text;
}

}  // namespace
}  // namespace lapwing::dolphin
