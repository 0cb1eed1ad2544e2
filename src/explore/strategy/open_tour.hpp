#pragma once

#include <cstddef>
#include <vector>

namespace lapwing::explore {

/// What it costs to visit places: from the start to each, between each two, and what is saved by ending at one.
struct TourCosts {
  std::vector<double> from_start;
  std::vector<std::vector<double>> between;
  std::vector<double> end;  ///< added when the tour ends there; may be negative
};

[[nodiscard]] double cost_of(TourCosts const& costs, std::vector<std::size_t> const& tour);

/// An order of `places` that is cheap (cheapest insertion, then 2-opt and Or-opt until neither helps; Croes 1958, Or
/// 1976): within a few percent of the best for some dozens.
[[nodiscard]] std::vector<std::size_t> good_tour(TourCosts const& costs, std::vector<std::size_t> const& places);

/// The same where the first place is given.
[[nodiscard]] std::vector<std::size_t> good_tour_from(TourCosts const& costs, std::vector<std::size_t> const& places,
                                                      std::size_t first);

}  // namespace lapwing::explore
