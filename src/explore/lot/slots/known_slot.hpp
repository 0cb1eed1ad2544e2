#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "explore/lot/lot_sight.hpp"
#include "explore/lot/slots/slot_looks.hpp"

namespace lapwing::explore {

/// A slot as one picture showed it.
struct SlotFind {
  std::size_t picture = 0;  ///< its number in the block
  Corners in_picture = {};  ///< where the picture lay when it came
  double weight = 0.0;      ///< 1 / sigma^2 of what the detector errs, less for what other pictures told already
};

/// One place to park, as all pictures together tell it.
struct KnownSlot {
  std::string id;
  Corners outline = {};         ///< the weighted mean of `fixed` and all finds, each as its picture lies now
  std::vector<SlotFind> finds;  ///< of pictures that may still move
  Corners fixed = {};           ///< of those that do not any more, and of the map before
  double fixed_weight = 0.0;    ///< 0: there are none
  Corners told = {};            ///< the outline that was on the map last
  double there_log_odds = 0.0;  ///< that it is one
  SlotLooks looks = {};         ///< whether it is taken
  Look seen = {};               ///< when it was wholly in a picture last, found or not
  bool is_confirmed = false;    ///< on the map

  [[nodiscard]] double there_chance() const;
  /// Of its outline: the sum over `fixed` and all finds.
  [[nodiscard]] double weight() const;
  /// From now on a place of that weight belongs to what does not move. `corners` are aligned to the outline.
  void fix(Corners const& corners, double weight);
};

}  // namespace lapwing::explore
