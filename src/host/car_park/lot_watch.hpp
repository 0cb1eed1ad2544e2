#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/async/loop.hpp"
#include "base/async/scope.hpp"
#include "base/log.hpp"
#include "explore/lot/lot_map.hpp"
#include "host/car_park/car_park_look.hpp"
#include "host/car_park/lot_score.hpp"
#include "map/live/live_map.hpp"
#include "vehicle/vehicle_id.hpp"

namespace lapwing::host {

/// For --car-park of every verb that simulates.
inline constexpr auto car_park_help =
    "A car park (docs/reference/car-park-worlds.md) over which simulated drones look down: its slots go on the map";

/// A simulated drone in the air, as the pictures that it takes say by themselves.
struct DroneInTheAir {
  vehicle::VehicleId vehicle;
  geo::Wgs84 place;
  double heading_rad = 0.0;  ///< clockwise from true north
};

/// Maps a simulated car park from what the cameras of simulated drones see, whatever they fly there for: one that has
/// got on by a part of its picture takes the next. What is found becomes slots on the map.
///
/// Thread-bound; all that it is given outlives it.
class LotWatch {
 public:
  using Ask = std::function<base::Task<base::Result<LookFrame>>(LookFrame)>;
  struct Setup {
    std::filesystem::path world;
    std::string site = "default";
    /// Looking straight down from a gimbal, its upper edge ahead.
    geo::Lens lens = geo::pinhole(960, 720, 1.0821);
    Ask ask;
    std::function<std::vector<DroneInTheAir>()> drones;
  };
  LotWatch(base::Loop& loop, ::lapwing::map::LiveMap& live_map, Setup setup, base::Logger log);
  LotWatch(LotWatch const&) = delete;
  LotWatch& operator=(LotWatch const&) = delete;

  [[nodiscard]] int pictures() const { return pictures_; }
  /// The slots that it has put on the map.
  [[nodiscard]] std::vector<::lapwing::map::Slot> on_the_map() const;
  /// Of the area that was seen well enough to tell.
  [[nodiscard]] double coverage() const { return lot_ ? lot_->coverage() : 0.0; }
  /// Against what was true when the last picture was taken: cars come and go. Errors: those of who looks.
  [[nodiscard]] base::Task<base::Result<LotScore>> judge();

 private:
  /// A moment at which a drone may take a picture.
  struct View {
    vehicle::VehicleId vehicle;
    CarParkLook look;
  };

  [[nodiscard]] base::Task<> watch();
  [[nodiscard]] base::Task<base::Result<CarParkTruth>> ask_for_truth(base::UtcTime at);
  [[nodiscard]] base::Task<bool> find_car_park();
  [[nodiscard]] base::Task<> look(View view);
  [[nodiscard]] std::optional<View> view_from(DroneInTheAir const& drone) const;
  [[nodiscard]] bool is_worth_a_picture(View const& view) const;
  void write();

  base::Loop& loop_;
  ::lapwing::map::LiveMap& live_map_;
  Setup setup_;
  base::Logger log_;
  std::optional<explore::LotMap> lot_;
  double ground_m_ = 0.0;
  std::map<vehicle::VehicleId, geo::Point3<geo::SiteFrame>> taken_at_;  ///< each drone's last picture
  int pictures_ = 0;
  base::UtcTime last_taken_{};
  base::Scope scope_;
};

}  // namespace lapwing::host
