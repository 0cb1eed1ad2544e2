// What the station's feed of vehicles costs: 100 vehicles, each with all that telemetry tells. `moving`: every vehicle
// has moved since the last look; `heard_again`: one that stands is heard again; `newcomer`: everything, for a viewer
// that comes.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include "station/feeds/vehicles_feed.hpp"
#include "vehicle/registry.hpp"

namespace {

using namespace std::chrono_literals;
using namespace lapwing;

constexpr int vehicles = 100;

/// Of a copter in flight.
void fill(vehicle::VehicleState& state, base::TimePoint now) {
  state.name = fmt::format("copter {}", state.id.text);
  state.family = vehicle::Family::copter;
  state.autopilot = vehicle::Autopilot::ardupilot;
  state.links.used = "udpin://0.0.0.0:14550 from 127.0.0.1:40000";
  state.links.all = {{.name = "udp from 127.0.0.1:40000",
                      .messages_per_s = 50.0,
                      .bytes_per_s = 2000.0,
                      .round_trip = 20ms,
                      .is_alive = true,
                      .is_used = true}};
  state.mode.set("AUTO", now);
  state.arming.armed.set(true, now);
  state.motion.landed.set(false, now);
  state.arming.health.set({true, true}, now);
  state.power.battery.set({.remaining = 0.8, .voltage_v = 15.2, .current_a = 12.0}, now);
  state.positioning.gps.set({3, 14, 0.8}, now);
  state.positioning.estimator.set({0.1, 0.1, 0.1, 0.1}, now);
  state.links.remote_control.set({.is_lost = false, .channels = 8, .pulses_us = {1500, 1500, 1000, 1500}, .rssi = {}},
                                 now);
  state.mission.progress.set({3, 20, false, "active"}, now);
  state.mission.fence.set({false, 0, ""}, now);
  state.motion.home.set(geo::Wgs84::from_degrees(40, -8, 100), now);
  for (int i = 0; i < 50; ++i)
    state.recent_texts.push_back({.severity = 6, .text = fmt::format("Mission: {} WP", i), .heard = now});
}

/// What a telemetry stream of 10 Hz tells anew between two looks.
void move(vehicle::VehicleState& state, int turn, base::TimePoint now) {
  state.links.heartbeat_heard = state.links.heard = now;
  state.motion.position.set(geo::Wgs84::from_degrees(40 + turn * 1e-6, -8, 120), now);
  state.motion.relative_alt_m.set(20.0 + turn % 7, now);
  state.motion.velocity_m_s.set({1.0 * (turn % 5), 2.0, 0.1}, now);
  state.motion.heading_rad.set(0.01 * (turn % 600), now);
  state.motion.attitude.set({0.001 * (turn % 100), 0.1, 0.01 * (turn % 600)}, now);
  state.motion.hud.set({5.0, 0.1, 0.5}, now);
  state.motion.track_m += 1.0;
}

struct Fleet {
  Fleet() {
    for (int i = 1; i <= vehicles; ++i) {
      ids.push_back({std::to_string(i)});
      fill(registry.edit(ids.back()), now);
      registry.touch(ids.back());
    }
    (void)news();
  }

  /// What a viewer that is up to date is told next.
  station::News news() {
    auto const known = told;
    told = feed.refresh(now);
    return feed.since(known, now, 0);
  }

  base::TimePoint now{1h};
  base::Loop loop{{.unpaced = true}};
  vehicle::Registry registry{loop};
  station::VehiclesFeed feed{registry};
  std::uint64_t told = 0;
  std::vector<vehicle::VehicleId> ids;
};

void moving(benchmark::State& state) {
  Fleet fleet;
  int turn = 0;
  for ([[maybe_unused]] auto _ : state) {
    fleet.now += 200ms;
    ++turn;
    for (auto const& id : fleet.ids) {
      move(fleet.registry.edit(id), turn, fleet.now);
      fleet.registry.touch(id);
    }
    benchmark::DoNotOptimize(fleet.news());
  }
  state.SetItemsProcessed(state.iterations() * vehicles);
}
BENCHMARK(moving)->Unit(benchmark::kMicrosecond);

void heard_again(benchmark::State& state) {
  Fleet fleet;
  for ([[maybe_unused]] auto _ : state) {
    fleet.now += 200ms;
    for (auto const& id : fleet.ids) {
      fleet.registry.edit(id).mode.heard = fleet.now;
      fleet.registry.touch(id);
    }
    benchmark::DoNotOptimize(fleet.news());
  }
  state.SetItemsProcessed(state.iterations() * vehicles);
}
BENCHMARK(heard_again)->Unit(benchmark::kMicrosecond);

void newcomer(benchmark::State& state) {
  Fleet fleet;
  for ([[maybe_unused]] auto _ : state) benchmark::DoNotOptimize(fleet.feed.since(0, fleet.now, 0));
  state.SetItemsProcessed(state.iterations() * vehicles);
}
BENCHMARK(newcomer)->Unit(benchmark::kMicrosecond);

}  // namespace

BENCHMARK_MAIN();
