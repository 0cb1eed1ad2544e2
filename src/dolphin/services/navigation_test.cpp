#include "dolphin/services/navigation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <string>

#include "base/testing/cpu_time.hpp"
#include "dolphin/services/hover.hpp"
#include "dolphin/services/rename.hpp"
#include "dolphin/services/testing.hpp"

namespace lapwing::dolphin {
namespace {

using testing::Marked;

// ---- hover --------------------------------------------------------------------------------------

std::string hover_text(std::string const& script) {
  Marked const marked(script);
  auto const found = hover(*marked.document, marked.offset);
  return found ? found->markdown : std::string();
}

::testing::AssertionResult says(std::string const& script, std::initializer_list<std::string_view> words) {
  auto const text = hover_text(script);
  for (auto const word : words) {
    if (!text.contains(word)) return ::testing::AssertionFailure() << "no '" << word << "' in " << text;
  }
  return ::testing::AssertionSuccess();
}

TEST(Hover, ShowsSignaturesWithUnitsAndDefaults) {
  EXPECT_TRUE(says("pau|se 3", {"pause time", "`time`: a number in seconds", "Waits"}));
  EXPECT_TRUE(says("x = batt|ery(v)", {"battery vehicle", "Gives a number (0 to 1)", "For example", "90.percent"}));
  EXPECT_TRUE(says("m = mission { take|Off p }", {"takeOff pos, pitch = 15", "degrees", "15 if left out",
                                                  "MAV_CMD_NAV_TAKEOFF (22)", "Inside `mission { ... }`"}));
  EXPECT_TRUE(says("v = pick { time|out 3 }", {"timeout time", "seconds", "Inside `pick { ... }`"}));
  EXPECT_TRUE(says("m = miss|ion { }", {"mission { ... }", "Commands: ", "takeOff"}));
  EXPECT_TRUE(says("x = wait|For { a } then b", {"waitFor { condition } then task"}));
}

TEST(Hover, ShowsUnitsMembersConstantsAndTypes) {
  EXPECT_TRUE(says("x = 10.min|utes", {"n.minutes", "60 seconds"}));
  EXPECT_TRUE(says("x = 10.per|cent", {"0.01 of the whole"}));
  EXPECT_TRUE(says("v = pick { }\nx = v.batt|ery", {".battery", "a set of vehicles"}));
  EXPECT_TRUE(says("x = [1].coll|ect { it }", {".collect(closure)", "a list", "`[1, 2].collect { it * 10 }`"}));
  EXPECT_TRUE(says("x = P|I", {"3.14159"}));
  EXPECT_TRUE(says("try { a() } catch (Task|Error e) { }", {"failed"}));
}

TEST(Hover, ShowsWhatIsKnownOfVariablesAndFunctions) {
  EXPECT_TRUE(says("// Where the copters start.\nbase = location(1, 2)\nmessage ba|se",
                   {"base  // a position", "global variable, defined in line 2", "Where the copters start."}));
  EXPECT_TRUE(says("t = 3.minutes\nmessage t|", {"a number (seconds)"}));
  EXPECT_TRUE(says("def f(a, b = 2) { a }\nx = f|(1)", {"def f(a, b = 2)", "defined in line 1"}));
  EXPECT_TRUE(says("l.each { x -> message x| }", {"parameter"}));
  EXPECT_TRUE(says("l.each { message i|t }", {"The parameter of this closure"}));
  EXPECT_TRUE(says("message \"at $bas|e\"\nbase = 1", {"base  // a whole number"}));
}

TEST(Hover, ShowsPlansAndSignals) {
  EXPECT_TRUE(says("m = mission { name 'North' }\nx = task('No|rth')", {"The mission `North`, defined in line 1"}));
  EXPECT_TRUE(says("x = task('No|rth')", {"made elsewhere"}));
  EXPECT_TRUE(says("post rea|dy: 1", {"The signal `ready`"}));
}

TEST(Hover, SaysNothingElsewhere) {
  for (auto const* script : {"|", "x = |1 + 2", "x = nothing|", "// pau|se", "message 'pau|se'", "x = 1 |+ 2"}) {
    EXPECT_EQ(hover_text(script), "") << script;
  }
}

// ---- definitions and references -----------------------------------------------------------------

/// Lines (from 1) of the definitions.
std::vector<std::uint32_t> defined_in(std::string const& script) {
  Marked const marked(script);
  std::vector<std::uint32_t> out;
  for (auto const span : definition(*marked.document, marked.offset)) {
    out.push_back(marked.document->source().place(span.begin).line);
  }
  return out;
}
using Lines = std::vector<std::uint32_t>;

TEST(Definition, FindsVariablesFunctionsAndPlans) {
  EXPECT_EQ(defined_in("x = 1\nx = 2\nmessage x|"), Lines{1});
  EXPECT_EQ(defined_in("x = 1\ndef f(x) {\n  x|\n}"), Lines{2});
  EXPECT_EQ(defined_in("def f() { 1 }\nx = f|()"), Lines{1});
  EXPECT_EQ(defined_in("v = pick { }\nexecute v|: t"), Lines{1});
  EXPECT_EQ(defined_in("m = mission {\n  name 'A'\n}\nexecute task('A|')"), Lines{2});
  EXPECT_EQ(defined_in("m = mission {\n  name 'A'\n}\nexecute imcPlan['A|']"), Lines{2});
  EXPECT_EQ(defined_in("try { a() }\ncatch (e) {\n  message e|\n}"), Lines{2});
  EXPECT_EQ(defined_in("pau|se 1"), Lines{});
}

TEST(References, KeepVariablesOfOneNameApart) {
  Marked const marked("x = 1\nl.each { x -> message x }\ndef f(x) { x }\nmessage \"$x ${x + 1}\"\nexecute x|: t\n");
  EXPECT_EQ(references(*marked.document, marked.offset).size(), 4u);
}

TEST(Symbols, ListFunctionsAndGlobals) {
  Marked const marked("m = mission { name 'M' }\nv = pick { }\ndef f(a) { g = 1 }\nt = m >> m\ndef l = 2\n");
  auto const all = symbols(*marked.document);
  ASSERT_EQ(all.size(), 5u);
  EXPECT_EQ(all[0].kind, SymbolKind::mission);
  EXPECT_EQ(all[1].kind, SymbolKind::vehicles);
  EXPECT_EQ(all[2].detail, "f(a)");
  EXPECT_EQ(all[3].name, "g");
  EXPECT_EQ(all[4].kind, SymbolKind::task);
  for (auto const& one : all) {
    EXPECT_TRUE(one.span.begin <= one.name_span.begin && one.name_span.end <= one.span.end) << one.name;
  }
}

// ---- rename -------------------------------------------------------------------------------------

/// The renamed script, or why not.
std::string renamed(std::string const& script, std::string const& name) {
  Marked const marked(script);
  auto const places = rename(*marked.document, marked.offset, name);
  if (!places) return places.error().message;
  std::string text(marked.document->source().text());
  for (auto at = places->rbegin(); at != places->rend(); ++at) text.replace(at->begin, at->size(), name);
  return text;
}

TEST(Rename, ChangesEveryPlaceAndNoOther) {
  EXPECT_EQ(renamed("v = pick { }\nexecute v|: t('v')\nmessage \"v $v ${v.id}\"\nmessage w.v", "scout"),
            "scout = pick { }\nexecute scout: t('v')\nmessage \"v $scout ${scout.id}\"\nmessage w.v");
  EXPECT_EQ(renamed("x| = 1\ndef f(x) { x }\n{ x -> x }\nmessage x", "y"),
            "y = 1\ndef f(x) { x }\n{ x -> x }\nmessage y");
  EXPECT_EQ(renamed("x = 1\ndef f(x|) { x + x }", "y"), "x = 1\ndef f(y) { y + y }");
  EXPECT_EQ(renamed("def f|(a) { f(a) }\nx = f(1)", "g"), "def g(a) { g(a) }\nx = g(1)");
  EXPECT_EQ(renamed("m = mission { name 'A' }\nexecute task('A|')", "North half"),
            "m = mission { name 'North half' }\nexecute task('North half')");
  EXPECT_EQ(renamed("post ready|: 1\nx = poll('ready')", "done"), "post done: 1\nx = poll('done')");
}

TEST(Rename, RefusesWhatTheLanguageOwns) {
  EXPECT_EQ(renamed("v = pi|ck { }", "x"), "'pick' is part of the language");
  EXPECT_EQ(renamed("m = mission { take|Off p }", "x"), "'takeOff' is part of the language");
  EXPECT_EQ(renamed("l.each { message i|t }", "x"), "the parameter 'it' has no other name");
  EXPECT_EQ(renamed("x = task('A|')", "B"), "the plan 'A' is not of this script");
  EXPECT_EQ(renamed("x = 1 | + 2", "y"), "there is no name here");
}

TEST(Rename, RefusesNamesThatAreNone) {
  for (auto const* name : {"", "1a", "a b", "a-b", "a.b"}) {
    EXPECT_NE(renamed("x| = 1", name).find("is not a name"), std::string::npos) << name;
  }
  EXPECT_EQ(renamed("x| = 1", "while"), "'while' is a reserved word");
  EXPECT_EQ(renamed("x| = 1", "pick"), "'pick' is part of the language");
  EXPECT_EQ(renamed("x| = 1", "then"), "'then' is part of the language");
  EXPECT_NE(renamed("m = mission { name 'A|' }", "it's").find("no quotes"), std::string::npos);
}

TEST(Rename, RefusesNamesThatWouldMeanSomethingElse) {
  auto const* taken = "already means something in this script";
  EXPECT_NE(renamed("x| = 1\ny = 2", "y").find(taken), std::string::npos);
  EXPECT_NE(renamed("x| = 1\nl.each { y -> message x }", "y").find(taken), std::string::npos) << "it would be captured";
  EXPECT_NE(renamed("y = 1\nl.each { x| -> message x + y }", "y").find(taken), std::string::npos) << "it would capture";
  EXPECT_NE(renamed("x| = 1\nmessage y", "y").find(taken), std::string::npos)
      << "an undefined name would become defined";
  EXPECT_NE(renamed("def f|() { 1 }\ndef g() { 2 }", "g").find(taken), std::string::npos);
  EXPECT_EQ(renamed("x| = 1\nl.each { y -> message y }", "y"), "y = 1\nl.each { y -> message y }") << "apart";
}

// ---- speed --------------------------------------------------------------------------------------

/// A script of 2,000 lines is answered about at once, also in a slow build on a busy machine.
TEST(Services, AreQuickOnLongScripts) {
  std::string script = "v = pick { type 'UAV' }\n";
  for (int i = 0; i < 400; ++i) {
    script += "m" + std::to_string(i) + " = mission {\n  name 'A'\n  move 1, 2, 3\n}\n";
    script += "execute v: m" + std::to_string(i) + " / { battery(v) < 30.percent }\n";
  }
  Marked const marked(script + "message v.|");
  auto const begin = base::cpu_time();
  EXPECT_TRUE(hover(*marked.document, 0));
  EXPECT_FALSE(references(*marked.document, 0).empty());
  EXPECT_LT(base::cpu_time() - begin, std::chrono::milliseconds(500));
}

}  // namespace
}  // namespace lapwing::dolphin
