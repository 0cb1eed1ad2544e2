#include "base/async/parallel_for.hpp"

#include <vector>

#include <gtest/gtest.h>

namespace lapwing::base {
namespace {

TEST(ParallelFor, DoesEachOnceOnAnyNumberOfThreads) {
  for (unsigned const threads : {1U, 2U, 8U}) {
    for (std::size_t const count : {0U, 1U, 3U, 1000U}) {
      std::vector<int> done(count, 0);
      parallel_for(threads, count, [&](std::size_t index) { ++done[index]; });
      EXPECT_EQ(done, std::vector<int>(count, 1)) << threads << " threads";
    }
  }
}

TEST(ParallelForDeathTest, WantsAThread) {
  EXPECT_DEATH(parallel_for(0, 1, [](std::size_t) {}), "threads > 0");
}

}  // namespace
}  // namespace lapwing::base
