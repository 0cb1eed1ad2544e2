#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "link/pipe_link.hpp"
#include "mavlink/connection/connection.hpp"
#include "sim/world/world.hpp"

namespace lapwing::sim {

/// ArduPilot's numbers of the modes that more than one test enters.
constexpr int copter_auto = 3;
constexpr int copter_guided = 4;
constexpr int copter_land = 9;
constexpr int plane_auto = 10;
constexpr int plane_take_off = 13;
constexpr int plane_guided = 15;
constexpr int rover_auto = 10;
constexpr int rover_guided = 15;

/// Mission items about a world's home, for tests.
struct ItemMaker {
  geo::Wgs84 home;

  [[nodiscard]] mavlink::MissionItem at(mavlink::MavCmd command, geo::Ned offset,
                                        std::array<float, 4> params = {}) const {
    auto const place = geo::displaced(home, offset);
    mavlink::MissionItem item;
    item.frame = mavlink::MavFrame::global_relative_alt_int;
    item.command = command;
    item.params = params;
    item.place.lat_rad = place.lat_rad;
    item.place.lon_rad = place.lon_rad;
    item.place.z_m = -offset.down;
    return item;
  }
  [[nodiscard]] mavlink::MissionItem waypoint(double north, double east, double up, float hold_s = 0.0F) const {
    return at(mavlink::MavCmd::nav_waypoint, {north, east, -up}, {hold_s});
  }
  [[nodiscard]] mavlink::MissionItem take_off(double up) const {
    auto item = at(mavlink::MavCmd::nav_takeoff, {0, 0, -up});
    item.place.lat_rad = 0.0;
    item.place.lon_rad = 0.0;
    return item;
  }
  [[nodiscard]] static mavlink::MissionItem plain(mavlink::MavCmd command, std::array<float, 4> params = {}) {
    mavlink::MissionItem item;
    item.frame = mavlink::MavFrame::mission;
    item.command = command;
    item.params = params;
    return item;
  }
};

/// A ground station for tests: a world on an unpaced loop, pipes to its vehicles, and everything they said.
class TestGround {
 public:
  struct Heard {
    base::TimePoint at;
    std::uint8_t system;
    std::uint8_t component;
    link::Peer peer;
    mavlink::Message message;
  };

  explicit TestGround(std::string_view vehicles, WorldOptions options = {}, bool heartbeats = true)
      : hub_(loop),
        world(
            loop, with(std::move(options), vehicles), [this] { return Opened(hub_.connect()); }, base::Logger()),
        gcs(loop, gcs_options(heartbeats), base::Logger()) {
    gcs.add_link(hub_.take_server());
    subscription_ = gcs.subscribe([this](mavlink::Received const& received) {
      heard.push_back(
          {received.at, received.source.system, received.source.component, received.from.peer, received.message});
    });
    auto const started = world.start();
    EXPECT_TRUE(started.has_value());
  }

  void run_for(base::Duration duration) { loop.run_until_done(pass(duration)); }
  /// Lets time pass until `condition` holds; false when `timeout` came first.
  bool run_until(std::function<bool()> const& condition, base::Duration timeout) {
    auto const deadline = loop.now() + timeout;
    while (!condition()) {
      if (loop.now() >= deadline) return false;
      run_for(std::chrono::milliseconds(10));
    }
    return true;
  }
  /// Until the vehicle's estimator has a position.
  void boot() { run_for(std::chrono::seconds(4)); }

  void send(mavlink::Message const& message, std::uint8_t system = 1) { (void)gcs.send({system, 1}, message); }

  std::optional<mavlink::MavResult> command(mavlink::MavCmd number, std::array<float, 7> params = {},
                                            std::uint8_t system = 1) {
    auto const from = heard.size();
    send(mavlink::CommandLong{.target = {}, .command = number, .params = params}, system);
    std::optional<mavlink::MavResult> result;
    run_until(
        [&] {
          for (auto i = from; i < heard.size(); ++i) {
            auto const* ack = std::get_if<mavlink::CommandAck>(&heard[i].message);
            if (ack && ack->command == number && heard[i].system == system) result = ack->result;
          }
          return result.has_value();
        },
        std::chrono::seconds(1));
    return result;
  }
  std::optional<mavlink::MavResult> set_mode(int number, std::uint8_t system = 1) {
    return command(mavlink::MavCmd::do_set_mode, {1.0F, static_cast<float>(number)}, system);
  }
  std::optional<mavlink::MavResult> arm(std::uint8_t system = 1) {
    return command(mavlink::MavCmd::component_arm_disarm, {1.0F}, system);
  }
  std::optional<mavlink::MavResult> request(mavlink::MessageId id, double hertz, std::uint8_t system = 1) {
    return command(mavlink::MavCmd::set_message_interval, {static_cast<float>(id), static_cast<float>(1e6 / hertz)},
                   system);
  }

  /// Answers the vehicle's requests until it acknowledges; the acknowledgement, if one came. All items are of one type.
  std::optional<mavlink::MavMissionResult> upload(std::vector<mavlink::MissionItem> items, std::uint8_t system = 1) {
    auto from = heard.size();
    auto const type = items.empty() ? mavlink::MissionType::mission : items.front().type;
    send(mavlink::MissionCount{.count = static_cast<std::uint16_t>(items.size()), .type = type}, system);
    std::optional<mavlink::MavMissionResult> result;
    run_until(
        [&] {
          for (; from < heard.size() && !result; ++from) {
            if (heard[from].system != system) continue;
            if (auto const* ack = std::get_if<mavlink::MissionAck>(&heard[from].message)) result = ack->result;
            auto const* request = std::get_if<mavlink::MissionRequest>(&heard[from].message);
            if (!request || request->seq >= items.size()) continue;
            auto item = items[request->seq];
            item.seq = request->seq;
            send(item, system);
          }
          return result.has_value();
        },
        std::chrono::seconds(20));
    return result;
  }

  /// Boots, uploads the mission if there is one, enters the mode and arms.
  void arm_in(int mode, std::vector<mavlink::MissionItem> mission = {}) {
    boot();
    if (!mission.empty()) {
      EXPECT_EQ(upload(std::move(mission)), mavlink::MavMissionResult::accepted);
    }
    EXPECT_EQ(set_mode(mode), mavlink::MavResult::accepted);
    EXPECT_EQ(arm(), mavlink::MavResult::accepted);
  }
  /// A copter that begins this mission.
  void fly(std::vector<mavlink::MissionItem> mission) {
    arm_in(copter_guided, std::move(mission));
    EXPECT_EQ(command(mavlink::MavCmd::mission_start), mavlink::MavResult::accepted);
  }
  /// A copter in guided mode at this height.
  void hover(float height_m) {
    arm_in(copter_guided);
    EXPECT_EQ(command(mavlink::MavCmd::nav_takeoff, {0, 0, 0, 0, 0, 0, height_m}), mavlink::MavResult::accepted);
    run_for(std::chrono::seconds(8) + base::from_seconds(height_m / 2.0));
  }
  /// Sends the vehicle, which is in guided mode, there, as a ground station does, and lets `time` pass. Metres from
  /// home.
  void go_to(double north, double east, double up, base::Duration time) {
    auto target = maker().waypoint(north, east, up);
    target.current = 2;
    send(target);
    run_for(time);
  }
  /// Sets a parameter past the link.
  void set(std::string_view name, float value) { EXPECT_TRUE(vehicle().parameters().set(name, value)) << name; }

  template <class M>
  std::vector<M> all(std::uint8_t system = 1, std::size_t from = 0,
                     std::uint8_t component = mavlink::autopilot_component) const {
    std::vector<M> found;
    for (auto i = from; i < heard.size(); ++i) {
      auto const* message = std::get_if<M>(&heard[i].message);
      if (message && heard[i].system == system && heard[i].component == component) found.push_back(*message);
    }
    return found;
  }
  template <class M>
  std::optional<M> last(std::uint8_t system = 1) const {
    auto const found = all<M>(system);
    return found.empty() ? std::nullopt : std::optional(found.back());
  }
  /// How often a status text with that beginning was heard.
  int said(std::string_view beginning, std::uint8_t system = 1) const {
    int count = 0;
    for (auto const& text : all<mavlink::StatusText>(system)) count += text.text.starts_with(beginning) ? 1 : 0;
    return count;
  }

  [[nodiscard]] ItemMaker maker() const { return {world.options().home}; }
  Vehicle& vehicle(int system = 1) { return *world.find(system); }
  Autopilot const& pilot(int system = 1) { return vehicle(system).autopilot(); }
  /// Metres from where the vehicle was parked.
  double from_start(int system = 1) {
    auto const& start = vehicle(system).options().start;
    auto const& here = pilot(system).body().position_m;
    return std::hypot(here.north - start.north, here.east - start.east);
  }

  base::Loop loop{base::Loop::Pace{.speedup = 1.0, .unpaced = true}};

 private:
  using Opened = base::Result<std::unique_ptr<link::ByteLink>>;

  static WorldOptions with(WorldOptions options, std::string_view vehicles) {
    options.vehicles = parse_vehicles(vehicles).value();
    return options;
  }
  static mavlink::Connection::Options gcs_options(bool heartbeats) {
    mavlink::Connection::Options options;
    if (heartbeats) return options;
    options.heartbeat = {};
    options.timesync_period = {};
    return options;
  }
  base::Task<void> pass(base::Duration duration) { co_await loop.sleep(duration); }

  link::PipeHub hub_;

 public:
  World world;
  mavlink::Connection gcs;
  std::vector<Heard> heard;

 private:
  mavlink::Subscription subscription_;
};

}  // namespace lapwing::sim
