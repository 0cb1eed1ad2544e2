#include "explore/lot/lot_cells.hpp"

#include <algorithm>
#include <cmath>

#include "explore/lot/belief.hpp"

namespace lapwing::explore {

namespace {

/// As sure as a cell gets.
constexpr float most_of_cell = 12.0F;

double normal_below(double x) {
  return 0.5 * std::erfc(-x / std::sqrt(2.0));
}

}  // namespace

/// The cells round a footprint.
struct LotCells::Window {
  Cell least;
  Cell most;

  [[nodiscard]] int width() const { return most.x - least.x + 1; }
  [[nodiscard]] bool is_empty() const { return most.x < least.x || most.y < least.y; }
  [[nodiscard]] std::size_t size() const {
    return static_cast<std::size_t>(width()) * static_cast<std::size_t>(most.y - least.y + 1);
  }
  [[nodiscard]] std::size_t index_of(Cell cell) const {
    return static_cast<std::size_t>(cell.y - least.y) * static_cast<std::size_t>(width()) +
           static_cast<std::size_t>(cell.x - least.x);
  }
};

LotCells::LotCells(geo::Polygon<geo::SiteFrame> area, LotSettings settings)
    : area_(std::move(area)), settings_(std::move(settings)) {
  auto const box = geo::bounds(area_);
  auto const cell_of = [&](double metres) { return static_cast<std::int32_t>(std::floor(metres / settings_.cell_m)); };
  corner_ = {cell_of(box.least.x()), cell_of(box.least.y())};
  Cell const last = {cell_of(box.most.x()), cell_of(box.most.y())};
  cells_ = DenseGrid<CellState>(last.x - corner_.x + 1, last.y - corner_.y + 1);
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    if (!geo::contains(area_, middle(cells_.cell_of(i)))) continue;
    cells_.at_index(i).is_wanted = true;
    ++wanted_;
  }
}

map::SitePoint LotCells::middle(Cell cell) const {
  return {(corner_.x + cell.x + 0.5) * settings_.cell_m, (corner_.y + cell.y + 0.5) * settings_.cell_m};
}

float LotCells::since_first(base::UtcTime at) const {
  return first_ ? static_cast<float>(std::chrono::duration<double>(at - *first_).count()) : 0.0F;
}

base::UtcTime LotCells::seen_at(CellState const& cell) const {
  auto const since = std::chrono::duration<double>(static_cast<double>(cell.at_s));
  return *first_ + std::chrono::duration_cast<base::UtcTime::duration>(since);
}

double LotCells::parking_chance(CellState const& cell, base::UtcTime now) const {
  double const anyway = log_odds_of(settings_.parking_share);
  if (!cell.is_seen) return settings_.parking_share;
  double const passed_s = std::max(0.0F, since_first(now) - cell.at_s);
  double const kept = std::exp(-passed_s / base::to_seconds(settings_.layout_memory));
  return chance_of(anyway + static_cast<double>(cell.log_odds) * kept);
}

double LotCells::novelty(CellState const& cell, Look const& look) const {
  if (!cell.is_seen) return 1.0;
  double const passed_s = std::abs(since_first(look.at) - cell.at_s);
  Eigen::Vector3d const from(cell.from_x_m, cell.from_y_m, cell.from_up_m);
  return std::min(1.0, (look.from.v - from).norm() / settings_.independence.apart_m +
                           passed_s / base::to_seconds(settings_.independence.apart_in_time));
}

LotCells::Window LotCells::window_of(geo::Polygon<geo::SiteFrame> const& footprint) const {
  auto const box = geo::bounds(footprint);
  auto const cell_of = [&](double metres, int corner) {
    return static_cast<std::int32_t>(std::floor(metres / settings_.cell_m)) - corner;
  };
  return {{std::max(0, cell_of(box.least.x(), corner_.x)), std::max(0, cell_of(box.least.y(), corner_.y))},
          {std::min(cells_.width() - 1, cell_of(box.most.x(), corner_.x)),
           std::min(cells_.height() - 1, cell_of(box.most.y(), corner_.y))}};
}

/// Adds the chance that each cell's middle lies within the outline, which may be off by `sigma_m` and is there with the
/// chance `surety`.
void LotCells::spread(Window const& window, Corners const& outline, double sigma_m, double surety,
                      std::vector<float>& onto) const {
  constexpr double reach = 3.0;
  auto box = geo::bounds(geo::Polygon<geo::SiteFrame>{{{outline.begin(), outline.end()}}});
  auto const margin = geo::Vector<geo::SiteFrame>(reach * sigma_m, reach * sigma_m);
  box = {box.least - margin, box.most + margin};
  auto const part = window_of(geo::Polygon<geo::SiteFrame>{
      {{box.least, {box.most.x(), box.least.y()}, box.most, {box.least.x(), box.most.y()}}}});
  for (int y = std::max(part.least.y, window.least.y); y <= std::min(part.most.y, window.most.y); ++y) {
    for (int x = std::max(part.least.x, window.least.x); x <= std::min(part.most.x, window.most.x); ++x) {
      auto& chance = onto[window.index_of({x, y})];
      double const inside = normal_below(inside_by_m(outline, middle({x, y})) / sigma_m);
      chance = std::min(1.0F, chance + static_cast<float>(surety * inside));
    }
  }
}

bool LotCells::learn(CellState& cell, double log_likelihood, Look const& look) {
  double const novel = novelty(cell, look);
  if (novel < least_novelty) return false;
  float const now_s = since_first(look.at);
  double const memory_s = base::to_seconds(settings_.layout_memory);
  double added = novel * log_likelihood;
  // Whichever of the two is older has faded by the time of the other.
  if (cell.is_seen && now_s < cell.at_s)
    added *= std::exp((now_s - cell.at_s) / memory_s);
  else
    cell.log_odds = static_cast<float>(cell.log_odds * std::exp((cell.at_s - now_s) / memory_s));
  cell.log_odds = std::clamp(static_cast<float>(cell.log_odds + added), -most_of_cell, most_of_cell);
  if (!cell.is_seen && cell.is_wanted) ++seen_;
  if (!cell.is_seen || now_s >= cell.at_s) {
    cell.at_s = now_s;
    cell.from_x_m = static_cast<float>(look.from.x());
    cell.from_y_m = static_cast<float>(look.from.y());
    cell.from_up_m = static_cast<float>(look.from.z());
  }
  cell.is_seen = true;
  return true;
}

std::vector<Cell> LotCells::add(LotSight const& sight, geo::Polygon<geo::SiteFrame> const& footprint,
                                std::vector<Corners> const& standing) {
  std::vector<Cell> learned;
  if (!first_) first_ = sight.at;
  auto const window = window_of(footprint);
  if (window.is_empty()) return learned;
  std::vector<float> slots(window.size(), 0.0F);
  std::vector<float> cars(window.size(), 0.0F);
  std::vector<float> stand(window.size(), 0.0F);
  for (auto const& slot : sight.slots)
    spread(window, slot.outline, ground_doubt_m(sight, middle_of(slot.outline)), slot.surety, slots);
  for (auto const& car : sight.cars)
    spread(window, car.outline, ground_doubt_m(sight, middle_of(car.outline)), 1.0, cars);
  for (auto const& car : standing) spread(window, car, sight.doubt.position_m, 1.0, stand);

  Look const look{.at = sight.at, .from = sight.view.site_from_camera.origin()};
  double const when_found = chance_of(std::log(settings_.found_share / settings_.false_share));
  double const when_not = chance_of(std::log((1.0 - settings_.found_share) / (1.0 - settings_.false_share)));
  constexpr float some = 0.02F;
  constexpr float mostly = 0.5F;
  for (int y = window.least.y; y <= window.most.y; ++y) {
    for (int x = window.least.x; x <= window.most.x; ++x) {
      auto& cell = cells_[{x, y}];
      auto const place = middle({x, y});
      if (!cell.is_wanted || !geo::contains(footprint, place)) continue;
      auto const i = window.index_of({x, y});
      double chance = when_not;
      if (slots[i] > some) {
        chance = slots[i] * when_found + (1.0 - slots[i]) * when_not;
      } else if (stand[i] > mostly) {
        chance = settings_.standing_chance;
      } else if (cars[i] > mostly || geo::distance_to_edge_m(footprint, place) < settings_.edge_m) {
        continue;  // a car hides the ground, and passes perhaps; and near the edge a slot may be cut off
      }
      if (learn(cell, log_odds_of(chance), look)) learned.push_back({x, y});
    }
  }
  return learned;
}

}  // namespace lapwing::explore
