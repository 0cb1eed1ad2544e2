#pragma once

#include <set>
#include <string>
#include <vector>

#include "explore/lot/lot_settings.hpp"
#include "explore/lot/lot_sight.hpp"
#include "geo/polygon.hpp"

namespace lapwing::explore {

/// One place to park, as all pictures together tell it.
struct KnownSlot {
  std::string id;
  Corners outline;              ///< the mean of all sights, each by how sure the camera's place was
  double there_log_odds = 0.0;  ///< that it is one
  double weight = 0.0;          ///< of the outline: the sum of 1 / sigma^2
  SlotLooks looks = {};         ///< whether it is taken
  Look seen = {};               ///< when it was wholly in a picture last, found or not
  bool is_confirmed = false;    ///< on the map

  [[nodiscard]] double there_chance() const;
};

/// The slots of a car park: finds of several pictures that are the same slot become one. Two are the same when their
/// middles are less than half its width apart and their axes less than 30 degrees. A slot keeps its id as long as it is
/// there; when two turn out to be the same, the older id stays.
class SlotBook {
 public:
  explicit SlotBook(LotSettings settings) : settings_(std::move(settings)) {}

  /// One that somebody else knows, by the id that it has there.
  void know(std::string id, Corners const& outline);
  /// `footprint`: what of the ground the picture shows well enough.
  void add(LotSight const& sight, geo::Polygon<geo::SiteFrame> const& footprint);

  [[nodiscard]] std::vector<KnownSlot> const& slots() const { return slots_; }
  [[nodiscard]] double taken_chance(KnownSlot const& slot, base::UtcTime now) const;
  /// Ids of confirmed slots of which something has changed since this was asked last, and of those that are gone.
  [[nodiscard]] std::set<std::string> take_changed() { return std::exchange(changed_, {}); }
  [[nodiscard]] std::set<std::string> take_gone() { return std::exchange(gone_, {}); }

 private:
  struct Pair {
    double apart_m;
    std::size_t slot;
    std::size_t found;
  };
  [[nodiscard]] bool is_same(Corners const& a, Corners const& b) const;
  [[nodiscard]] std::vector<Pair> pairs(LotSight const& sight) const;
  void found(KnownSlot& slot, LotSight const& sight, SlotSight const& as, double novelty);
  void begin(LotSight const& sight, SlotSight const& as);
  void judge(KnownSlot& slot);
  void join_doubles();
  void drop(std::size_t index);

  LotSettings settings_;
  std::vector<KnownSlot> slots_;
  std::set<std::string> changed_;
  std::set<std::string> gone_;
  std::size_t next_ = 1;
};

}  // namespace lapwing::explore
