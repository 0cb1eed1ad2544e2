#include "vision/lot/evaluate_slots.hpp"

#include <algorithm>

namespace lapwing::vision {

namespace {

double share(double part, std::size_t whole) {
  return whole == 0 ? 0.0 : part / static_cast<double>(whole);
}

struct Pair {
  double apart_m;
  std::size_t truth;
  std::size_t found;
};

}  // namespace

double SlotFigures::precision() const {
  return share(static_cast<double>(right), found);
}

double SlotFigures::recall() const {
  return share(static_cast<double>(right), there);
}

double SlotFigures::f1() const {
  return share(2.0 * static_cast<double>(right), there + found);
}

double SlotFigures::accuracy() const {
  return share(static_cast<double>(agreed), told);
}

double SlotFigures::brier() const {
  return share(squared_error, told);
}

void add(SlotFigures& figures, std::span<JudgedSlot const> found, std::span<JudgedSlot const> truth,
         double metres_a_pixel, double within_m) {
  figures.pictures += 1;
  figures.there += truth.size();
  figures.found += found.size();
  // The nearest pairs first.
  std::vector<Pair> pairs;
  for (std::size_t t = 0; t < truth.size(); ++t) {
    for (std::size_t f = 0; f < found.size(); ++f) {
      double const apart_m = cv::norm(truth[t].middle() - found[f].middle()) * metres_a_pixel;
      if (apart_m <= within_m) pairs.push_back({apart_m, t, f});
    }
  }
  std::ranges::stable_sort(pairs, {}, &Pair::apart_m);
  std::vector<bool> is_matched(truth.size());
  std::vector<bool> is_used(found.size());
  for (auto const& pair : pairs) {
    if (is_matched[pair.truth] || is_used[pair.found]) continue;
    is_matched[pair.truth] = true;
    is_used[pair.found] = true;
    figures.right += 1;
    auto const& known = truth[pair.truth].occupied;
    auto const& chance = found[pair.found].occupied;
    if (!known) continue;
    if (!chance) {
      figures.untold += 1;
      continue;
    }
    figures.told += 1;
    figures.agreed += (*known >= 0.5) == (*chance >= 0.5) ? 1U : 0U;
    figures.squared_error += (*known - *chance) * (*known - *chance);
  }
}

}  // namespace lapwing::vision
