#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "link/pipe_link.hpp"
#include "robot/rover/rover_body.hpp"
#include "robot/rover/testing/scripted_rover.hpp"

namespace lapwing::robot::rover::testing {

/// A body, and the rover at the far end of its link, in the small office and in time without pace.
struct RoverBench : ::testing::Test {
  RoverBench() {
    log.add_sink([this](base::LogRecord const& record) { lines.push_back(record.text); });
    body->listen({.on_reading = [this](Reading const& reading) { readings.push_back(reading); },
                  .on_scan = [this](slam::Scan const& scan) { scans.push_back(scan); }});
  }
  void run_for(base::Duration time) {
    loop.run_until_done(
        [](base::Loop& on, base::Duration wait) -> base::Task<> { co_await on.sleep(wait); }(loop, time));
  }
  /// Tells it the motion ten times a second, as the platform does.
  void drive_for(base::Duration time, Motion motion) {
    for (; time > base::Duration{}; time -= std::chrono::milliseconds(100)) {
      body->drive(motion);
      run_for(std::chrono::milliseconds(100));
    }
  }
  /// It drives: armed and in GUIDED.
  void set_off() {
    run_for(std::chrono::seconds(2));
    drive_for(std::chrono::seconds(1), ahead);
    ASSERT_EQ(rover->mode, guided);
    ASSERT_TRUE(rover->is_armed);
    ASSERT_FALSE(rover->stands());
  }
  [[nodiscard]] bool has_logged(std::string const& part) const {
    for (auto const& line : lines)
      if (line.contains(part)) return true;
    return false;
  }

  static constexpr Motion ahead{.speed_m_s = 0.2};
  base::Loop loop{base::Loop::Pace{.unpaced = true}};
  std::vector<std::string> lines;
  base::LogHub log;
  link::PipeHub hub{loop};
  std::unique_ptr<link::ByteLink> near = hub.take_server();
  std::unique_ptr<ScriptedRover> rover =
      std::make_unique<ScriptedRover>(loop, hub.connect(), robot::testing::small_office());
  std::vector<Reading> readings;
  std::vector<slam::Scan> scans;
  std::unique_ptr<RoverBody> body =
      std::make_unique<RoverBody>(loop, std::move(near), RoverBodyOptions{}, base::Logger(log, "robot1"));
};

}  // namespace lapwing::robot::rover::testing
