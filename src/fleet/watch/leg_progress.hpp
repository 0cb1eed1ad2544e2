#pragma once

#include <optional>

#include "base/time.hpp"
#include "fleet/watch/legs.hpp"
#include "geo/position.hpp"

namespace lapwing::fleet {

/// Whether a vehicle gets on with its mission: by a new item, by coming nearer to the place of the present one, by
/// another height where that is what the item is about, by moving at all where it goes round. Time counts by positions
/// that are heard: in silence nobody knows.
class LegProgress {
 public:
  /// The legs outlive it.
  explicit LegProgress(Legs const& legs) : legs_(legs) {}

  /// The vehicle is at this item.
  void note_item(int seq);
  /// It has got on by some other sign.
  void note_progress();
  /// A position was heard, `since_last` after the one before.
  void note(geo::Wgs84 place, base::Duration since_last);

  [[nodiscard]] int seq() const { return seq_; }
  /// For how long it has not got on.
  [[nodiscard]] base::Duration stalled_for() const { return stalled_for_; }
  /// How long it may be so at this item; nothing: for ever.
  [[nodiscard]] std::optional<base::Duration> patience() const { return patience_; }

 private:
  [[nodiscard]] bool gets_on(geo::Wgs84 place) const;
  void begin_anew(geo::Wgs84 place);

  Legs const& legs_;
  int seq_ = 0;
  bool is_new_ = true;                ///< the item, or the sign
  std::optional<geo::Wgs84> anchor_;  ///< where it got on last
  base::Duration stalled_for_{};
  std::optional<base::Duration> patience_;
};

}  // namespace lapwing::fleet
