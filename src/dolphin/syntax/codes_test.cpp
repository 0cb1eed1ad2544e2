// Every kind of mistake has a script that makes it, tests/golden/codes/CODE.dolphin with what is said about it beside
// it, and one that comes near without making it, CODE.good.dolphin. The reference is made of the table and these files.
// To accept new texts: LAPWING_REFRESH_GOLDEN=1 dolphin_test --gtest_filter='*Code*', and read the diff.

#include "dolphin/syntax/codes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>

#include <fmt/format.h>

#include "dolphin/machine/engine.hpp"
#include "missions/vocabulary.hpp"

namespace lapwing::dolphin {
namespace {

namespace fs = std::filesystem;

fs::path const folder = fs::path(LAPWING_SOURCE_DIR) / "tests/golden/codes";
fs::path const reference = fs::path(LAPWING_SOURCE_DIR) / "docs/reference/diagnostics.md";

/// No small script makes these with the blocks of every platform.
constexpr std::array<std::string_view, 3> without_example{"script-too-long", "wrong-encoding", "internal"};

bool has_example(base::DiagnosticKind const& kind) {
  return std::ranges::find(without_example, kind.code) == without_example.end();
}

std::string text_of(fs::path const& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream out;
  out << in.rdbuf();
  return out.str();
}

struct Complaints {
  std::string text;
  std::set<std::string_view> codes;
};

Complaints complaints(fs::path const& script) {
  auto const source = std::make_shared<base::SourceFile const>(script.filename().string(), text_of(script));
  base::Diagnostics diagnostics(*source);
  auto const vocabulary = missions::vocabulary();
  (void)load(source, vocabulary, diagnostics);
  Complaints out{render(diagnostics), {}};
  for (auto const& one : diagnostics.sorted()) out.codes.insert(one.code);
  return out;
}

bool refreshes() {
  auto const* const asked = std::getenv("LAPWING_REFRESH_GOLDEN");
  return asked && std::string_view(asked) == "1";
}

class CodeGolden : public ::testing::TestWithParam<base::DiagnosticKind> {};

TEST_P(CodeGolden, IsSaidOfItsScriptAndNothingElse) {
  auto const script = folder / fmt::format("{}.dolphin", GetParam().code);
  ASSERT_TRUE(fs::exists(script));
  auto const actual = complaints(script);
  EXPECT_EQ(actual.codes, std::set{GetParam().code});
  auto const expected = folder / fmt::format("{}.expected", GetParam().code);
  if (refreshes()) std::ofstream(expected, std::ios::binary) << actual.text;
  EXPECT_EQ(actual.text, text_of(expected));
}

TEST_P(CodeGolden, IsNotSaidOfWhatComesNear) {
  auto const script = folder / fmt::format("{}.good.dolphin", GetParam().code);
  ASSERT_TRUE(fs::exists(script));
  EXPECT_EQ(complaints(script).text, "");
}

std::vector<base::DiagnosticKind> kinds_with_examples() {
  std::vector<base::DiagnosticKind> out;
  std::ranges::copy_if(diagnostic_kinds, std::back_inserter(out), has_example);
  return out;
}

std::string case_name(testing::TestParamInfo<base::DiagnosticKind> const& info) {
  std::string out(info.param.code);
  std::ranges::replace(out, '-', '_');
  return out;
}

INSTANTIATE_TEST_SUITE_P(All, CodeGolden, testing::ValuesIn(kinds_with_examples()), case_name);

// ---- fixes

struct Checked {
  std::vector<base::Diagnostic> all;
  std::string text;
};

Checked checked(std::string const& script) {
  auto const source = std::make_shared<base::SourceFile const>("test.dolphin", script);
  base::Diagnostics diagnostics(*source);
  auto const vocabulary = missions::vocabulary();
  (void)load(source, vocabulary, diagnostics);
  return {diagnostics.sorted(), render(diagnostics)};
}

void expect_fixed(fs::path const& path, std::string const& script, base::Diagnostic const& one, std::size_t before) {
  auto const after = checked(base::applied(script, one.fix));
  auto const is_same = [&](base::Diagnostic const& other) {
    return other.code == one.code && other.message == one.message && other.span.begin == one.span.begin;
  };
  EXPECT_TRUE(std::ranges::none_of(after.all, is_same)) << path << '\n' << after.text;
  EXPECT_LE(after.all.size(), before) << path << '\n' << one.message << '\n' << after.text;
}

TEST(Fixes, EachTakesAwayWhatItIsAboutAndAddsNothing) {
  std::set<std::string_view> mended;
  for (auto const* const place : {"codes", "check"}) {
    for (auto const& entry : fs::directory_iterator(folder.parent_path() / place)) {
      if (entry.path().extension() != ".dolphin") continue;
      auto const script = text_of(entry.path());
      auto const before = checked(script).all;
      for (auto const& one : before) {
        if (one.fix.empty()) continue;
        expect_fixed(entry.path(), script, one, before.size());
        mended.insert(one.code);
      }
    }
  }
  EXPECT_GT(mended.size(), 12u);
}

struct Mended {
  std::string_view script;
  std::string_view fixed;
};

TEST(Fixes, WriteWhatTheHintsSay) {
  for (auto const& [script, fixed] : std::initializer_list<Mended>{
           {"v = pick { type: 'UAV' }", "v = pick { type 'UAV' }"},
           {"v = pick { type:'UAV' }", "v = pick { type 'UAV' }"},
           {"v = pick { type = 'UAV' }", "v = pick { type 'UAV' }"},
           {"v = pick { type 'UVA' }", "v = pick { type 'UAV' }"},
           {"execute { message 'x' }", "execute action { message 'x' }"},
           {"execute waitFor { true } then { message 'x' }", "execute waitFor { true } then action { message 'x' }"},
           {"v = pick { }; execute v: { message 'x' }", "v = pick { }; execute v: action { message 'x' }"},
           {"v = pick { }\nif (battery(v) < 30) { release v }",
            "v = pick { }\nif (battery(v) < 30.percent) { release v }"},
           {"m = mission { home 1, 2; move -5, 0 }\nexecute m", "m = mission { home 1, 2; move (-5), 0 }\nexecute m"},
           {"x = pos { lat 38; lon -8.64 }", "x = pos { lat 38; lon (-8.64) }"},
           {"idle(5)", "execute idle(5)"},
           {"(idle(5) | idle(6)) / { true }", "execute((idle(5) | idle(6)) / { true })"},
           {"execute (idle(5) | idle(6)) / { true }", "execute((idle(5) | idle(6)) / { true })"},
           {"execute waitFor { true } run idle(5)", "execute waitFor { true } then idle(5)"},
           {"execute until { true } then idle(5)", "execute until { true } run idle(5)"},
           {"execute idle(5) during 2.seconds", "execute during 2.seconds run idle(5)"},
           {"execute idle(5).during(2.seconds) >> idle(1)", "execute (during(2.seconds) run idle(5)) >> idle(1)"},
           {"x = .5", "x = 0.5"},
           {"pause 5seconds", "pause 5.seconds"},
           {"message \u201Chello\u201D", "message \"hello\""},
           {"x = 3 \u2212 2", "x = 3 - 2"},
           {"message [1]", "message([1])"},
           {"x = 1\nx 2", "x = 1\nx = 2"},
       }) {
    auto const all = checked(std::string(script)).all;
    auto const found = std::ranges::find_if(all, [](base::Diagnostic const& one) { return !one.fix.empty(); });
    ASSERT_NE(found, all.end()) << script;
    EXPECT_EQ(base::applied(script, found->fix), fixed);
  }
}

TEST(Codes, AreUniqueAndExplained) {
  std::set<std::string_view> seen;
  for (auto const& kind : diagnostic_kinds) {
    EXPECT_TRUE(seen.insert(kind.code).second) << kind.code;
    EXPECT_TRUE(kind.meaning.ends_with('.')) << kind.code;
  }
}

TEST(Codes, HaveNoFilesOfOthers) {
  for (auto const& entry : fs::directory_iterator(folder)) {
    auto const name = entry.path().filename().string();
    auto const stem = name.substr(0, name.find('.'));
    EXPECT_NE(std::ranges::find(diagnostic_kinds, stem, &base::DiagnosticKind::code), diagnostic_kinds.end()) << name;
  }
}

std::string reference_text() {
  std::string out =
      "# Diagnostics\n\n"
      "What `lapwing check`, `lapwing run` and editors say about scripts. Each diagnostic ends with its code, which "
      "`--json` gives\n"
      "as `code`; codes keep their meaning. A script with errors is not run; warnings and notes do not stop it.\n"
      "At most 100 errors, and as many warnings, are shown; the rest is counted.\n\n"
      "This page is made of the checker's own table and its tests (`LAPWING_REFRESH_GOLDEN=1 dolphin_test`).\n";
  for (auto const& kind : diagnostic_kinds) {
    out += fmt::format("\n## {}\n\n*{}*: {}\n", kind.code, base::to_string(kind.severity), kind.meaning);
    if (!has_example(kind)) continue;
    auto const path = folder / fmt::format("{}.dolphin", kind.code);
    auto const script = text_of(path);
    if (script.size() < 500) out += fmt::format("\n```dolphin\n{}```\n", script);
    out += fmt::format("\n```text\n{}```\n", complaints(path).text);
  }
  return out;
}

TEST(CodesReference, IsMadeOfTheTableAndTheExamples) {
  auto const text = reference_text();
  if (refreshes()) std::ofstream(reference, std::ios::binary) << text;
  EXPECT_EQ(text, text_of(reference));
}

}  // namespace
}  // namespace lapwing::dolphin
