#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "dolphin/check/checker.hpp"
#include "dolphin/syntax/parser.hpp"
#include "dolphin/testing/script_bench.hpp"

/// Scripts in the style of those that people have published for the original: all are read, and all but those that
/// spell out IMC plans check without an error.
namespace lapwing::dolphin {
namespace {

std::vector<std::filesystem::path> scripts() {
  std::vector<std::filesystem::path> paths;
  auto const folder = std::filesystem::path(LAPWING_SOURCE_DIR) / "tests" / "conformance" / "corpus";
  for (auto const& entry : std::filesystem::directory_iterator(folder)) paths.push_back(entry.path());
  std::ranges::sort(paths);
  return paths;
}

base::SourceFile read(std::filesystem::path const& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return {path.filename().string(), text.str()};
}

class Corpus : public ::testing::TestWithParam<std::filesystem::path> {};

TEST_P(Corpus, IsReadAndChecked) {
  auto const source = read(GetParam());
  base::Diagnostics diagnostics(source);
  auto const tree = parse(diagnostics);
  EXPECT_FALSE(diagnostics.has_errors()) << base::render(diagnostics);
  testing::Bench bench;
  check(tree, bench.platform.vocabulary(), diagnostics);
  bool const spells_out_imc = GetParam().stem().string().starts_with("imc_");
  EXPECT_EQ(diagnostics.has_errors(), spells_out_imc) << base::render(diagnostics);
  auto const said = base::render(diagnostics).find("IMC plans are not supported");
  EXPECT_EQ(said != std::string::npos, spells_out_imc);
}

INSTANTIATE_TEST_SUITE_P(Scripts, Corpus, ::testing::ValuesIn(scripts()),
                         [](auto const& script) { return script.param.stem().string(); });

TEST(CorpusSize, IsThatOfThePublicOne) {
  EXPECT_GE(scripts().size(), 81U);
}

}  // namespace
}  // namespace lapwing::dolphin
