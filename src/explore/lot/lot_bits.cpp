#include "explore/lot/lot_bits.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "explore/lot/belief.hpp"

namespace lapwing::explore {

namespace {

constexpr double worst_error = 0.45;
/// That a slot is found where one is, and not where none is, as one number.
constexpr double there_error = 0.06;

}  // namespace

double LookErrors::slot_error_at(double sampling_m) const {
  double const coarse = sampling_m / coarse_m;
  return std::min(worst_error, slot_error * (1.0 + coarse * coarse));
}

Reach::Reach(geo::Ring<geo::SiteFrame> const& ring, double edge_m) {
  Eigen::Vector2d least = Eigen::Vector2d::Constant(std::numeric_limits<double>::infinity());
  Eigen::Vector2d most = -least;
  double const turn = geo::is_counterclockwise(ring) ? 1.0 : -1.0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    auto const& a = ring[i].v;
    Eigen::Vector2d const edge = ring[(i + 1) % ring.size()].v - a;
    constexpr double shortest_m = 1e-6;
    if (edge.norm() > shortest_m) {
      Eigen::Vector2d const into = turn * Eigen::Vector2d(-edge.y(), edge.x()).normalized();
      double const from = into.dot(a) + edge_m;
      constexpr double same = 1e-9;
      if (halves_.empty() || (halves_.back().into - into).norm() > same) halves_.push_back({into, from});
    }
    corners_.push_back(a);
    least = least.cwiseMin(a);
    most = most.cwiseMax(a);
  }
  box_ = {map::SitePoint(least), map::SitePoint(most)};
}

bool Reach::contains(geo::Vector<geo::SiteFrame> const& from_camera) const {
  return std::ranges::all_of(halves_, [&](Half const& half) { return half.into.dot(from_camera.v) >= half.least; });
}

double Reach::extent_m(double way_rad) const {
  Eigen::Vector2d const way(std::cos(way_rad), std::sin(way_rad));
  double least = std::numeric_limits<double>::infinity();
  double most = -least;
  for (auto const& corner : corners_) {
    least = std::min(least, way.dot(corner));
    most = std::max(most, way.dot(corner));
  }
  return most - least;
}

LotBits::LotBits(LotMap const& lot, base::UtcTime now, bool with_age, double block_m, LookErrors const& errors)
    : now_(now), independence_(lot.settings().independence), block_m_(block_m), errors_(errors) {
  auto const box = geo::bounds(lot.area());
  origin_ = box.least;
  auto const size = box.most - box.least;
  blocks_ = DenseGrid<Block>(static_cast<int>(std::floor(size.x() / block_m)) + 1,
                             static_cast<int>(std::floor(size.y() / block_m)) + 1);
  // Who does not keep watching looks again from elsewhere, and does not wait where it is for another answer.
  if (!with_age) independence_.apart_in_time = std::chrono::hours(24 * 365);
  count_cells(lot, now, with_age);
  count_slots(lot, now, with_age);
}

void LotBits::count_cells(LotMap const& lot, base::UtcTime now, bool with_age) {
  auto const& cells = lot.cells();
  auto const& grid = cells.grid();
  double const share = lot.settings().cell_m * lot.settings().cell_m / slot_ground_m2;
  double const fresh = share * expected_bits(lot.settings().parking_share, errors_.cell_error);
  for (std::size_t i = 0; i < grid.size(); ++i) {
    auto const& cell = grid.at_index(i);
    if (!cell.is_wanted) continue;
    auto const at = cells.middle(grid.cell_of(i)) - origin_;
    auto& block = blocks_[{std::clamp(static_cast<int>(at.x() / block_m_), 0, blocks_.width() - 1),
                           std::clamp(static_cast<int>(at.y() / block_m_), 0, blocks_.height() - 1)}];
    if (!cell.is_seen) {
      block.fresh_cells += fresh;
      block.fresh_slots += share * lot.settings().parking_share;
      continue;
    }
    auto const seen_at = cells.seen_at(cell);
    double const chance = cells.parking_chance(cell, with_age ? now : std::min(now, seen_at));
    block.seen_cells += share * expected_bits(chance, errors_.cell_error);
    if (block.seen.at <= seen_at) block.seen = {.at = seen_at, .from = {cell.from_x_m, cell.from_y_m, cell.from_up_m}};
  }
}

void LotBits::count_slots(LotMap const& lot, base::UtcTime now, bool with_age) {
  for (auto const& known : lot.slots().slots()) {
    auto const* newest = known.looks.newest();
    auto const as_of = with_age || !newest ? now : std::min(now, newest->at);
    Slot slot{.middle = middle_of(known.outline),
              .taken_chance = lot.slots().taken_chance(known, as_of),
              .there_bits = expected_bits(known.there_chance(), there_error),
              .there_chance = known.there_chance(),
              .known = &known};
    auto const at = slot.middle - origin_;
    Cell const cell = {static_cast<int>(std::floor(at.x() / block_m_)),
                       static_cast<int>(std::floor(at.y() / block_m_))};
    if (!blocks_.contains(cell)) continue;
    blocks_[cell].slots.push_back(slots_.size());
    slots_.push_back(slot);
  }
}

template <class Each>
void LotBits::for_each_block(Viewpoint const& viewpoint, Each&& each) const {
  map::SitePoint const below(viewpoint.place.x(), viewpoint.place.y());
  auto const& box = viewpoint.reach->box();
  auto const cell_of = [&](double metres, double from) {
    return static_cast<int>(std::floor((metres - from) / block_m_));
  };
  int const least_x = std::max(0, cell_of(below.x() + box.least.x(), origin_.x()));
  int const least_y = std::max(0, cell_of(below.y() + box.least.y(), origin_.y()));
  int const most_x = std::min(blocks_.width() - 1, cell_of(below.x() + box.most.x(), origin_.x()));
  int const most_y = std::min(blocks_.height() - 1, cell_of(below.y() + box.most.y(), origin_.y()));
  for (int y = least_y; y <= most_y; ++y) {
    for (int x = least_x; x <= most_x; ++x) {
      map::SitePoint const middle(origin_.x() + (x + 0.5) * block_m_, origin_.y() + (y + 0.5) * block_m_);
      if (viewpoint.reach->contains(middle - below)) each(blocks_.index_of({x, y}));
    }
  }
}

double LotBits::bits_of(Block const& block, Viewpoint const& viewpoint) const {
  Look const look{.at = now_, .from = viewpoint.place};
  double bits = block.fresh_cells + block.fresh_slots * expected_bits(0.5, viewpoint.slot_error);
  if (block.seen_cells > 0.0) bits += block.seen_cells * independence_of(block.seen, look, independence_);
  for (auto const i : block.slots) {
    auto const& slot = slots_[i];
    double const of_taken = expected_bits(slot.taken_chance, viewpoint.slot_error);
    bits += slot.there_chance * of_taken * slot.known->looks.novelty_of(look, independence_);
    bits += slot.there_bits * independence_of(slot.known->seen, look, independence_);
  }
  return bits;
}

double LotBits::from(Viewpoint const& viewpoint) const {
  double bits = 0.0;
  for_each_block(viewpoint, [&](std::size_t block) { bits += bits_of(blocks_.at_index(block), viewpoint); });
  return bits;
}

void LotBits::take(Viewpoint const& viewpoint) {
  for_each_block(viewpoint, [&](std::size_t block) { blocks_.at_index(block) = {}; });
}

double LotBits::fresh_a_m2(LotSettings const& settings, LookErrors const& errors, double slot_error) {
  return (expected_bits(settings.parking_share, errors.cell_error) +
          settings.parking_share * expected_bits(0.5, slot_error)) /
         slot_ground_m2;
}

}  // namespace lapwing::explore
