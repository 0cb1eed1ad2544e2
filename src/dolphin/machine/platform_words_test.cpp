// What a platform adds to the language, seen from a script: the checker and the machine know it by its vocabulary
// alone.

#include <sstream>
#include <string>

#include <gtest/gtest.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "dolphin/names/instruction_table.hpp"
#include "dolphin/services/completion.hpp"
#include "dolphin/services/hover.hpp"
#include "dolphin/services/signature_help.hpp"
#include "dolphin/testing/script_bench.hpp"
#include "missions/vocabulary.hpp"
#include "tasks/harness_platform.hpp"

namespace lapwing::dolphin {
namespace {

using tasks::Type;

std::string words_of(geo::Area const& area) {
  if (auto const* disc = std::get_if<geo::Disc>(&area)) return fmt::format("disc of {}", disc->radius_m);
  return fmt::format("{} corners", std::get<geo::Outline>(area).corners.size());
}

std::string words_of(tasks::Argument const& argument) {
  if (auto const* area = std::get_if<geo::Area>(&argument)) return words_of(*area);
  if (auto const* layer = std::get_if<tasks::LayerName>(&argument)) return "layer " + layer->text;
  if (auto const* number = std::get_if<double>(&argument)) return fmt::format("{}", *number);
  if (auto const* whole = std::get_if<std::int64_t>(&argument)) return fmt::format("{}", *whole);
  if (auto const* text = std::get_if<std::string>(&argument)) return *text;
  auto const* list = std::get_if<tasks::List>(&argument);
  if (!list) return "?";
  std::vector<std::string> items;
  for (auto const& item : *list) items.push_back(words_of(tasks::argument_of(item)));
  return fmt::format("[{}]", fmt::join(items, " "));
}

class Sweep final : public tasks::PlatformTask {
 public:
  explicit Sweep(std::string name) : name_(std::move(name)) {}
  [[nodiscard]] std::string name() const override { return name_; }
  [[nodiscard]] std::optional<std::string> unsuited(tasks::VehicleInfo const&) const override { return std::nullopt; }
  [[nodiscard]] std::optional<geo::Wgs84> reference_position() const override { return std::nullopt; }

 private:
  std::string name_;
};

/// The task is called by what was said in the block.
class SweepSession final : public tasks::BuilderSession {
 public:
  base::Result<> add(std::size_t, std::size_t, std::span<tasks::Argument const> arguments) override {
    for (auto const& argument : arguments) said_ += (said_.empty() ? "" : ", ") + words_of(argument);
    if (said_.contains("[0]")) return base::fail(base::ErrorKind::invalid_input, "a speed of 0 gets nowhere");
    return {};
  }
  base::Result<std::shared_ptr<tasks::PlatformTask const>> finish() override {
    return std::make_shared<Sweep const>(said_);
  }

 private:
  std::string said_;
};

tasks::Vocabulary sweeping() {
  using tasks::Dimension;
  tasks::Vocabulary words;
  words.builders.push_back(
      {.name = "sweep",
       .commands = {{.name = "inside", .overloads = {{{{.name = "field", .type = Type::area}}}}, .doc = "Where."},
                    {.name = "onto", .overloads = {{{{.name = "map", .type = Type::layer}}}}, .doc = "The layer."},
                    {.name = "via",
                     .overloads = {{{{.name = "places", .type = Type::list, .items = Type::position}}}},
                     .doc = "On the way."},
                    {.name = "speeds",
                     .overloads = {{{{.name = "values", .type = Type::list, .dimension = Dimension::speed}}}},
                     .doc = "One after the other."}},
       .doc = "Sweeps an area.",
       .begin = [] { return std::make_unique<SweepSession>(); }});
  words.instructions.push_back({.name = "mark",
                                .parameters = {{.name = "field", .type = Type::area, .doc = "what is marked"},
                                               {.name = "times", .type = Type::integer, .fallback = std::int64_t{1}}},
                                .doc = "Marks an area on the ground.",
                                .usage = "takes vehicles, an area and how often"});
  return words;
}

/// The test platform with brushes.
class Sweepers final : public tasks::HarnessPlatform {
 public:
  explicit Sweepers(base::Loop& loop) : HarnessPlatform(loop, sweeping()) {}
  base::Result<> perform(tasks::InstructionCall const& call, tasks::VehicleId const& id) override {
    said += fmt::format("{} {}:", call.name, id.text);
    for (auto const& argument : call.arguments) said += " " + words_of(argument);
    said += '\n';
    if (id.text == "u2") return base::fail(base::ErrorKind::refused, "the brush is worn", "change it");
    return {};
  }
  std::string said;

 private:
  [[nodiscard]] base::Result<std::optional<base::Duration>> length_of(tasks::PlatformTask const&,
                                                                      tasks::VehicleInfo const&) const override {
    return std::optional<base::Duration>(std::chrono::seconds(1));
  }
};

struct PlatformWords : ::testing::Test {
  /// What the run says, or what the checker complains of.
  std::string run(std::string const& script) {
    auto const source = std::make_shared<base::SourceFile const>("t", script);
    base::Diagnostics diagnostics(*source);
    auto const program = load(source, platform.vocabulary(), diagnostics);
    if (!program) return base::render(diagnostics);
    Engine engine(loop, platform, transcript, {}, {.on_event = [this](tasks::TaskEvent const& event) {
                    if (event.kind == tasks::TaskEvent::Kind::done) transcript.text += event.task + "\n";
                  }});
    auto const outcome = loop.run_until_done(engine.run(program));
    if (outcome.kind != Outcome::Kind::done) transcript.text += to_text(outcome) + "\n";
    return transcript.text;
  }
  /// The first mistake that the checker finds.
  std::string first(std::string const& script) {
    std::istringstream lines(run(script));
    for (std::string line; std::getline(lines, line);)
      if (line.contains(": error: ")) return line;
    return "no mistake";
  }

  base::Loop loop{{.unpaced = true}};
  Sweepers platform{loop};
  testing::Transcript transcript;
};

constexpr auto corners = "p = location(41, -8)\nq = location(41.01, -8)\nr = location(41.01, -7.99)\n";

TEST_F(PlatformWords, TakeAreasByTheirCentreOrTheirCorners) {
  EXPECT_EQ(
      run(corners + std::string("v = pick {}\nexecute v: sweep { inside p ^ 50 }\n"
                                "execute v: sweep { inside area(p, 20) }\nexecute v: sweep { inside([p, q, r]) }")),
      "disc of 50\ndisc of 20\n3 corners\n");
}

TEST_F(PlatformWords, TakeListsAndLayers) {
  EXPECT_EQ(run(corners + std::string("v = pick {}\nexecute v: sweep { onto 'slots'; speeds([1, 2.5]); via([p, q]) }\n"
                                      "execute v: sweep { speeds([]) }")),
            "layer slots, [1 2.5], [? ?]\n[]\n");
}

TEST_F(PlatformWords, TakeListsThatOnlyTheRunKnows) {
  EXPECT_EQ(run("v = pick {}\ns = []\ns << 3\ns << 4\nexecute v: sweep { speeds s.collect { it * 2 } }"), "[6 8]\n");
}

TEST_F(PlatformWords, AreCheckedForTheTypesOfListsAreasAndLayers) {
  EXPECT_EQ(first("s = sweep { inside 5 }"),
            "t:1:20: error: field of inside is an area or a list, not a whole number [argument-type]");
  EXPECT_EQ(first("s = sweep { onto 5 }"), "t:1:18: error: map of onto is text, not a whole number [argument-type]");
  EXPECT_EQ(first("s = sweep { speeds 5 }"),
            "t:1:20: error: values of speeds is a list, not a whole number [argument-type]");
  EXPECT_EQ(first("s = sweep { speeds([1, 'fast']) }"),
            "t:1:24: error: item 2 of values of speeds is a speed, not text [argument-type]");
  EXPECT_EQ(first("s = sweep { via([location(41, -8), 7]) }"),
            "t:1:36: error: item 2 of places of via is a position, not a whole number [argument-type]");
  EXPECT_EQ(first("s = sweep { inside([location(41, -8), 7, 8]) }"),
            "t:1:39: error: item 2 of field of inside is a position, not a whole number [argument-type]");
}

TEST_F(PlatformWords, AreCheckedForTheDimensionsOfWhatListsHold) {
  EXPECT_EQ(first("s = sweep { speeds([1, 2.km]) }"),
            "t:1:24: error: item 2 of values of speeds is a speed, not a length [argument-dimension]");
}

TEST_F(PlatformWords, AreCheckedForAreasThatAreNone) {
  EXPECT_EQ(first("s = sweep { inside([location(41, -8), location(41.1, -8)]) }"),
            "t:1:20: error: field of inside is no area: it takes 3 corners, not 2 [argument-value]");
  EXPECT_EQ(first("p = location(41, -8)\ns = sweep { inside p ^ 0 }"),
            "t:2:20: error: field of inside is no area: its radius is not above 0 m [argument-value]");
  EXPECT_EQ(first("p = location(41, -8)\nq = location(41.01, -7.99)\n"
                  "s = sweep { inside([p, q, location(41.01, -8), location(41, -7.99)]) }"),
            "t:3:20: error: field of inside is no area: its edges cross or touch each other [argument-value]");
}

TEST_F(PlatformWords, RefuseAtRunTimeWhatTheCheckerCouldNotKnow) {
  EXPECT_EQ(run("v = pick {}\nf = []\nf << position(v)\nexecute v: sweep { inside f }"),
            "t:4: MissionError: inside: field is no area: it takes 3 corners, not 1\n");
}

TEST_F(PlatformWords, AreRehearsedWithTheListsThatAreKnown) {
  EXPECT_EQ(first("s = sweep { speeds([0]) }"), "t:1:13: error: a speed of 0 gets nowhere [invalid-mission]");
}

TEST_F(PlatformWords, InstructVehiclesOneByOne) {
  EXPECT_EQ(run("p = location(41, -8)\nv = pick { count 2 }\nmark v, p ^ 5\nmark v, p ^ 6, 3\nmessage 'done'"),
            "Program message: done\n");
  EXPECT_EQ(platform.said, "mark a1: disc of 5 1\nmark a2: disc of 5 1\nmark a1: disc of 6 3\nmark a2: disc of 6 3\n");
}

TEST_F(PlatformWords, OfAnInstructionAreChecked) {
  EXPECT_EQ(first("v = pick {}\nmark v, 'here'"),
            "t:2:9: error: field of mark is an area or a list, not text [argument-type]");
  EXPECT_EQ(first("v = pick {}\nmark v"), "t:2:1: error: mark does not take 1 argument [argument-count]");
  EXPECT_EQ(first("v = pick {}\nmark v, location(41, -8) ^ 0"),
            "t:2:9: error: field of mark is no area: its radius is not above 0 m [argument-value]");
  EXPECT_EQ(first("v = pick {}\nmark v, location(41, -8) ^ 5, colour: 1"),
            "t:2:31: error: mark has no named arguments [named-arguments]");
  EXPECT_EQ(first("v = pick {}\nmork v, location(41, -8) ^ 5"),
            "t:2:1: error: there is no instruction mork [unknown-instruction]");
  EXPECT_EQ(first("x = mark"), "t:1:5: error: mark is an instruction, not a variable [instruction-as-value]");
  EXPECT_EQ(first("sendMessage 1, 'HEARTBEAT'"),
            "t:1:1: error: there is no instruction sendMessage [unknown-instruction]")
      << "this platform has none";
}

TEST_F(PlatformWords, OfAnInstructionFailAsTheRunFindsThem) {
  EXPECT_EQ(run("v = pick {}\ndef f(x) { x }\nmark v, f('here')"),
            "t:3: IllegalArgumentException: mark takes vehicles, an area and how often\n");
  transcript.text.clear();
  EXPECT_EQ(run("p = location(41, -8)\nv = pick { id 'u2' }\nmark v, p ^ 5"),
            "t:3: IllegalArgumentException: mark to u2: the brush is worn: change it\n");
  transcript.text.clear();
  EXPECT_EQ(run("p = location(41, -8)\nv = pick {}\nrelease v\ntry { mark v, p ^ 5 } catch (Exception e) { message "
                "e.message }"),
            "Program message: mark: vehicle a1 is not picked\n");
}

TEST_F(PlatformWords, AreKnownToTheEditor) {
  Vocabulary const words(platform.vocabulary());
  Document const document("t", "v = pick {}\nmark v, ", words);
  auto const help = signature_help(document, 20);
  ASSERT_TRUE(help);
  EXPECT_EQ(help->signatures.at(0).call.text, "mark vehicles, field, times?");
  EXPECT_EQ(help->signatures.at(0).parameter_docs.at(1), "an area or a list, each item a position: what is marked");
  auto const card = hover(document, 13);
  ASSERT_TRUE(card);
  EXPECT_NE(card->markdown.find("Marks an area on the ground."), std::string::npos);
  auto const offered = complete(Document("t", "ma", words), 2).items;
  EXPECT_NE(std::ranges::find(offered, "mark", &CompletionItem::label), offered.end());
  EXPECT_EQ(std::ranges::find(offered, "sendMessage", &CompletionItem::label), offered.end());
  EXPECT_TRUE(words.is_taken("mark"));
}

TEST(MissionWords, HideNoneOfTheLanguages) {
  auto const words = missions::vocabulary();
  for (auto const& one : words.instructions) EXPECT_FALSE(find_instruction(one.name)) << one.name;
  for (auto const& one : words.builders) EXPECT_FALSE(find_instruction(one.name)) << one.name;
}

TEST(SendMessage, IsRefusedByVehiclesWithoutAProtocol) {
  testing::Bench bench;
  EXPECT_EQ(bench.run("v = pick {}\nsendMessage v, 'HEARTBEAT', type: 1"),
            "exit 1 at 0.0: test.dolphin:2: IllegalArgumentException: sendMessage to a1: these vehicles take no raw "
            "messages\n");
}

TEST(SendMessage, SaysWhatItTakes) {
  testing::Bench bench;
  EXPECT_EQ(
      bench.run("v = pick {}\ndef f(x) { x }\nsendMessage v, f(1), type: 1"),
      "exit 1 at 0.0: test.dolphin:3: IllegalArgumentException: sendMessage takes vehicles, the name of a message "
      "and its fields: sendMessage v, 'COMMAND_LONG', command: 400\n");
  testing::Bench other;
  EXPECT_EQ(
      other.run("v = pick {}\nsendMessage v, 'HEARTBEAT', type: [1]"),
      "exit 1 at 0.0: test.dolphin:2: IllegalArgumentException: sendMessage: type takes a number or a text, not a "
      "list\n");
}

}  // namespace
}  // namespace lapwing::dolphin
