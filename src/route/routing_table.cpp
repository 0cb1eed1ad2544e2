#include "route/routing_table.hpp"

#include <algorithm>

namespace lapwing::route {

void RoutingTable::learn(mavlink::Address source, ChannelId channel, base::TimePoint now) {
  if (source.system == 0) return;  // not a system: nobody can address it
  auto& places = systems_[source.system];
  for (auto& place : places) {
    if (place.channel != channel || place.component != source.component) continue;
    place.heard = now;
    return;
  }
  if (places.size() >= max_places) places.erase(std::ranges::min_element(places, {}, &Place::heard));
  places.push_back({now, channel, source.component});
}

void RoutingTable::forget(ChannelId channel) {
  for (auto& places : systems_) std::erase_if(places, [&](Place const& place) { return place.channel == channel; });
}

/// Components of one system may be silent for long while others speak from the same channel; only a newer place of the
/// same component elsewhere makes an old one doubtful.
bool RoutingTable::counts(Place const& place, mavlink::Address target, Places const& places) {
  if (target.component != 0 && place.component != target.component) return false;
  return std::ranges::none_of(places, [&](Place const& other) {
    return other.component == place.component && other.heard - place.heard > moved_after;
  });
}

/// With any component asked for, a channel may have several.
bool RoutingTable::is_repeated(std::size_t index, mavlink::Address target, Places const& places) {
  for (std::size_t i = 0; i < index; ++i) {
    if (places[i].channel == places[index].channel && counts(places[i], target, places)) return true;
  }
  return false;
}

bool RoutingTable::reaches(mavlink::Address target, ChannelId channel) const {
  bool found = false;
  for_each(target, [&](ChannelId place) { found = found || place == channel; });
  return found;
}

std::size_t RoutingTable::systems() const {
  return static_cast<std::size_t>(std::ranges::count_if(systems_, [](auto const& places) { return !places.empty(); }));
}

}  // namespace lapwing::route
