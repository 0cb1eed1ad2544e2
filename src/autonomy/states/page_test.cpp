#include "autonomy/states/page.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <string>

namespace lapwing::autonomy {
namespace {

std::string const begin_mark = "<!-- made from src/autonomy/states/transitions.cpp -->\n";
std::string const end_mark = "<!-- end -->\n";

TEST(StatesPage, IsWhatTheTableSays) {
  std::string const path = LAPWING_SOURCE_DIR "/docs/reference/operation-states.md";
  std::ifstream file(path);
  std::string page(std::istreambuf_iterator<char>(file), {});
  auto const marked = page.find(begin_mark);
  auto const end = page.find(end_mark);
  ASSERT_TRUE(marked != std::string::npos && end != std::string::npos && marked < end) << path;
  auto const begin = marked + begin_mark.size();
  if (std::getenv("LAPWING_REFRESH_GOLDEN") != nullptr)
    std::ofstream(path) << page.replace(begin, end - begin, states_page());
  EXPECT_EQ(page.substr(begin, page.find(end_mark) - begin), states_page())
      << "LAPWING_REFRESH_GOLDEN=1 before this test writes " << path;
}

}  // namespace
}  // namespace lapwing::autonomy
