#include "explore/lot/slots/first_shift.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace lapwing::explore {

namespace {

using Move = Eigen::Vector2d;

/// A known slot that one in the picture may be.
struct Candidate {
  Move move;  ///< from the one in the picture
  double half_width_m;
  double agrees;  ///< of their cars: log of how much likelier than by chance
};

/// Of each slot in the picture.
using Candidates = std::vector<std::vector<Candidate>>;

double log_agreement(double a, double b) {
  constexpr double least = 0.05;  // cars come and go, and detectors err
  return std::log(std::max(least, 2.0 * (a * b + (1.0 - a) * (1.0 - b))));
}

Candidates candidates(LotSight const& sight, std::span<SlotGuess const> slots, double farthest_m) {
  Candidates all;
  for (auto const& found : sight.slots) {
    auto const middle = middle_of(found.outline);
    double const taken = found.taken_chance.value_or(0.5);
    auto& near = all.emplace_back();
    for (auto const& slot : slots) {
      Move const move = slot.middle.v - middle.v;
      if (move.norm() < farthest_m + slot.half_width_m)
        near.push_back({move, slot.half_width_m, log_agreement(taken, slot.taken_chance)});
    }
  }
  return all;
}

/// Of one slot in the picture that is moved: up to 1 where one lies there, and whether their cars agree.
double fit_of(std::vector<Candidate> const& near, Move const& move) {
  double best = 0.0;
  for (auto const& slot : near) {
    double const off2 = (slot.move - move).squaredNorm() / (slot.half_width_m * slot.half_width_m);
    if (off2 < 1.0) best = std::max(best, 1.0 - off2 + slot.agrees);
  }
  return best;
}

}  // namespace

PictureShift first_shift(LotSight const& sight, std::span<SlotGuess const> slots, PictureShift const& last) {
  double const sigma_m = expected_shift(sight)[0];
  constexpr double farthest_sigmas = 3.0;
  Move const before = last.v.head<2>();
  auto const near = candidates(sight, slots, farthest_sigmas * sigma_m + before.norm());
  auto const score = [&](Move const& move) {
    double sum = -move.squaredNorm() / (2.0 * sigma_m * sigma_m);
    for (auto const& found : near) sum += fit_of(found, move);
    return sum;
  };
  Move best = before;
  double most = score(before);
  auto const consider = [&](Move const& move) {
    if (double const now = score(move); now > most) {
      most = now;
      best = move;
    }
  };
  consider(Move::Zero());
  for (auto const& found : near)
    for (auto const& slot : found) consider(slot.move);
  PictureShift shift;
  shift.v.head<2>() = best;
  return shift;
}

}  // namespace lapwing::explore
