#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>

#include "explore/strategy/nearest_frontier.hpp"
#include "explore/strategy/strategy.hpp"

namespace lapwing::explore {

namespace {

constexpr std::array names{
    StrategyName{"nearest", "the nearest frontier by its way, as explore_lite chooses"},
    StrategyName{"frontier", "the same"},
};

}  // namespace

std::span<StrategyName const> strategy_names() {
  return names;
}

base::Result<std::unique_ptr<Strategy>> make_strategy(Settings const& settings) {
  if (settings.strategy == "nearest" || settings.strategy == "frontier") return std::make_unique<NearestFrontier>();
  std::vector<std::string_view> known;
  for (auto const& name : names) known.push_back(name.name);
  return base::fail(base::ErrorKind::invalid_input, fmt::format("there is no strategy `{}`", settings.strategy),
                    fmt::format("there are {}", fmt::join(known, ", ")));
}

}  // namespace lapwing::explore
