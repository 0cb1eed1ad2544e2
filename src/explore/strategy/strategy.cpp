#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>

#include "explore/strategy/nearest_frontier.hpp"
#include "explore/strategy/regret.hpp"
#include "explore/strategy/right_hand.hpp"
#include "explore/strategy/strategy.hpp"

namespace lapwing::explore {

namespace {

constexpr std::array names{
    StrategyName{"regret", "near ones first, and of those what it would be dear to come back for"},
    StrategyName{"tour", "the same"},
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
  if (name == "regret" || name == "tour") return std::make_unique<Regret>();
  std::vector<std::string_view> known;
  for (auto const& each : names) known.push_back(each.name);
  return base::fail(base::ErrorKind::invalid_input, fmt::format("there is no strategy `{}`", name),
                    fmt::format("there are {}", fmt::join(known, ", ")));
}

}  // namespace lapwing::explore
