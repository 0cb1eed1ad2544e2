#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "dolphin/testing/script_bench.hpp"

/// Every script of tests/conformance does what the file beside it says, word for word: what it prints, the events of
/// its tasks, its exit code and when it ended. With LAPWING_REFRESH_GOLDEN set the expectations are written anew, to be
/// read before they are kept.
namespace lapwing::dolphin {
namespace {

std::filesystem::path const folder = std::filesystem::path(LAPWING_SOURCE_DIR) / "tests" / "conformance";

std::string content(std::filesystem::path const& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

std::vector<std::string> script_names() {
  std::vector<std::string> names;
  for (auto const& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() == ".dolphin") names.push_back(entry.path().stem().string());
  }
  std::ranges::sort(names);
  return names;
}

class Conformance : public ::testing::TestWithParam<std::string> {};

TEST_P(Conformance, DoesWhatIsWritten) {
  auto const script = folder / (GetParam() + ".dolphin");
  auto const expected = folder / (GetParam() + ".expected");
  testing::Bench bench;
  auto const actual = bench.run(content(script), script.filename().string());
  if (std::getenv("LAPWING_REFRESH_GOLDEN")) std::ofstream(expected, std::ios::binary) << actual;
  EXPECT_EQ(actual, content(expected));
}

INSTANTIATE_TEST_SUITE_P(Scripts, Conformance, ::testing::ValuesIn(script_names()),
                         [](auto const& script) { return script.param; });

}  // namespace
}  // namespace lapwing::dolphin
