#pragma once

#include <functional>
#include <map>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "explore/lot/lot_settings.hpp"
#include "explore/lot/slots/first_shift.hpp"
#include "explore/lot/slots/known_slot.hpp"
#include "explore/lot/slots/picture_block.hpp"
#include "geo/polygon.hpp"

namespace lapwing::explore {

/// The slots of a car park: finds of several pictures that are the same slot become one. Two are the same when their
/// middles are less than half its width apart and their axes less than 30 degrees. A slot keeps its id as long as it is
/// there; when two turn out to be the same, the older id stays.
///
/// A picture is laid onto the slots that are known before it is added, and all are settled together after it: drones
/// know their place to some decimetres, pictures fit to each other within a few centimetres.
class SlotBook {
 public:
  explicit SlotBook(LotSettings settings) : settings_(std::move(settings)) {}

  /// One that somebody else knows, by the id that it has there.
  void know(std::string id, Corners const& outline);
  /// The picture as it lies on the slots that are known so far.
  [[nodiscard]] PlacedSight placed(LotSight const& sight) const;
  /// `footprint`: what of the ground the picture shows well enough, as it lies.
  void add(PlacedSight const& placed, geo::Polygon<geo::SiteFrame> const& footprint);

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
  /// How a vehicle's last picture lay.
  struct LastShift {
    base::UtcTime at;
    PictureShift shift;
  };
  /// A picture that is being added.
  struct Added {
    LotSight const& sight;
    std::size_t number;  ///< in the block
    bool tells_places = false;
  };
  [[nodiscard]] std::vector<Pair> pairs(LotSight const& sight) const;
  [[nodiscard]] std::vector<Tie> ties(LotSight const& told, PictureShift const& shift) const;
  /// To earlier pictures, by what both show.
  [[nodiscard]] std::vector<Tie> ground_ties(LotSight const& told) const;
  [[nodiscard]] std::vector<SlotGuess> guesses(base::UtcTime now) const;
  [[nodiscard]] PictureShift last_shift(LotSight const& sight) const;
  void found(KnownSlot& slot, Added& added, SlotSight const& as, double novelty);
  void begin(Added& added, SlotSight const& as);
  void tell_moved();
  void judge(KnownSlot& slot);
  void join_doubles();
  void drop(std::size_t index);

  LotSettings settings_;
  PictureBlock block_;
  std::vector<KnownSlot> slots_;
  std::map<std::string, LastShift, std::less<>> last_;  ///< by vehicle
  std::set<std::string> changed_;
  std::set<std::string> gone_;
  std::size_t next_ = 1;
};

}  // namespace lapwing::explore
