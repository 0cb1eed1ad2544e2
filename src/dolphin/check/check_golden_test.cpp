// Golden tests of `lapwing check`: each tests/golden/check/*.dolphin is read and checked, and what is said about it
// compared, character by character, with the .expected file beside it. To accept new texts: LAPWING_REFRESH_GOLDEN=1
// dolphin_test --gtest_filter='*Golden*', and read the diff.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "dolphin/check/checker.hpp"
#include "dolphin/names/instruction_table.hpp"
#include "dolphin/syntax/parser.hpp"
#include "missions/vocabulary.hpp"

namespace lapwing::dolphin {
namespace {

namespace fs = std::filesystem;

fs::path const cases_folder = fs::path(LAPWING_SOURCE_DIR) / "tests/golden/check";
fs::path const examples_folder = fs::path(LAPWING_SOURCE_DIR) / "examples";

std::string text_of(fs::path const& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream out;
  out << in.rdbuf();
  return out.str();
}

std::string complaints(fs::path const& script) {
  base::SourceFile const source(script.filename().string(), text_of(script));
  base::Diagnostics diagnostics(source);
  tasks::Vocabulary const vocabulary = missions::vocabulary();
  auto const program = parse(diagnostics, names_of(vocabulary));
  check(program, vocabulary, diagnostics);
  return render(diagnostics);
}

std::vector<fs::path> scripts() {
  std::vector<fs::path> out;
  for (auto const& entry : fs::directory_iterator(cases_folder)) {
    if (entry.path().extension() == ".dolphin") out.push_back(entry.path());
  }
  std::ranges::sort(out);
  return out;
}

bool refreshes() {
  auto const* const asked = std::getenv("LAPWING_REFRESH_GOLDEN");
  return asked && std::string_view(asked) == "1";
}

class CheckGolden : public ::testing::TestWithParam<fs::path> {};

TEST_P(CheckGolden, SaysExactlyWhatIsExpected) {
  auto expected = GetParam();
  expected.replace_extension(".expected");
  auto const actual = complaints(GetParam());
  if (refreshes()) std::ofstream(expected, std::ios::binary) << actual;
  ASSERT_TRUE(fs::exists(expected)) << "no " << expected;
  EXPECT_EQ(actual, text_of(expected));
}

/// Cases that begin with good_ show what must not be complained about.
TEST(CheckGoldenCases, AreSilentAboutGoodScripts) {
  for (auto const& script : scripts()) {
    if (script.filename().string().starts_with("good_")) {
      EXPECT_EQ(complaints(script), "");
    }
  }
}

TEST(CheckGoldenCases, HaveMoreMistakesThanGoodScripts) {
  auto const all = scripts();
  auto const good =
      std::ranges::count_if(all, [](fs::path const& path) { return path.filename().string().starts_with("good_"); });
  EXPECT_GE(good, 15);
  EXPECT_GE(std::ssize(all) - good, 25);
}

std::string case_name(testing::TestParamInfo<fs::path> const& info) {
  return info.param.stem().string();
}

INSTANTIATE_TEST_SUITE_P(All, CheckGolden, testing::ValuesIn(scripts()), case_name);

TEST(Listings, OneAndTwoCheckClean) {
  EXPECT_EQ(complaints(examples_folder / "listing1.dolphin"), "");
  EXPECT_EQ(complaints(examples_folder / "listing2.dolphin"), "");
}

TEST(Listings, ThreeAndFourNameTheirTwoMisspeltMissionsAndNothingElse) {
  for (auto const* name : {"listing3.dolphin", "listing4.dolphin"}) {
    auto const text = complaints(examples_folder / name);
    EXPECT_NE(text.find("surveyAreaNorth is not defined"), std::string::npos) << text;
    EXPECT_NE(text.find("did you mean surveyNorth?"), std::string::npos) << text;
    EXPECT_NE(text.find("surveyAreaSouth is not defined"), std::string::npos) << text;
    EXPECT_NE(text.find("did you mean surveySouth?"), std::string::npos) << text;
    EXPECT_EQ(std::ranges::count(text, '\n'), 6) << text;
  }
}

}  // namespace
}  // namespace lapwing::dolphin
