#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "dolphin/services/testing.hpp"
#include "dolphin/services/view/folding.hpp"
#include "dolphin/services/view/inlay_hints.hpp"
#include "dolphin/services/view/selection.hpp"

namespace lapwing::dolphin {
namespace {

using testing::Marked;

// ---- folding ------------------------------------------------------------------------------------

/// "0-2", "4-5 comment".
std::vector<std::string> folds_of(std::string const& script) {
  Marked const marked(script);
  std::vector<std::string> out;
  for (auto const& one : folds(*marked.document)) {
    auto const* const kind = one.kind == FoldKind::comment ? " comment" : one.kind == FoldKind::region ? " region" : "";
    out.push_back(fmt::format("{}-{}{}", one.first, one.last, kind));
  }
  return out;
}

using Texts = std::vector<std::string>;

TEST(Folds, HideWhatStandsInBracketsButTheirLastLine) {
  EXPECT_EQ(folds_of("m = mission {\n  home p\n  if (a) {\n    b()\n  }\n}\n"), (Texts{"0-4", "2-3"}));
  EXPECT_EQ(folds_of("x = [\n  1,\n  2\n]\nf(a,\n  b)\n"), (Texts{"0-2"})) << "f(a, ... b) has nothing to hide";
  EXPECT_EQ(folds_of("v = pick { count 1 }\n"), Texts());
  EXPECT_EQ(folds_of("f({\n  g([\n    1\n  ])\n})\n"), (Texts{"0-3", "1-2"})) << "one a line, the outermost";
  EXPECT_EQ(folds_of("x = {\n  1\n"), Texts()) << "a bracket that is never closed";
}

TEST(Folds, HideCommentsTextsAndRegions) {
  EXPECT_EQ(folds_of("/* a\n b\n c */\nx = 1\n"), (Texts{"0-2 comment"}));
  EXPECT_EQ(folds_of("// a\n// b\nx = 1 // c\n// d\n"), (Texts{"0-1 comment"}));
  EXPECT_EQ(folds_of("x = '''a\nb\nc'''\n"), (Texts{"0-2"}));
  EXPECT_EQ(folds_of("// region Pads\np = 1\n// #region inner\nq = 2\n// endregion\n// #endregion\n"),
            (Texts{"0-5 region", "2-4 region"}));
  EXPECT_EQ(folds_of("// endregion\n// region\n"), Texts());
  EXPECT_EQ(folds_of(""), Texts());
}

// ---- selection ----------------------------------------------------------------------------------

Texts selected(std::string const& script) {
  Marked const marked(script);
  return marked.texts(selections(*marked.document, marked.offset));
}

TEST(Selections, GrowFromTheWordToTheWholeText) {
  EXPECT_EQ(selected("x = 1\nexecute v: (lo|ok / { a }) >> home\n"),
            (Texts{"look", "look / { a }", "(look / { a })", "(look / { a }) >> home",
                   "execute v: (look / { a }) >> home", "x = 1\nexecute v: (look / { a }) >> home\n"}));
  auto const inside = selected("m = mission {\n  mo|ve 1, 2\n}\n");
  EXPECT_EQ(inside.front(), "move");
  EXPECT_NE(std::ranges::find(inside, "\n  move 1, 2\n"), inside.end()) << "without the brackets";
  EXPECT_NE(std::ranges::find(inside, "{\n  move 1, 2\n}"), inside.end()) << "and with them";
}

TEST(Selections, GrowAlwaysAndEndWithTheText) {
  std::string const script =
      "v = pick { type 'UAV' }\nm = mission { home 1, 2, 3; move (-1), 2 }\nexecute v: m >> { x }\n( [ {\n";
  for (std::uint32_t offset = 0; offset <= script.size(); ++offset) {
    Marked const marked(script);
    auto const all = selections(*marked.document, offset);
    ASSERT_FALSE(all.empty());
    EXPECT_EQ(all.back(), (base::Span{0, static_cast<std::uint32_t>(script.size())}));
    for (std::size_t i = 1; i < all.size(); ++i) {
      EXPECT_LE(all[i].begin, all[i - 1].begin) << offset;
      EXPECT_GE(all[i].end, all[i - 1].end) << offset;
      EXPECT_GT(all[i].size(), all[i - 1].size()) << offset;
    }
  }
}

// ---- inlay hints --------------------------------------------------------------------------------

/// The script with its hints in angle brackets.
std::string hinted(std::string const& script) {
  Marked const marked(script);
  auto const whole = base::Span{0, static_cast<std::uint32_t>(script.size())};
  auto const all = inlay_hints(*marked.document, whole);
  auto out = script;
  for (auto one = all.rbegin(); one != all.rend(); ++one) out.insert(one->offset, "<" + one->text + ">");
  return out;
}

TEST(InlayHints, NameParametersAndUnitsOfPlainNumbers) {
  EXPECT_EQ(hinted("mission { surveyArea 200, 100, 20, 'NORTH_WEST' }"),
            "mission { surveyArea <len:>200< m>, <width:>100< m>, <spacing:>20< m>, 'NORTH_WEST' }");
  EXPECT_EQ(hinted("mission { move (-80), 5 }"), "mission { move <north:>(-80)< m>, <east:>5< m> }");
  EXPECT_EQ(hinted("pause 5"), "pause 5< s>") << "one parameter needs no name";
  EXPECT_EQ(hinted("pause 5.seconds; x = 3; pause x"), "pause 5.seconds; x = 3; pause x") << "what says its unit";
  EXPECT_EQ(hinted("def pause(t) { t }\npause(5)"), "def pause(t) { t }\npause(5)") << "a function of the script";
}

TEST(InlayHints, TellHeightsAboveAHomeThatIsKnown) {
  auto const text = hinted(
      "b = location(41.1, -8.5, 90)\np = location(41.2, -8.5, 120)\nm = mission {\n  home b\n"
      "  takeOff p\n  takeOff b\n  takeOff location(41.1, -8.5)\n}\n");
  EXPECT_NE(text.find("home b\n  takeOff p< 30 m above home>\n  takeOff b< 0 m above home>\n"), std::string::npos)
      << text;
  EXPECT_NE(text.find("< 90 m below home>\n}"), std::string::npos) << text;
  EXPECT_EQ(hinted("p = location(41, -8, 120)\nm = mission { takeOff p }\n").find("home>"), std::string::npos);
  EXPECT_NE(
      hinted("p = location(41, -8, 120)\nm = mission { home 41, -8, 100; takeOff p }\n").find("p< 20 m above home>"),
      std::string::npos);
}

TEST(InlayHints, StayInThePartThatIsShown) {
  Marked const marked("pause 5\npause 6\npause 7\n");
  auto const all = inlay_hints(*marked.document, {8, 15});
  ASSERT_EQ(all.size(), 1u);
  EXPECT_EQ(all[0].offset, 15u);
}

}  // namespace
}  // namespace lapwing::dolphin
