// A robot in a simulated building whose board speaks over TCP, for kill.py beside it: says on standard output when its
// wheels were commanded to zero and when they turn again, by the clock that all programs of a machine share.
// usage: bench_kill_board BUILDING.toml PORT
#include <chrono>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <string>

#include <fmt/format.h>

#include "base/async/loop.hpp"
#include "sim/building/building_run.hpp"
#include "sim/building/plan/building_file.hpp"

namespace {

using namespace lapwing;
using namespace std::chrono_literals;
namespace building = sim::building;

/// Looked at so often: an answer may be late by as much.
constexpr base::Duration look_period = 1ms;

base::Task<> watch(base::Loop& loop, building::Robot const& robot) {
  bool was_driven = false;
  for (;;) {
    auto const [left, right] = robot.voltages();
    bool const is_driven = left != 0.0 || right != 0.0;
    if (is_driven != was_driven) {
      auto const now = std::chrono::steady_clock::now().time_since_epoch();
      fmt::print("{} {}\n", is_driven ? "driven" : "zero",
                 std::chrono::duration_cast<std::chrono::nanoseconds>(now).count());
      std::fflush(stdout);
      was_driven = is_driven;
    }
    co_await loop.sleep(look_period);
  }
}

int serve(std::string const& path, std::string const& port) {
  std::ifstream file(path);
  auto plan = building::building_of(path, std::string(std::istreambuf_iterator<char>(file), {}));
  if (!plan) {
    fmt::print(stderr, "{}", plan.error().message);
    return 2;
  }
  auto made = building::Building::make(*std::move(plan), {.seed = 1, .robots = 1});
  auto const url = link::parse_url("tcpin://127.0.0.1:" + port);
  if (!made || !url) {
    fmt::print(stderr, "{}\n", made ? url.error().message : made.error().message);
    return 2;
  }
  base::Loop loop;
  building::BuildingRun run(loop, **made);
  if (auto const served = run.serve(0, *url); !served) {
    fmt::print(stderr, "{}\n", served.error().message);
    return 2;
  }
  loop.run_until_done(watch(loop, (*made)->robot(0)));
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    fmt::print(stderr, "usage: bench_kill_board BUILDING.toml PORT\n");
    return 2;
  }
  return serve(argv[1], argv[2]);
}
