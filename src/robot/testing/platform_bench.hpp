#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "base/async/loop.hpp"
#include "robot/platform/robot_control.hpp"
#include "robot/platform/robot_platform.hpp"
#include "robot/testing/simple_body.hpp"

namespace lapwing::robot::testing {

/// A platform with a robot in the small office, in time without pace.
struct PlatformBench {
  /// `hold_up`: has a module of the first robot hang.
  explicit PlatformBench(unsigned threads = 2, std::function<base::Task<>(Module)> hold_up = {})
      : loop(base::Loop::Pace{.unpaced = true, .begins_at = base::UtcTime(std::chrono::hours(24 * 365 * 30))},
             threads) {
    live_map.put_site(*geo::Site::make("office", geo::Wgs84::from_degrees(41.178, -8.598, 90.0)));
    robot = add("robot1", {}, std::move(hold_up));
  }

  /// `start`: where it is said to stand.
  Robot* add(std::string const& id, SimpleBodyOptions const& options = {},
             std::function<base::Task<>(Module)> hold_up = {}, geo::Pose<geo::SiteFrame> const& start = {}) {
    auto made = std::make_unique<SimpleBody>(loop, walls, options);
    added_body = made.get();
    if (!body) body = added_body;
    RobotSpec spec{.id = id, .name = "robot " + id.substr(5), .site = "office"};
    spec.hold_up = std::move(hold_up);
    spec.start = start;
    return platform.add(std::move(spec), std::move(made)).value();
  }
  void run_for(base::Duration time) {
    loop.run_until_done(
        [](base::Loop& on, base::Duration wait) -> base::Task<> { co_await on.sleep(wait); }(loop, time));
  }
  /// False when it did not come true within the time.
  bool run_until(std::function<bool()> const& condition, base::Duration time) {
    auto const end = loop.now() + time;
    while (!condition() && loop.now() < end) run_for(std::chrono::milliseconds(100));
    return condition();
  }
  std::unique_ptr<tasks::TaskRun> start(std::vector<Step> steps, std::string const& id = "robot1") {
    return platform.start(std::make_shared<DriveTask const>("errand", std::move(steps)), {id});
  }
  [[nodiscard]] vehicle::VehicleState const& state() const { return *registry.find({"robot1"}); }

  Walls walls = small_office();  ///< of the next one
  base::LogHub hub;
  base::Loop loop;
  base::Logger log{hub, "test"};
  vehicle::Registry registry{loop};
  vehicle::Authority authority{loop, registry, log};
  map::LiveMap live_map{[this] { return loop.utc_now(); }};
  RobotPlatform platform{{loop, registry, authority, live_map}, log};
  RobotControl control{platform, {loop, authority}, log};
  SimpleBody* body = nullptr;        ///< of the first robot
  SimpleBody* added_body = nullptr;  ///< of the last one
  Robot* robot = nullptr;            ///< the first
};

}  // namespace lapwing::robot::testing
