#include "sim/building/building_run.hpp"

#include <gtest/gtest.h>

#include "sim/building/testing/host_end.hpp"
#include "sim/building/testing/small_building.hpp"

namespace lapwing::sim::building {
namespace {

using namespace std::chrono_literals;

base::Task<void> passing(base::Loop& loop, base::Duration duration) {
  co_await loop.sleep(duration);
}

/// Counts the frames that come over a link, and greets.
struct Caller {
  explicit Caller(std::unique_ptr<link::ByteLink> to) : link(std::move(to)) {
    link->start([this](link::Peer, link::Bytes bytes) {
      for (auto const byte : bytes) {
        if (reader.push(byte)) frames += 1;
      }
    });
  }
  void hail() {
    auto const frame = firmware::write(firmware::FromHost(firmware::Hail{}), sequence++);
    for (auto const peer : link->standing_peers()) (void)link->send(peer, frame.view());
  }
  std::unique_ptr<link::ByteLink> link;
  firmware::FrameReader reader;
  std::uint8_t sequence = 0;
  int frames = 0;
};

TEST(BuildingRun, PassesTimeWithTheLoopAndSpeaksOnALineInMemory) {
  base::Loop loop({.unpaced = true});
  auto const building = testing::small_building({{2, 2}, 0.0});
  BuildingRun run(loop, *building);
  Caller caller(run.connect(0));
  loop.run_until_done(passing(loop, 1s));
  EXPECT_EQ(caller.frames, 0);
  caller.hail();
  loop.run_until_done(passing(loop, 2s));
  EXPECT_NEAR(building->time_s(), 3.0, 0.02);
  // Readings and four pieces of a scan, ten times a second each.
  EXPECT_NEAR(caller.frames, 100, 10);
  EXPECT_EQ(caller.reader.counters().damaged, 0U);
}

TEST(BuildingRun, ServesALineOverTcp) {
  base::Loop loop({.speedup = 20.0});
  auto const building = testing::small_building({{2, 2}, 0.0});
  BuildingRun run(loop, *building);
  auto server = link::open(loop, {link::Transport::tcp_in, "127.0.0.1", 0});
  ASSERT_TRUE(server);
  auto const name = (*server)->name();
  auto const port = static_cast<std::uint32_t>(std::stoul(name.substr(name.rfind(':') + 1)));
  run.serve(0, *std::move(server));
  Caller caller(link::open(loop, {link::Transport::tcp_out, "127.0.0.1", port}).value());
  for (int i = 0; i < 100 && caller.frames < 20; ++i) {
    caller.hail();
    loop.run_until_done(passing(loop, 200ms));
  }
  EXPECT_GE(caller.frames, 20);
}

TEST(BuildingRun, TellsWhyAPortCannotBeServed) {
  base::Loop loop({.unpaced = true});
  auto const building = testing::small_building({{2, 2}, 0.0});
  BuildingRun run(loop, *building);
  EXPECT_FALSE(run.serve(0, link::Url{link::Transport::tcp_in, "192.0.2.1", 5770}));
}

}  // namespace
}  // namespace lapwing::sim::building
