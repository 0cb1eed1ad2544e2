#pragma once

#include <chrono>
#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/async/loop.hpp"
#include "base/async/task.hpp"
#include "map/live/live_map.hpp"
#include "vehicle/registry.hpp"

namespace lapwing::host {

/// Writes on the map where vehicles go, so that their trails survive whoever looks at them.
///
/// A vehicle's track comes in legs of so many points; the oldest go. It is thinned as it is written: a point is worth
/// noting when the vehicle has got on since the last one.
class TrackWriter {
 public:
  struct Options {
    base::Duration period = std::chrono::milliseconds(500);  ///< between two points
    base::Duration pause = std::chrono::seconds(2);          ///< between two writings, for all vehicles together
    double least_m = 0.3;                                    ///< less is standing still, by any means of position
    std::size_t points_a_leg = 1'000;
    std::size_t legs = 10;  ///< of one vehicle
  };
  /// All outlive it. A vehicle that is heard where there is no site yet makes one called "default" round its home.
  TrackWriter(base::Loop& loop, vehicle::Registry const& vehicles, ::lapwing::map::LiveMap& map, Options options);
  TrackWriter(base::Loop& loop, vehicle::Registry const& vehicles, ::lapwing::map::LiveMap& map)
      : TrackWriter(loop, vehicles, map, Options{}) {}

  /// Notes where vehicles are now.
  void look();
  /// Puts what has been noted on the map.
  void write();

 private:
  using Sample = ::lapwing::map::Track::Sample;
  struct Trail {
    std::string site;
    std::string floor;
    std::vector<Sample> noted;  ///< since the last writing; the first one stands on the map already
    std::size_t points = 0;     ///< of the leg
    std::vector<std::string> legs;
    base::TimePoint heard{};
  };
  struct Spot {
    std::string site;
    std::string floor;
    Sample sample;
    base::TimePoint heard;
  };

  [[nodiscard]] base::Task<> go_on();
  [[nodiscard]] std::optional<Spot> spot_of(vehicle::VehicleState const& state);
  [[nodiscard]] geo::Site const* site_near(geo::Wgs84 const& position, std::optional<geo::Wgs84> const& home);
  [[nodiscard]] base::UtcTime utc_of(base::TimePoint heard) const;
  void begin_leg(std::string const& vehicle, Trail& trail, Spot const& spot);

  base::Loop& loop_;
  vehicle::Registry const& vehicles_;
  ::lapwing::map::LiveMap& map_;
  Options options_;
  std::map<vehicle::VehicleId, Trail> trails_;
  base::Task<> work_;
};

}  // namespace lapwing::host
