#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/time.hpp"
#include "mavlink/codec/enums.hpp"

namespace lapwing::route {

/// A far end among all of the router's: an index that is used again after the far end is gone.
using ChannelId = std::uint16_t;

/// Where each system and component was heard (https://mavlink.io/en/guide/routing.html): an array by system id, with
/// the few places of each.
///
/// A place counts as long as the system was heard nowhere else for `moved_after` since: a vehicle that restarted with
/// another address, or changed to its other radio, is not sent to at the old one. A silent system keeps its places.
class RoutingTable {
 public:
  static constexpr base::Duration moved_after = std::chrono::seconds(10);
  /// Of one system: beyond, the place that was silent for longest is forgotten.
  static constexpr std::size_t max_places = 64;

  void learn(mavlink::Address source, ChannelId channel, base::TimePoint now);
  void forget(ChannelId channel);

  /// Calls `visit(ChannelId)` once for each channel on which `target` was heard; component 0 stands for any. Target
  /// system 0 is everybody and not asked for here.
  template <class Visit>
  void for_each(mavlink::Address target, Visit&& visit) const {
    auto const& places = systems_[target.system];
    for (std::size_t i = 0; i < places.size(); ++i) {
      if (!counts(places[i], target, places) || is_repeated(i, target, places)) continue;
      visit(places[i].channel);
    }
  }
  [[nodiscard]] bool reaches(mavlink::Address target, ChannelId channel) const;

  /// Systems that were heard.
  [[nodiscard]] std::size_t systems() const;

 private:
  struct Place {
    base::TimePoint heard{};
    ChannelId channel = 0;
    std::uint8_t component = 0;
  };
  using Places = std::vector<Place>;
  [[nodiscard]] static bool counts(Place const& place, mavlink::Address target, Places const& places);
  [[nodiscard]] static bool is_repeated(std::size_t index, mavlink::Address target, Places const& places);

  std::array<Places, 256> systems_;
};

}  // namespace lapwing::route
