#include "explore/strategy/open_tour.hpp"

#include <algorithm>
#include <limits>

namespace lapwing::explore {

namespace {

using Sequence = std::vector<std::size_t>;

constexpr double worth_it = 1e-6;
constexpr auto nobody = std::numeric_limits<std::size_t>::max();

/// From what stands before position `at` of the tour to `place`.
double into(TourCosts const& costs, Sequence const& tour, std::size_t at, std::size_t place) {
  return at == 0 ? costs.from_start[place] : costs.between[tour[at - 1]][place];
}

double added_by(TourCosts const& costs, Sequence const& tour, std::size_t at, std::size_t place) {
  double const there = into(costs, tour, at, place);
  if (at == tour.size()) return there + costs.end[place] - (tour.empty() ? 0.0 : costs.end[tour.back()]);
  return there + costs.between[place][tour[at]] - into(costs, tour, at, tour[at]);
}

void insert_cheapest(TourCosts const& costs, Sequence& tour, Sequence open, std::size_t kept) {
  while (!open.empty()) {
    std::size_t best = 0;
    std::size_t best_at = 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < open.size(); ++i) {
      for (std::size_t at = kept; at <= tour.size(); ++at) {
        double const added = added_by(costs, tour, at, open[i]);
        if (added >= least) continue;
        least = added;
        best = i;
        best_at = at;
      }
    }
    tour.insert(tour.begin() + static_cast<std::ptrdiff_t>(best_at), open[best]);
    open.erase(open.begin() + static_cast<std::ptrdiff_t>(best));
  }
}

/// Turns pieces around while that makes it shorter.
bool turn_pieces(TourCosts const& costs, Sequence& tour, std::size_t kept) {
  bool has_changed = false;
  for (std::size_t i = kept; i + 1 < tour.size(); ++i) {
    for (std::size_t j = i + 1; j < tour.size(); ++j) {
      bool const is_last = j + 1 == tour.size();
      double const before =
          into(costs, tour, i, tour[i]) + (is_last ? costs.end[tour[j]] : costs.between[tour[j]][tour[j + 1]]);
      double const after =
          into(costs, tour, i, tour[j]) + (is_last ? costs.end[tour[i]] : costs.between[tour[i]][tour[j + 1]]);
      if (after >= before - worth_it) continue;
      std::reverse(tour.begin() + static_cast<std::ptrdiff_t>(i), tour.begin() + static_cast<std::ptrdiff_t>(j) + 1);
      has_changed = true;
    }
  }
  return has_changed;
}

/// The way from one place to the next; nobody before it is the start, nobody after it the end.
double leg(TourCosts const& costs, std::size_t from, std::size_t to) {
  if (from == nobody) return to == nobody ? 0.0 : costs.from_start[to];
  return to == nobody ? costs.end[from] : costs.between[from][to];
}

/// A piece of a tour, and where it would go in the rest.
struct Move {
  std::size_t begin = 0;
  std::size_t length = 0;
  std::size_t at = 0;
  bool is_turned = false;
};

bool saves(TourCosts const& costs, Sequence const& tour, Move& move) {
  std::size_t const i = move.begin;
  std::size_t const length = move.length;
  auto const rest = [&](std::size_t at) -> std::size_t {
    if (at >= tour.size() - length) return nobody;
    return at < i ? tour[at] : tour[at + length];
  };
  auto const first = tour[i];
  auto const last = tour[i + length - 1];
  auto const before = i == 0 ? nobody : tour[i - 1];
  auto const after = rest(i);
  double const saved = leg(costs, before, first) + leg(costs, last, after) - leg(costs, before, after);
  auto const a = move.at == 0 ? nobody : rest(move.at - 1);
  auto const b = rest(move.at);
  double const between = leg(costs, a, b);
  double const straight = leg(costs, a, first) + leg(costs, last, b) - between;
  double const turned = leg(costs, a, last) + leg(costs, first, b) - between;
  move.is_turned = turned < straight;
  return std::min(straight, turned) < saved - worth_it;
}

void make(Sequence& tour, Move const& move) {
  auto const begin = tour.begin() + static_cast<std::ptrdiff_t>(move.begin);
  Sequence piece(begin, begin + static_cast<std::ptrdiff_t>(move.length));
  if (move.is_turned) std::ranges::reverse(piece);
  tour.erase(begin, begin + static_cast<std::ptrdiff_t>(move.length));
  tour.insert(tour.begin() + static_cast<std::ptrdiff_t>(move.at), piece.begin(), piece.end());
}

/// Takes up to three places that follow one another elsewhere.
bool move_pieces(TourCosts const& costs, Sequence& tour, std::size_t kept) {
  bool has_changed = false;
  for (std::size_t length = 1; length <= 3; ++length) {
    for (std::size_t i = kept; i + length <= tour.size(); ++i) {
      for (std::size_t at = kept; at + length <= tour.size(); ++at) {
        Move move{i, length, at};
        if (at == i || !saves(costs, tour, move)) continue;
        make(tour, move);
        has_changed = true;
      }
    }
  }
  return has_changed;
}

Sequence improved(TourCosts const& costs, Sequence tour, std::size_t kept) {
  constexpr int most_rounds = 30;
  for (int round = 0; round < most_rounds; ++round) {
    bool const has_turned = turn_pieces(costs, tour, kept);
    if (!move_pieces(costs, tour, kept) && !has_turned) break;
  }
  return tour;
}

}  // namespace

double cost_of(TourCosts const& costs, Sequence const& tour) {
  if (tour.empty()) return 0.0;
  double cost = costs.from_start[tour.front()] + costs.end[tour.back()];
  for (std::size_t i = 1; i < tour.size(); ++i) cost += costs.between[tour[i - 1]][tour[i]];
  return cost;
}

Sequence good_tour(TourCosts const& costs, Sequence const& places) {
  Sequence tour;
  insert_cheapest(costs, tour, places, 0);
  return improved(costs, std::move(tour), 0);
}

Sequence good_tour_from(TourCosts const& costs, Sequence const& places, std::size_t first) {
  Sequence tour = {first};
  Sequence open = places;
  std::erase(open, first);
  insert_cheapest(costs, tour, std::move(open), 1);
  return improved(costs, std::move(tour), 1);
}

}  // namespace lapwing::explore
