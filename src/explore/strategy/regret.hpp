#pragma once

#include <optional>
#include <vector>

#include "explore/strategy/open_tour.hpp"
#include "explore/strategy/sites.hpp"
#include "explore/strategy/strategy.hpp"

namespace lapwing::explore {

struct RegretSettings {
  SiteSettings sites{.view_m = 0.0};
  double news_m2 = 0.5;      ///< what was chosen is kept until so much more is known
  double keep_m = 1.0;       ///< another way must be so much shorter to leave the one that was taken
  double depth_share = 0.1;  ///< of how far a site leads on: what leads far away can wait
  double apart_share = 0.3;  ///< of how far a site is from all others: what is alone is dear to come back for
  double most_apart_m = 15.0;
  double look_every_s = 3.0;  ///< by who has nothing to do: others may have shown more
};

/// Ours: near sites first as the nearest frontier has it, but decided anew as soon as what was looked for is seen; what
/// lies alone is taken while the robot is near, and what leads on waits for what does not. Several robots share the
/// sites out by auction.
class Regret : public Strategy {
 public:
  explicit Regret(RegretSettings const& settings = {}) : settings_(settings), sites_(settings.sites) {}
  [[nodiscard]] std::vector<Order> decide(Situation const& situation) override;

 private:
  struct Target {
    Site site;
    Cell watched = {};  ///< the middle of what is looked for
  };
  /// What is open, and what it costs each robot to go there.
  struct Plan {
    std::vector<Site> open;
    std::vector<std::size_t> robots;  ///< who take orders
    std::vector<TourCosts> costs;     ///< a robot of those
  };

  [[nodiscard]] bool is_due(Situation const& situation);
  [[nodiscard]] Plan plan(Situation const& situation);
  [[nodiscard]] std::size_t next_of(Situation const& situation, Plan const& plan, std::size_t robot,
                                    std::vector<std::size_t> const& mine) const;

  RegretSettings settings_;
  Sites sites_;
  double next_look_s_ = 0.0;
  std::uint64_t discovered_ = 0;                ///< of the map, when it was last decided
  std::vector<std::optional<Target>> targets_;  ///< a robot
};

}  // namespace lapwing::explore
