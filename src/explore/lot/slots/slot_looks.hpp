#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/time.hpp"
#include "geo/point.hpp"
#include "geo/site.hpp"

namespace lapwing::explore {

/// From where and when something was looked at, and what that said: the logarithm of how many times likelier it is in
/// the one case than in the other.
struct Look {
  base::UtcTime at;
  geo::Point3<geo::SiteFrame> from = {};
  double log_likelihood = 0.0;
  std::string by = {};  ///< vehicle
  friend bool operator==(Look const&, Look const&) = default;
};

/// How far two looks tell different things. From one place a detector errs twice alike: the second look says nothing
/// new. It does from `apart_m` away or after `apart_in_time`, and in between in part.
struct Independence {
  double apart_m = 4.0;
  base::Duration apart_in_time = std::chrono::seconds(60);
};
/// From 0 (the same look again) to 1.
[[nodiscard]] double independence_of(Look const& a, Look const& b, Independence const& independence);

/// How cars come and go.
struct Turnover {
  double taken_share = 0.5;  ///< of slots, over a day
  /// After that time 1/e of what was known is left: cars stay 1.5 h on average, and slots as long without one.
  base::Duration memory = std::chrono::minutes(45);
};

/// All looks at one slot, and what follows from them at any time: a forward filter over a Markov chain of two states,
/// which looks of any number move and the time between takes back towards the share that is taken anyway.
///
/// The looks are kept in the order of time, not of arrival, so that a late one counts as if it had come in time. Only
/// the newest `most_kept` are; those before are one belief as of the last of them, and what is older than that is
/// not taken any more.
class SlotLooks {
 public:
  /// Whether it was taken.
  bool add(Look look);
  [[nodiscard]] double taken_chance(base::UtcTime now, Turnover const& turnover,
                                    Independence const& independence) const;
  /// The newest; null before the first.
  [[nodiscard]] Look const* newest() const { return looks_.empty() ? nullptr : &looks_.back(); }
  /// How much a look from there would say that was not said: 1 for the first.
  [[nodiscard]] double novelty_of(Look const& look, Independence const& independence) const;
  /// Joins the looks of what turned out to be the same slot.
  void take_in(SlotLooks const& other);
  /// Folds what is more than `most_kept`.
  void fold(Turnover const& turnover, Independence const& independence);

  static constexpr std::size_t most_kept = 24;

 private:
  struct Belief {
    double chance = 0.5;
    base::UtcTime at;
  };
  [[nodiscard]] double weight_of(std::size_t look, Independence const& independence) const;
  [[nodiscard]] Belief after(std::size_t looks, Turnover const& turnover, Independence const& independence) const;

  std::optional<Belief> before_;
  std::optional<Look> folded_;  ///< the last of those before
  std::vector<Look> looks_;
};

}  // namespace lapwing::explore
