#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "explore/strategy/open_tour.hpp"

namespace lapwing::explore {

/// Gives each of `places` to one of the robots whose costs these are, one by one to whom it adds least to what it has
/// to drive in all (sequential auction, Lagoudakis et al. 2005). What none can reach is left out.
[[nodiscard]] std::vector<std::vector<std::size_t>> shared_out(std::span<TourCosts const> robots,
                                                               std::vector<std::size_t> places);

}  // namespace lapwing::explore
