#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/time.hpp"
#include "geo/polygon.hpp"
#include "geo/position.hpp"
#include "geo/site.hpp"
#include "video/world/vehicle_look.hpp"

/// A car park and what is round it: all that a simulated camera needs to draw it, and what is true of it.
namespace lapwing::video {

/// Metres east and north of the anchor.
using Spot = geo::Point<geo::SiteFrame>;

/// A place to park.
struct Slot {
  enum class Habit : std::uint8_t { by_chance, free, taken, left_to_listed };
  std::string id;
  std::array<Spot, 4> outline;  ///< in order round it: the mouth's two corners, then the head's two
  Habit habit = Habit::by_chance;
  double share = 0.6;  ///< of its time, for `by_chance`, that it is taken

  [[nodiscard]] Spot middle() const;
  /// Of the cars that stand in it: along its longer sides, towards the head where that is along them.
  [[nodiscard]] double heading_rad() const;
  [[nodiscard]] double longer_side_m() const;
  [[nodiscard]] bool contains(Spot const& place) const;
};

/// A line of paint.
struct Stripe {
  std::vector<Spot> points = {};
  double width_m = 0.12;
  Colour colour = {0.92, 0.92, 0.91};
};

enum class Ground : std::uint8_t { grass, asphalt, concrete, gravel };
/// Ground of one kind, above what was listed before it.
struct Patch {
  Ground ground = Ground::asphalt;
  std::vector<Spot> corners = {};
  bool has_kerb = false;
};

struct Tree {
  Spot at = {};
  double radius_m = 2.2;
  double height_m = 6.0;
};

/// A building: its walls stand straight, its roof is flat.
struct Block {
  std::vector<Spot> corners = {};
  double height_m = 4.0;
  Colour roof = {0.55, 0.53, 0.5};
};

/// A vehicle that always stands there.
struct ListedCar {
  Spot at = {};
  double heading_rad = 0.0;
  VehicleLook look = {};
  std::optional<std::size_t> slot = {};  ///< in which it stands
};

/// A way that vehicles take, one after the other, from its begin to its end.
struct Lane {
  std::vector<Spot> points = {};
  double speed_m_s = 3.0;
  double every_s = 60.0;  ///< on average, and never less than a third of it
};

struct Light {
  double sun_azimuth_rad = 3.4907;  ///< clockwise from north
  double sun_height_rad = 0.6981;   ///< above the horizon
  double shadow = 0.7;              ///< the part of the light that shadows lack: 0 under clouds
  double brightness = 1.0;
};

/// A photograph of the ground from above, north up, between two corners.
struct GroundPicture {
  std::filesystem::path file;
  Spot south_west;
  Spot north_east;
};

struct CarPark {
  std::string name = {};
  geo::Wgs84 anchor = {};
  std::uint64_t seed = 1;
  Light light = {};
  double pixel_m = 0.04;  ///< of the ground, as it is drawn
  double wear = 0.4;      ///< of paint and asphalt: 0 new, 1 hardly to be seen
  double stay_s = 0.0;    ///< how long a car stays on average; 0: cars stay for ever
  double slip_m = 0.2;    ///< how far cars stand from the middle of their slots: standard deviation
  std::optional<GroundPicture> picture = {};
  std::vector<Patch> patches = {};
  std::vector<Stripe> stripes = {};
  std::vector<Slot> slots = {};
  std::vector<ListedCar> cars = {};
  std::vector<Lane> lanes = {};
  std::vector<Tree> trees = {};
  std::vector<Block> blocks = {};
};

/// What stands or drives somewhere at one moment.
struct Vehicle {
  Spot at = {};
  double heading_rad = 0.0;
  VehicleLook look = {};
  std::optional<std::size_t> slot = {};  ///< in which it stands
  bool is_driving = false;
};

/// What is true at one moment.
struct Occupation {
  std::vector<bool> taken;  ///< of each slot
  std::vector<Vehicle> vehicles;
};

/// A slot's car leaves, and another may come, at the times of a Poisson process, `stay_s` apart on average; then the
/// slot is taken with the chance `share`, whatever was there before. So a slot that is taken stays so for
/// stay_s / (1 - share), a free one for stay_s / share, on average. Depends on the seed and the time alone.
[[nodiscard]] Occupation occupation_at(CarPark const& park, base::UtcTime at);

/// The corners of a vehicle on the ground, in order round it.
[[nodiscard]] std::array<Spot, 4> outline_of(Vehicle const& vehicle);

}  // namespace lapwing::video
