#include "base/text/diagnostic.hpp"

#include <gtest/gtest.h>

#include "base/text/source.hpp"

namespace lapwing::base {
namespace {

constexpr DiagnosticKind mistake{"mistake", Severity::error, "Something is wrong."};
constexpr DiagnosticKind oddity{"oddity", Severity::warning, "Something is odd."};

TEST(SourceFile, FindsLinesWithAnyLineEnd) {
  SourceFile const source("f", "one\ntwo\r\nthree\rfour");
  EXPECT_EQ(source.line_count(), 4U);
  EXPECT_EQ(source.text(source.line_span(1)), "one");
  EXPECT_EQ(source.text(source.line_span(2)), "two");
  EXPECT_EQ(source.text(source.line_span(3)), "three");
  EXPECT_EQ(source.text(source.line_span(4)), "four");
  EXPECT_EQ(source.text(source.line_span(5)), "");
  EXPECT_EQ(source.place(4), (LineColumn{2, 1}));
  EXPECT_EQ(source.place(15), (LineColumn{4, 1}));
  EXPECT_EQ(source.place(1000), (LineColumn{4, 5}));
  EXPECT_EQ(source.line(0), 1U);
  EXPECT_EQ(source.line(4), 2U);
  EXPECT_EQ(source.line(1000), 4U);
}

TEST(SourceFile, CountsCharactersNotBytes) {
  SourceFile const source("f", "aäb");
  EXPECT_EQ(source.place(3), (LineColumn{1, 3}));
}

TEST(SourceFile, OfNothingHasOneEmptyLine) {
  SourceFile const source("f", "");
  EXPECT_EQ(source.line_count(), 1U);
  EXPECT_EQ(source.place(0), (LineColumn{1, 1}));
}

TEST(Diagnostic, UnderlinesTheWholeSpanWithItsHint) {
  SourceFile const source("s.dolphin", "x = 1\nexecute surveyAreaNorth\n");
  EXPECT_EQ(
      render(Diagnostic{Severity::error, {}, {14, 29}, "surveyAreaNorth is not defined", "did you mean surveyNorth?"},
             source),
      "s.dolphin:2:9: error: surveyAreaNorth is not defined\n"
      "    2 | execute surveyAreaNorth\n"
      "      |         ^~~~~~~~~~~~~~~ did you mean surveyNorth?\n");
}

TEST(Diagnostic, WidensTabsAndCountsWideCharactersOnce) {
  SourceFile const source("f", "\tä\tx");
  EXPECT_EQ(render(Diagnostic{Severity::warning, {}, {4, 5}, "m"}, source),
            "f:1:4: warning: m\n"
            "    1 |     ä   x\n"
            "      |         ^\n");
}

TEST(Diagnostic, EndsTheUnderlineWithTheFirstLine) {
  SourceFile const source("f", "ab\ncd");
  EXPECT_EQ(render(Diagnostic{Severity::error, {}, {1, 5}, "m"}, source), "f:1:2: error: m\n    1 | ab\n      |  ^\n");
}

TEST(Diagnostic, PointsBehindTheEndOfTheText) {
  SourceFile const source("f", "ab");
  EXPECT_EQ(render(Diagnostic{Severity::error, {}, {2, 2}, "m"}, source), "f:1:3: error: m\n    1 | ab\n      |   ^\n");
}

TEST(Diagnostic, ShowsItsCodeBehindTheMessage) {
  SourceFile const source("f", "ab");
  EXPECT_EQ(render(Diagnostic{Severity::error, "mistake", {0, 1}, "m"}, source),
            "f:1:1: error: m [mistake]\n    1 | ab\n      | ^\n");
}

TEST(Diagnostic, ShowsThePartOfALongLineRoundTheMistake) {
  SourceFile const source("f", std::string(5000, 'a') + "X" + std::string(5000, 'b'));
  auto const text = render(Diagnostic{Severity::error, {}, {5000, 5001}, "m"}, source);
  EXPECT_LT(text.size(), 500U);
  EXPECT_NE(text.find("aaaX"), std::string::npos);
}

TEST(Diagnostic, MakesControlCharactersVisible) {
  SourceFile const source("f", "a\x01z");
  EXPECT_EQ(render(Diagnostic{Severity::error, {}, {1, 2}, "m"}, source), "f:1:2: error: m\n    1 | a?z\n      |  ^\n");
}

TEST(Diagnostics, KeepTheOrderOfThePlacesAndCountWhatTheyDrop) {
  SourceFile const source("f", "abc");
  Diagnostics diagnostics(source, 2);
  diagnostics.report(mistake, {2, 3}, "late");
  diagnostics.report(mistake, {0, 1}, "early");
  diagnostics.report(mistake, {1, 2}, "dropped");
  diagnostics.report(oddity, {1, 2}, "kept");
  EXPECT_EQ(diagnostics.error_count(), 3U);
  EXPECT_EQ(diagnostics.warning_count(), 1U);
  EXPECT_EQ(diagnostics.dropped_count(), 1U);
  ASSERT_EQ(diagnostics.sorted().size(), 3U);
  EXPECT_EQ(diagnostics.sorted().front().message, "early");
  EXPECT_TRUE(render(diagnostics).ends_with("... and 1 more\n"));
}

TEST(Diagnostics, KeepTheFixOfAHintAndShowItsWordsOnly) {
  SourceFile const source("f", "takeof p");
  constexpr std::string_view words[] = {"takeOff", "land"};
  Diagnostics diagnostics(source);
  diagnostics.report(mistake, {0, 6}, "m", did_you_mean({0, 6}, "takeof", words));
  diagnostics.report(oddity, {7, 8}, "n", Hint{"write f(p)", {{{7, 7}, "f("}, {{8, 8}, ")"}}});
  diagnostics.report(oddity, {7, 8}, "o", "words alone");
  auto const all = diagnostics.sorted();
  EXPECT_EQ(all[0].hint, "did you mean takeOff?");
  EXPECT_EQ(applied(source.text(), all[0].fix), "takeOff p");
  EXPECT_EQ(applied(source.text(), all[1].fix), "takeof f(p)");
  EXPECT_EQ(applied(source.text(), all[1].fix, all[1].span), "f(p)");
  EXPECT_TRUE(all[2].fix.empty());
  EXPECT_EQ(render(all[0], source).find("fix"), std::string::npos);
  EXPECT_TRUE(did_you_mean({0, 6}, "zzzzzz", words).empty());
}

TEST(Diagnostics, BecomeRecordsWithPlaces) {
  SourceFile const source("f", "a\nbc");
  Diagnostics diagnostics(source);
  diagnostics.report(mistake, {2, 4}, "m", "h", {{{0, 1}, "n"}});
  auto const records = to_records(diagnostics);
  ASSERT_EQ(records.size(), 1U);
  EXPECT_EQ(records[0].file, "f");
  EXPECT_EQ(records[0].begin, (LineColumn{2, 1}));
  EXPECT_EQ(records[0].end, (LineColumn{2, 3}));
  EXPECT_EQ(records[0].severity, "error");
  EXPECT_EQ(records[0].hint, "h");
  EXPECT_EQ(records[0].code, "mistake");
  ASSERT_EQ(records[0].notes.size(), 1U);
  EXPECT_EQ(records[0].notes[0].severity, "note");
}

}  // namespace
}  // namespace lapwing::base
