#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "fleet/mission/fleet_platform.hpp"
#include "fleet/testing/autopilot.hpp"
#include "link/impaired_link.hpp"
#include "link/pipe_link.hpp"
#include "mavlink/testing/stalling_link.hpp"
#include "missions/mission_task.hpp"

namespace lapwing::fleet {

/// A ground station in virtual time with links in memory, for tests.
struct TestWorld {
  explicit TestWorld(Fleet::Options fleet_options = {}, FleetPlatform::Options platform_options = {})
      : hub(loop),
        connection(loop, {}, base::Logger(log, "mavlink")),
        registry(loop),
        authority(loop, registry, base::Logger(log, "command")) {
    log.add_sink([this](base::LogRecord const& record) { lines.push_back(record.text); });
    connection.add_link(mavlink::testing::stall(hub.take_server(), way));
    fleet =
        std::make_unique<Fleet>(connection, registry, authority, std::move(fleet_options), base::Logger(log, "fleet"));
    platform = std::make_unique<FleetPlatform>(*fleet, std::move(platform_options), base::Logger(log, "fleet"));
  }

  TestAutopilot& add(TestAutopilot::Options options = {}, link::Impairment impairment = {}) {
    auto line = link::impair(loop, hub.connect(), impairment);
    vehicles.push_back(std::make_unique<TestAutopilot>(loop, std::move(line), options));
    return *vehicles.back();
  }

  void run_for(base::Duration time) { loop.run_until_done(nap(time)); }
  /// False when the condition did not come true within `limit`.
  bool run_until(std::function<bool()> condition, base::Duration limit = std::chrono::seconds(120)) {
    return loop.run_until_done(poll(std::move(condition), limit));
  }

  /// Whether the run gets to what its progress calls `phase`: "uploading", or "item" in flight.
  [[nodiscard]] bool comes_to(tasks::TaskRun const& run, std::string_view phase,
                              base::Duration limit = std::chrono::seconds(120)) {
    return run_until([&] { return run.progress().contains(phase); }, limit);
  }

  /// What `sendMessage` in a script does.
  base::Result<> send_message(std::string id, std::string message,
                              std::vector<tasks::NamedValue> const& fields = {}) const {
    std::vector<tasks::Argument> const arguments{std::move(message)};
    return platform->perform({.name = "sendMessage", .arguments = arguments, .values = fields}, {std::move(id)});
  }

  [[nodiscard]] vehicle::VehicleState const& state(std::string id = "1") const {
    return *registry.find(vehicle::VehicleId{std::move(id)});
  }
  [[nodiscard]] bool has_logged(std::string_view part) const {
    for (auto const& line : lines)
      if (line.contains(part)) return true;
    return false;
  }

  base::Loop loop{{.unpaced = true}};
  /// Of the ground's link: lets it stall and come back.
  std::shared_ptr<mavlink::testing::StalledWay> way = std::make_shared<mavlink::testing::StalledWay>();
  base::LogHub log;
  std::vector<std::string> lines;
  link::PipeHub hub;
  mavlink::Connection connection;
  vehicle::Registry registry;
  vehicle::Authority authority;
  std::unique_ptr<Fleet> fleet;
  std::unique_ptr<FleetPlatform> platform;
  std::vector<std::unique_ptr<TestAutopilot>> vehicles;

 private:
  base::Task<> nap(base::Duration time) { co_await loop.sleep(time); }
  base::Task<bool> poll(std::function<bool()> condition, base::Duration limit) {
    auto const deadline = loop.now() + limit;
    while (!condition()) {
      if (loop.now() >= deadline) co_return false;
      co_await loop.sleep(std::chrono::milliseconds(20));
    }
    co_return true;
  }
};

[[nodiscard]] inline mavlink::MissionItem item_at(mavlink::MavCmd command, double north_m, double alt_m = 120.0) {
  mavlink::MissionItem item;
  item.command = command;
  auto const place = geo::displaced(TestAutopilot::home, {.north = north_m, .east = 0.0, .down = 0.0});
  item.place = {.lat_rad = place.lat_rad, .lon_rad = place.lon_rad, .z_m = alt_m};
  return item;
}

/// Takes off, flies to some places and ends with `last`.
[[nodiscard]] inline plan::Mission mission_ending_with(mavlink::MavCmd last, int places = 3) {
  plan::Mission mission{.name = "survey", .home = std::nullopt, .items = {}};
  mission.items.push_back(item_at(mavlink::MavCmd::nav_takeoff, 0.0));
  for (int i = 1; i <= places; ++i) mission.items.push_back(item_at(mavlink::MavCmd::nav_waypoint, 100.0 * i));
  mission.items.push_back(item_at(last, 0.0, last == mavlink::MavCmd::nav_land ? 100.0 : 120.0));
  return mission;
}

[[nodiscard]] inline std::shared_ptr<missions::MissionTask const> task_of(plan::Mission mission) {
  return std::make_shared<missions::MissionTask const>(std::move(mission));
}

}  // namespace lapwing::fleet
