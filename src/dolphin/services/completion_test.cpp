#include "dolphin/services/completion.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <set>
#include <string>

#include "dolphin/services/semantic_tokens.hpp"
#include "dolphin/services/signature_help.hpp"
#include "dolphin/services/testing.hpp"

namespace lapwing::dolphin {
namespace {

using testing::Marked;

std::vector<CompletionItem> items(std::string const& script) {
  Marked const marked(script);
  return complete(*marked.document, marked.offset).items;
}

bool offers(std::vector<CompletionItem> const& all, std::string_view label) {
  return std::ranges::find(all, label, &CompletionItem::label) != all.end();
}

/// The labels that come first.
std::set<std::string> best(std::string const& script) {
  auto const all = items(script);
  if (all.empty()) return {};
  auto const first = std::ranges::min(all, {}, &CompletionItem::rank).rank;
  std::set<std::string> out;
  for (auto const& one : all) {
    if (one.rank == first) out.insert(one.label);
  }
  return out;
}

using Labels = std::set<std::string>;

TEST(Complete, OffersTheFieldsOfABlock) {
  Labels const fields{"count", "id", "payload", "region", "timeout", "type"};
  for (auto const* script : {"v = pick { |", "v = pick { | }", "v = pick {\n  count 2\n  |\n}\n",
                             "v = pick { count 2; ty| }", "v = pick({ | })"}) {
    auto const found = best(script);
    EXPECT_TRUE(std::ranges::includes(found, fields)) << script;
  }
  EXPECT_TRUE(best("m = mission {\n  take|\n}\n").contains("takeOff"));
  EXPECT_FALSE(offers(items("v = pick { | }"), "takeOff"));
  EXPECT_FALSE(offers(items("v = pick { count | }"), "payload")) << "an argument is no field";
  EXPECT_TRUE(best("t = allOf { | }").contains("when"));
  EXPECT_FALSE(offers(items("|"), "when"));
  EXPECT_TRUE(best("x = watch t onError { | }").contains("ignore"));
}

TEST(Complete, BringsTheArgumentsThatMustBeSaidAsPlacesToFillIn) {
  auto const snippet = [](std::string const& script, std::string_view label) {
    auto const all = items(script);
    auto const found = std::ranges::find(all, label, &CompletionItem::label);
    return found == all.end() ? "not offered" : found->snippet;
  };
  EXPECT_EQ(snippet("m = mission {\n  |\n}", "move"), "move ${1:north}, ${2:east}");
  EXPECT_EQ(snippet("m = mission {\n  |\n}", "takeOff"), "takeOff ${1:pos}");
  EXPECT_EQ(snippet("m = mission {\n  |\n}", "returnHomeAndLand"), "returnHomeAndLand()");
  EXPECT_EQ(snippet("x = |", "battery"), "battery(${1:vehicle})") << "parentheses within an expression";
  EXPECT_EQ(snippet("|", "message"), "message ${1:value}");
  EXPECT_EQ(snippet("def f(a, b = 2) { a }\nx = |", "f"), "f(${1:a})");
  EXPECT_EQ(snippet("m = mission {\n  | location(1, 2)\n}", "takeOff"), "") << "its argument is there";
  EXPECT_EQ(snippet("x = |(v)", "battery"), "");
}

TEST(Complete, OffersErrorsBehindCatch) {
  for (auto const* script : {"try { } catch (|", "try { } catch (Tas|) { }", "try { }\ncatch ( | e) { }"}) {
    auto const all = items(script);
    EXPECT_TRUE(offers(all, "TaskError")) << script;
    EXPECT_TRUE(offers(all, "VehicleError")) << script;
    EXPECT_FALSE(offers(all, "Math")) << script;
    EXPECT_FALSE(offers(all, "if")) << script;
  }
  EXPECT_FALSE(best("try { } catch (TaskError |").contains("VehicleError")) << "the name of the error comes here";
}

TEST(Complete, OffersVariablesInAHalfWrittenText) {
  EXPECT_TRUE(best("scout = pick { }\nmessage \"flying $|").contains("scout"));
  EXPECT_TRUE(best("scout = pick { }\nmessage \"flying $sc|\"").contains("scout"));
  EXPECT_TRUE(best("scout = pick { }\nmessage \"$scout and $|").contains("scout"));
  EXPECT_TRUE(best("scout = pick { }\nmessage 'flying $|'").empty()) << "single quotes take nothing in";
  EXPECT_TRUE(best("scout = pick { }\nmessage \"flying sc|\"").empty());
}

TEST(Complete, DocumentsWhatItOffers) {
  auto const all = items("m = mission { | }");
  auto const found = std::ranges::find(all, "takeOff", &CompletionItem::label);
  ASSERT_NE(found, all.end());
  EXPECT_NE(found->markdown.find("degrees"), std::string::npos) << found->markdown;
}

TEST(Complete, OffersUnitsBehindNumbers) {
  auto const units = Labels{"km", "minutes", "percent", "seconds"};
  for (auto const* script : {"timeout = 10.|", "x = 10.|\ny = 2", "pause 10.mi|", "x = (1 + 2).|", "n = 3\nx = n.|"}) {
    EXPECT_TRUE(std::ranges::includes(best(script), units)) << script;
  }
  EXPECT_TRUE(items("x = 10|").empty());
}

TEST(Complete, OffersMembersByWhatTheValueIs) {
  EXPECT_TRUE(offers(items("v = pick { }\nmessage v.|"), "battery"));
  EXPECT_FALSE(offers(items("v = pick { }\nmessage v.|"), "km"));
  EXPECT_TRUE(offers(items("p = location(1, 2)\nmessage p.|\nx = 1"), "distanceTo"));
  EXPECT_TRUE(offers(items("x = [1, 2].|"), "collect"));
  EXPECT_TRUE(offers(items("x = 'a'.|"), "toUpperCase"));
  EXPECT_FALSE(offers(items("x = 'a'.|"), "distanceTo"));
}

TEST(Complete, OffersVariablesThatCanBeSeen) {
  std::string const script =
      "g = 1\n"
      "def f(p) {\n"
      "  def inner = 2\n"
      "  |\n"
      "}\n"
      "def other = 3\n"
      "l.each { x -> message x }\n";
  auto const all = items(script);
  EXPECT_TRUE(offers(all, "g"));
  EXPECT_TRUE(offers(all, "p"));
  EXPECT_TRUE(offers(all, "inner"));
  EXPECT_TRUE(offers(all, "f"));
  EXPECT_FALSE(offers(all, "other")) << "a function sees no locals from outside";
  EXPECT_FALSE(offers(all, "x"));
  EXPECT_FALSE(offers(all, "it"));
  EXPECT_TRUE(offers(items("l.each { | }"), "it"));
  EXPECT_TRUE(offers(items("l.each { x -> | }"), "x"));
}

TEST(Complete, PutsVehiclesFirstBehindExecuteAndSignalsBehindConsume) {
  EXPECT_EQ(best("v1 = pick { }\nx = 1\nexecute |"), Labels{"v1"});
  EXPECT_EQ(best("v1 = pick { }\nv2 = pick { }\nexecute v1: task('a'),\n  |"), (Labels{"v1", "v2"}));
  EXPECT_EQ(best("post ready: 1, done: 2\nt = waitFor { consume | } then u"), (Labels{"done", "ready"}));
}

TEST(Complete, OffersChoicesWithinQuotes) {
  EXPECT_EQ(best("v = pick { type '|' }"), (Labels{"UAV", "UGV", "USV", "UUV"}));
  EXPECT_EQ(best("m = mission { surveyArea 1, 2, 3, '|' }").size(), 4u);
  EXPECT_EQ(best("m = mission { name 'North' }\nx = task('|')"), Labels{"North"});
  EXPECT_EQ(best("m = mission { name 'North' }\nx = task 'No|"), Labels{"North"});
  EXPECT_TRUE(items("message 'a|'").empty());
  EXPECT_TRUE(items("// a|\n").empty());
}

TEST(Complete, ReplacesTheWholeWord) {
  Marked const marked("x = wait|For");
  EXPECT_EQ(complete(*marked.document, marked.offset).replaced, (base::Span{4, 11}));
}

/// Wherever one is in a script, whole or cut off, asking is safe.
TEST(Services, AnswerEverywhere) {
  std::string const script =
      "#!x\nv = pick { type 'UAV'; count 2 }\n/* c */ m = mission { name \"M ${v.id} $v\"; move (-5), 0 } // d\n"
      "def f(a, b = 2) { a ? b : [k: 1] }\nexecute v: (m / { battery(v) < 30.percent }) >> f(1, 2)\n";
  for (std::size_t cut = 0; cut <= script.size(); ++cut) {
    Marked const marked(script.substr(0, cut));
    (void)semantic_tokens(*marked.document);
    (void)complete(*marked.document, marked.offset);
    (void)signature_help(*marked.document, marked.offset);
    (void)complete(*marked.document, marked.offset / 2);
  }
}

// ---- signature help -----------------------------------------------------------------------------

/// "location lat, lon, height? @ 1": the active signature and parameter, or nothing.
std::string help(std::string const& script) {
  Marked const marked(script);
  auto const found = signature_help(*marked.document, marked.offset);
  if (!found) return {};
  return found->signatures[found->active_signature].call.text + " @ " + std::to_string(found->active_parameter);
}

TEST(SignatureHelp, KnowsTheArgumentThatIsBeingWritten) {
  EXPECT_EQ(help("x = location(1, |"), "location lat, lon, height? @ 1");
  EXPECT_EQ(help("x = location(1, f(2, 3), |)"), "location lat, lon, height? @ 2");
  EXPECT_EQ(help("pause |"), "pause time @ 0");
  EXPECT_EQ(help("v = pick { region a, | }"), "region centre, radius @ 1");
  EXPECT_EQ(help("def f(a, b = 2) { a }\nx = f(1, |)"), "f(a, b = 2) @ 1");
  EXPECT_EQ(help("x = 1 + |"), "");
  EXPECT_EQ(help("// pause |"), "");
  EXPECT_EQ(help("|"), "");
}

}  // namespace
}  // namespace lapwing::dolphin
