#pragma once

#include <deque>
#include <map>

#include "station/feeds/feed.hpp"
#include "vehicle/registry.hpp"

namespace lapwing::station {

/// Where each vehicle took its last pictures, as `pictures` messages: each picture once, all of them for a newcomer.
class PicturesFeed final : public Feed {
 public:
  explicit PicturesFeed(vehicle::Registry const& registry) : registry_(registry) {}

  [[nodiscard]] std::string_view name() const override { return "pictures"; }
  [[nodiscard]] std::uint64_t refresh(base::TimePoint now) override;
  [[nodiscard]] News since(std::uint64_t revision, base::TimePoint now, std::size_t room) const override;

 private:
  /// What came with one revision: the pictures behind that number.
  struct Arrival {
    std::uint64_t revision = 0;
    int behind = 0;
  };
  struct Album {
    unsigned long long looked_at = 0;  ///< the registry's revision
    std::deque<Arrival> arrivals;
    int newest = 0;
  };
  vehicle::Registry const& registry_;
  std::map<vehicle::VehicleId, Album> albums_;
  std::uint64_t revision_ = 1;
};

}  // namespace lapwing::station
