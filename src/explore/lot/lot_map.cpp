#include "explore/lot/lot_map.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "explore/lot/belief.hpp"

namespace lapwing::explore {

namespace {

/// 500 m by 500 m in cells of half a metre.
constexpr double most_cells = 1e6;
/// From there on a slot is called free or taken.
constexpr double told_from = 0.65;

map::SlotState state_of(double taken_chance) {
  if (taken_chance >= told_from) return map::SlotState::taken;
  return taken_chance <= 1.0 - told_from ? map::SlotState::free : map::SlotState::unknown;
}

bool is_share(double value) {
  return value > 0.0 && value < 1.0;
}

std::optional<std::string> settings_fault(LotSettings const& settings) {
  if (!(settings.cell_m >= 0.05 && settings.cell_m <= 5.0))
    return fmt::format("cells of {} m are no map: 0.05 to 5 m are", settings.cell_m);
  for (double const metres : {settings.farthest_m, settings.coarsest_m, settings.independence.apart_m})
    if (!(metres > 0.0) || !std::isfinite(metres)) return fmt::format("a distance of {} m is not above 0", metres);
  for (double const share : {settings.found_share, settings.false_share, settings.least_error, settings.detector_prior,
                             settings.parking_share, settings.slot_prior, settings.confirmed, settings.forgotten,
                             settings.standing_chance, settings.turnover.taken_share})
    if (!is_share(share)) return fmt::format("a chance of {} is not between 0 and 1", share);
  if (settings.turnover.memory <= base::Duration::zero() || settings.layout_memory <= base::Duration::zero())
    return "what is forgotten at once cannot be mapped: a memory is not above 0 s";
  return std::nullopt;
}

}  // namespace

base::Result<LotMap> LotMap::make(geo::Polygon<geo::SiteFrame> area, LotSettings settings) {
  using base::ErrorKind;
  if (auto const fault = geo::polygon_fault(area))
    return base::fail(ErrorKind::invalid_input, fmt::format("the area to be mapped is none: {}", *fault));
  if (auto const fault = settings_fault(settings)) return base::fail(ErrorKind::invalid_input, *fault);
  auto const box = geo::bounds(area);
  auto const size = box.most - box.least;
  if (size.x() * size.y() > most_cells * settings.cell_m * settings.cell_m)
    return base::fail(ErrorKind::invalid_input,
                      fmt::format("an area of {:.0f} m by {:.0f} m has more cells of {} m than the million that a map "
                                  "of a car park holds",
                                  size.x(), size.y(), settings.cell_m),
                      "map parts of it, or with larger cells");
  return LotMap(std::move(area), settings);
}

LotMap::LotMap(geo::Polygon<geo::SiteFrame> area, LotSettings const& settings)
    : area_(std::move(area)),
      settings_(settings),
      cells_(area_, settings),
      slots_(settings),
      cars_(settings),
      parking_(settings.cell_m) {}

geo::Polygon<geo::SiteFrame> well_seen_ground(geo::GroundView const& view, LotSettings const& settings) {
  double const height_m = view.height_m();
  double const focal_px = std::min(view.lens.focal_x_px, view.lens.focal_y_px);
  // A pixel on the ray at distance d aside measures (h^2 + d^2) / (h f) along it, for a camera that looks there.
  double const reach2_m2 = height_m * focal_px * settings.coarsest_m - height_m * height_m;
  if (height_m <= 0.0 || reach2_m2 <= 0.0) return {};
  auto outline = geo::footprint(view, std::min(settings.farthest_m, std::sqrt(reach2_m2)));
  if (outline.empty()) return {};
  return {{std::move(outline)}};
}

bool LotMap::add(LotSight const& told) {
  auto const placed = slots_.placed(told);
  auto const& sight = placed.sight;
  auto const footprint = well_seen_ground(sight.view, settings_);
  if (footprint.rings.empty() || !geo::bounds(footprint).meets(geo::bounds(area_))) return false;
  slots_.add(placed, footprint);
  cars_.add(sight, footprint);
  auto const learned = cells_.add(sight, footprint, cars_.standing());
  for (auto const cell : learned) {
    Cell const in_site = cell + cells_.corner();
    double const chance = cells_.parking_chance(cells_.grid()[cell], sight.at);
    parking_.set(in_site, map::Evidence::of_probability(chance));
    tiles_.insert(map::tile_of(in_site));
  }
  return true;
}

double LotMap::coverage() const {
  return cells_.wanted() == 0 ? 1.0 : static_cast<double>(cells_.seen()) / static_cast<double>(cells_.wanted());
}

double LotMap::unknown_bits(base::UtcTime now) const {
  double bits = 0.0;
  double const share = settings_.cell_m * settings_.cell_m / slot_ground_m2;
  auto const& grid = cells_.grid();
  for (std::size_t i = 0; i < grid.size(); ++i)
    if (auto const& cell = grid.at_index(i); cell.is_wanted)
      bits += share * entropy_bits(cells_.parking_chance(cell, now));
  for (auto const& slot : slots_.slots()) bits += slot.there_chance() * entropy_bits(slots_.taken_chance(slot, now));
  return bits;
}

bool LotMap::is_in_lot(map::SitePoint const& place, base::UtcTime now, double reach_m) const {
  if (!geo::contains(area_, place)) return false;
  constexpr double likely = 0.7;
  bool has_parking = false;
  auto const& grid = cells_.grid();
  for (std::size_t i = 0; i < grid.size(); ++i) {
    auto const& cell = grid.at_index(i);
    if (!cell.is_seen || cells_.parking_chance(cell, now) < likely) continue;
    if (geo::distance_m(cells_.middle(grid.cell_of(i)), place) <= reach_m) return true;
    has_parking = true;
  }
  return !has_parking;
}

map::Feature LotMap::feature_of(KnownSlot const& slot, LotAddress const& address) const {
  map::Slot content{.outline = {{{slot.outline.begin(), slot.outline.end()}}}};
  auto at = slot.seen.at;
  if (auto const* look = slot.looks.newest()) {
    content.taken_probability = slots_.taken_chance(slot, look->at);
    content.state = state_of(*content.taken_probability);
    content.seen_at = look->at;
    content.seen_by = look->by;
    at = std::max(at, look->at);
  }
  return {.id = slot.id,
          .site = address.site,
          .floor = address.floor,
          .account = {.writer = address.writer, .at = at},
          .content = std::move(content)};
}

LotNews LotMap::take_news(LotAddress const& address) {
  LotNews news;
  auto const changed = slots_.take_changed();
  for (auto const& slot : slots_.slots())
    if (changed.contains(slot.id)) news.slots.push_back(feature_of(slot, address));
  auto gone = slots_.take_gone();
  news.gone.assign(gone.begin(), gone.end());
  news.tiles.assign(tiles_.begin(), tiles_.end());
  tiles_.clear();
  return news;
}

LotOccupancy LotMap::occupancy(base::UtcTime now) const {
  auto const& grid = cells_.grid();
  LotOccupancy occupancy{.origin = {cells_.corner().x * settings_.cell_m, cells_.corner().y * settings_.cell_m},
                         .resolution_m = settings_.cell_m,
                         .width = grid.width(),
                         .height = grid.height(),
                         .cells = std::vector<std::int8_t>(grid.size(), -1)};
  constexpr double percent = 100.0;
  constexpr double likely = 0.5;
  for (std::size_t i = 0; i < grid.size(); ++i) {
    auto const& cell = grid.at_index(i);
    double const parking = cells_.parking_chance(cell, now);
    if (cell.is_wanted && cell.is_seen && parking < likely)
      occupancy.cells[i] = static_cast<std::int8_t>(std::lround(percent * (1.0 - parking)));
  }
  for (auto const& slot : slots_.slots()) {
    if (!slot.is_confirmed || !slot.looks.newest()) continue;
    auto const shade = static_cast<std::int8_t>(std::lround(percent * slots_.taken_chance(slot, now)));
    auto const box = geo::bounds(geo::Polygon<geo::SiteFrame>{{{slot.outline.begin(), slot.outline.end()}}});
    auto const cell_of = [&](double metres, int corner) {
      return static_cast<std::int32_t>(std::floor(metres / settings_.cell_m)) - corner;
    };
    for (int y = cell_of(box.least.y(), cells_.corner().y); y <= cell_of(box.most.y(), cells_.corner().y); ++y)
      for (int x = cell_of(box.least.x(), cells_.corner().x); x <= cell_of(box.most.x(), cells_.corner().x); ++x)
        if (grid.contains({x, y}) && inside_by_m(slot.outline, cells_.middle({x, y})) >= 0.0)
          occupancy.cells[grid.index_of({x, y})] = shade;
  }
  return occupancy;
}

}  // namespace lapwing::explore
