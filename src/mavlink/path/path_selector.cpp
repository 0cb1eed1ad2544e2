#include "mavlink/path/internal/path_selector.hpp"

#include <algorithm>

namespace lapwing::mavlink::internal {

namespace {

using namespace std::chrono_literals;

double constexpr clearly_better = 0.6;
base::Duration constexpr settles = 3s;

}  // namespace

void PathSelector::consider(std::span<Candidate const> candidates, base::TimePoint now) {
  auto const best = std::ranges::min_element(candidates, {}, &Candidate::cost_s);
  if (best == candidates.end()) return;
  auto const held = std::ranges::find(candidates, current_, [](Candidate const& c) { return std::optional(c.peer); });
  if (held == candidates.end()) {
    current_ = best->peer;
    challenger_.reset();
    return;
  }
  if (best->cost_s > clearly_better * held->cost_s) {
    challenger_.reset();
    return;
  }
  if (challenger_ != best->peer) {
    challenger_ = best->peer;
    challenged_ = now;
  }
  if (now - challenged_ < settles) return;
  current_ = best->peer;
  challenger_.reset();
}

}  // namespace lapwing::mavlink::internal
