#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>

#include "explore/strategy/nearest_frontier.hpp"
#include "explore/strategy/right_hand.hpp"
#include "explore/strategy/strategy.hpp"
#include "explore/strategy/tour.hpp"

namespace lapwing::explore {

namespace {

constexpr std::array names{
    StrategyName{"tour", "a route over all open frontiers, made anew with every news"},
    StrategyName{"nearest", "the nearest frontier by its way, as explore_lite chooses"},
    StrategyName{"frontier", "the same"},
    StrategyName{"right-hand", "along the right wall, side halls later (seed 001)"},
};

}  // namespace

std::span<StrategyName const> strategy_names() {
  return names;
}

base::Result<std::unique_ptr<Strategy>> make_strategy(std::string_view name) {
  if (name == "nearest" || name == "frontier") return std::make_unique<NearestFrontier>();
  if (name == "right-hand") return std::make_unique<RightHand>();
  if (name == "tour") return std::make_unique<Tour>();
  std::vector<std::string_view> known;
  for (auto const& each : names) known.push_back(each.name);
  return base::fail(base::ErrorKind::invalid_input, fmt::format("there is no strategy `{}`", name),
                    fmt::format("there are {}", fmt::join(known, ", ")));
}

}  // namespace lapwing::explore
