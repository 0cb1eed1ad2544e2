#include "dryrun/analysis.hpp"

#include <algorithm>

namespace lapwing::dryrun {

using base::Duration;

namespace {

std::optional<plan::Approach> approach_of(VehicleRecord const& first, VehicleRecord const& second) {
  auto const a = plan::left_start(first.track, parking_m);
  auto const b = plan::left_start(second.track, parking_m);
  if (!a && !b) return std::nullopt;
  auto const from = std::min(a.value_or(Duration::max()), b.value_or(Duration::max()));
  return plan::closest_approach(plan::part(first.track, from, Duration::max()),
                                plan::part(second.track, from, Duration::max()));
}

std::vector<Pair> pairs_of(FlightRecord const& record) {
  std::vector<Pair> pairs;
  auto const& vehicles = record.vehicles;
  for (std::size_t i = 0; i < vehicles.size(); ++i) {
    for (std::size_t k = i + 1; k < vehicles.size(); ++k)
      if (auto const approach = approach_of(vehicles[i], vehicles[k])) pairs.push_back({i, k, *approach});
  }
  std::ranges::stable_sort(pairs, {}, [](Pair const& pair) { return pair.approach.distance_m; });
  return pairs;
}

std::size_t index_at(VehicleRecord const& vehicle, Duration time) {
  auto const after = std::ranges::upper_bound(vehicle.track, time, {}, &plan::TrackPoint::time);
  auto const index = static_cast<std::size_t>(after - vehicle.track.begin());
  return index == 0 ? 0 : index - 1;
}

}  // namespace

Figures figures(VehicleRecord const& vehicle, Duration begin, Duration end) {
  if (vehicle.track.empty()) return {};
  auto const track = plan::part(vehicle.track, begin, end);
  auto const& before = vehicle.charge[index_at(vehicle, begin)];
  auto const& after = vehicle.charge[index_at(vehicle, end)];
  return {.path_m = plan::length_m(track),
          .highest_m = plan::greatest_height_m(track),
          .battery_used = static_cast<double>(before.remaining - after.remaining),
          .energy_wh = static_cast<double>(after.used_wh - before.used_wh)};
}

Analysis analyse(FlightRecord const& record, plan::Fence const& fence) {
  Analysis analysis;
  for (std::size_t i = 0; i < record.vehicles.size(); ++i) {
    auto const& vehicle = record.vehicles[i];
    analysis.vehicles.push_back(figures(vehicle, Duration::zero(), record.duration));
    for (auto& breach : plan::breaches(vehicle.track, fence)) analysis.breaches.push_back({i, std::move(breach)});
  }
  analysis.pairs = pairs_of(record);
  std::ranges::stable_sort(analysis.breaches, {}, [](VehicleBreach const& one) { return one.breach.begin; });
  return analysis;
}

}  // namespace lapwing::dryrun
