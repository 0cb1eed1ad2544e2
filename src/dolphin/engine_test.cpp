#include <gtest/gtest.h>

#include "dolphin/testing.hpp"

namespace lapwing::dolphin {
namespace {

using testing::Bench;
using testing::printed;

TEST(Engine, RunsAScriptToItsEnd) {
  EXPECT_EQ(Bench().run("message 'hello'"), "Program message: hello\nexit 0 at 0.0\n");
}

}  // namespace
}  // namespace lapwing::dolphin
