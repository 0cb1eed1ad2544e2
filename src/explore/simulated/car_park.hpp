#pragma once

#include <cstdint>
#include <vector>

#include "explore/lot/lot_sight.hpp"
#include "geo/polygon.hpp"

namespace lapwing::explore {

/// How the simulated detectors err. Errors of one slot from one place are the same again and again, as those of real
/// detectors are; from elsewhere they are others, but for a share that the slot itself causes.
struct DetectorFaults {
  double wrong_share = 0.02;      ///< of slots that are called taken or free wrongly, by one picture from near
  double coarse_m = 0.08;         ///< a pixel that measures so much on the ground makes twice as many
  double missed_share = 0.08;     ///< of slots in the picture
  double false_a_picture = 0.05;  ///< slots where none is
  double of_slot = 0.2;           ///< shares of the error: by the slot,
  double of_place = 0.6;          ///< by the place from where it is seen; the rest by the picture
  double same_place_m = 4.0;
  double outline_m = 0.15;    ///< standard deviation of a corner
  double camera_off_m = 0.3;  ///< of what the drone says of its place, for some seconds
};

/// A car park that is drawn by a seed: rows of slots head to head with lanes between them, some slots left out for
/// islands, trees that hide the ground, cars that stand and cars that drive about; some have a corner cut out, some a
/// building in the middle, over which nothing flies.
class CarPark {
 public:
  explicit CarPark(std::uint64_t seed, DetectorFaults faults = {});

  struct TrueSlot {
    Corners outline;
    bool is_taken = false;
    bool is_painted = true;  ///< both of its lines
  };
  [[nodiscard]] geo::Polygon<geo::SiteFrame> const& area() const { return area_; }
  /// The area and some metres round it, without the building.
  [[nodiscard]] geo::Polygon<geo::SiteFrame> const& fence() const { return fence_; }
  [[nodiscard]] std::vector<TrueSlot> const& slots() const { return slots_; }
  [[nodiscard]] map::SitePoint const& home() const { return home_; }

  /// What the detectors tell of a picture. The same picture gives the same answer.
  [[nodiscard]] LotSight look(geo::GroundView const& view, base::UtcTime at, double seconds) const;

 private:
  struct Tree {
    map::SitePoint middle;
    double radius_m;
  };
  struct Driver {
    map::SitePoint from;
    geo::Vector<geo::SiteFrame> way_m_s;
    double lane_m;
  };
  struct Plan;
  void draw_outline(Plan const& plan);
  void draw_rows(Plan const& plan);
  [[nodiscard]] double seen_share(TrueSlot const& slot, geo::GroundView const& view) const;
  [[nodiscard]] double taken_chance(std::size_t slot, geo::GroundView const& view, double seconds) const;
  [[nodiscard]] Corners driver_at(Driver const& driver, double seconds) const;
  /// Normal, of what it is given and nothing else.
  [[nodiscard]] double noise(std::uint64_t what, std::uint64_t a, std::uint64_t b = 0, std::uint64_t c = 0) const;
  [[nodiscard]] double chance(std::uint64_t what, std::uint64_t a, std::uint64_t b = 0, std::uint64_t c = 0) const;

  std::uint64_t seed_;
  DetectorFaults faults_;
  geo::Polygon<geo::SiteFrame> area_;
  geo::Polygon<geo::SiteFrame> fence_;
  std::vector<TrueSlot> slots_;
  std::vector<Tree> trees_;
  std::vector<Driver> drivers_;
  map::SitePoint home_;
};

}  // namespace lapwing::explore
