#include <gtest/gtest.h>

#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "base/async/pool.hpp"
#include "base/async/scope.hpp"

namespace lapwing::base {
namespace {

constexpr int coroutines = 20;
constexpr int jobs_each = 50;

/// Takes from nothing to some tenths of a millisecond.
std::uint64_t grind(std::uint64_t seed, unsigned rounds) {
  for (unsigned i = 0; i < rounds; ++i) {
    seed ^= seed << 13U;
    seed ^= seed >> 7U;
    seed ^= seed << 17U;
  }
  return seed;
}

/// A program whose every line depends on when results come: coroutines that compute, sleep, and cancel each other.
class Program {
 public:
  explicit Program(unsigned threads) : loop_(Loop::Pace{.unpaced = true}, threads) {}

  std::string run() {
    for (int name = 0; name < coroutines; ++name) scope_.spawn(compute(name));
    loop_.run_until_done(scope_.join());
    return fmt::format("{}{} of {} jobs gave results in {} s", trace_, given_, submitted_, to_seconds(since_start()));
  }
  [[nodiscard]] int submitted() const { return submitted_; }
  [[nodiscard]] int cancelled() const { return submitted_ - given_; }

 private:
  [[nodiscard]] Duration since_start() const { return loop_.now().time_since_epoch(); }

  Task<> compute(int name) {
    std::mt19937 random(static_cast<unsigned>(name));
    Scope beside(loop_);
    for (int job = 0; job < jobs_each; ++job) {
      auto const seed = random();
      auto const rounds = static_cast<unsigned>(random() % 100'000);
      if (random() % 4 == 0) {
        beside.spawn(ask(fmt::format("{}.{} beside", name, job), seed, rounds));
      } else {
        auto asking = ask(fmt::format("{}.{}", name, job), seed, rounds);
        co_await asking;
      }
      if (random() % 8 == 0) beside.clear();
      if (random() % 2 == 0) co_await loop_.sleep(std::chrono::milliseconds(random() % 5));
    }
    co_await beside.join();
  }
  Task<> ask(std::string name, std::uint64_t seed, unsigned rounds) {
    ++submitted_;
    auto const found = co_await loop_.on_pool(grind, seed, rounds);
    ++given_;
    trace_ += fmt::format("{:.3f} {} {:x}\n", to_seconds(since_start()), name, found);
  }

  Loop loop_;
  std::string trace_;
  int submitted_ = 0;
  int given_ = 0;
  Scope scope_{loop_};
};

TEST(PoolOrder, AThousandJobsOfRandomLengthGiveTheSameTraceOnAnyNumberOfThreads) {
  Program program(1);
  auto const trace = program.run();
  EXPECT_EQ(program.submitted(), coroutines * jobs_each);
  EXPECT_GT(program.cancelled(), 20);
  for (unsigned const threads : {1U, 2U, 8U, 8U}) EXPECT_EQ(Program(threads).run(), trace) << threads << " threads";
}

}  // namespace
}  // namespace lapwing::base
