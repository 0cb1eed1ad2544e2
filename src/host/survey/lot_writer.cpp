#include "host/survey/lot_writer.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

#include "map/features/feature_json.hpp"

namespace lapwing::host {

namespace {

constexpr auto site_id = "default";

/// Percent, of which 0 and 100 are no certainties: the map adds up what it is told.
::lapwing::map::Evidence evidence_of(std::int8_t percent) {
  constexpr double surest = 0.98;
  if (percent < 0) return {};
  return ::lapwing::map::Evidence::of_probability(std::clamp(percent / 100.0, 1.0 - surest, surest));
}

}  // namespace

void LotWriter::note_origin(autonomy::report::Heartbeat const& heartbeat) {
  if (!heartbeat.position || !heartbeat.local) return;
  if (!map_.site(site_id)) {
    auto site = geo::Site::make(site_id, *heartbeat.position);
    if (!site) return;
    map_.put_site(*std::move(site));
  }
  auto const here = map_.site(site_id)->point_of(*heartbeat.position);
  geo::Point<geo::SiteFrame> const origin(here.x() - heartbeat.local->x(), here.y() - heartbeat.local->y());
  if (origin_ && distance_m(*origin_, origin) <= moved_m) return;
  origin_ = origin;
  shown_.reset();
}

base::Result<> LotWriter::take(autonomy::report::Heartbeat const& heartbeat, base::UtcTime at) {
  note_origin(heartbeat);
  if (heartbeat.map) return take(*heartbeat.map, at);
  auto const waiting = std::exchange(waiting_, std::nullopt);
  return waiting ? take(*waiting, at) : base::Result<>();
}

base::Result<> LotWriter::take(autonomy::OccupancyMap const& told, base::UtcTime at) {
  waiting_.reset();
  if (origin_) return put_grid(told, at);
  waiting_ = told;
  return {};
}

base::Result<> LotWriter::put_grid(autonomy::OccupancyMap const& told, base::UtcTime at) {
  bool const is_anew = !shown_ || !is_alike(*shown_, told);
  geo::Vector<geo::SiteFrame> const corner(told.origin.x(), told.origin.y());
  ::lapwing::map::OccupancyGrid grid(told.resolution_m, {*origin_ + corner, 0.0});
  std::set<::lapwing::map::TileKey> changed;
  for (std::size_t i = 0; i < told.cells.size(); ++i) {
    ::lapwing::map::Cell const cell{static_cast<std::int32_t>(i % told.columns),
                                    static_cast<std::int32_t>(i / told.columns)};
    if (told.cells[i] >= 0) grid.set(cell, evidence_of(told.cells[i]));
    if (is_anew ? told.cells[i] >= 0 : told.cells[i] != shown_->cells[i]) changed.insert(tile_of(cell));
  }
  if (changed.empty()) return {};
  auto const put = map_.put_tiles({.site = site_id, .floor = {}, .name = drone_ + " parking"}, grid,
                                  {changed.begin(), changed.end()}, {.writer = drone_, .at = at});
  if (!put) return std::unexpected(put.error());
  shown_ = told;
  return {};
}

base::Result<> LotWriter::take(autonomy::report::Slots const& told, base::UtcTime at) {
  auto const* const site = map_.site(site_id);
  if (!site) return base::fail(base::ErrorKind::not_found, "nothing says yet where on the globe the drone is");
  // Whatever the drone calls its site: where it lies on the globe counts.
  auto read = ::lapwing::map::read_features(
      told.features, ::lapwing::map::LayerKind::slots, [site](std::string_view) { return site; },
      {.id = {}, .site = site_id, .floor = {}, .account = {.writer = drone_, .at = at}});
  if (!read) return std::unexpected(read.error());
  std::set<std::string> known;
  for (auto& feature : *read) {
    feature.id = id_of(feature.id);
    feature.site = site_id;
    feature.account.writer = drone_;
    std::get<::lapwing::map::Slot>(feature.content).seen_by = drone_;
    known.insert(feature.id);
  }
  if (auto put = map_.put_all(*std::move(read)); !put) return std::unexpected(put.error());
  for (auto const& id : slot_ids()) {
    if (known.contains(id)) continue;
    auto const gone = map_.remove(::lapwing::map::LayerKind::slots, id, {.writer = drone_, .at = at});
    if (!gone) return std::unexpected(gone.error());
  }
  return {};
}

std::vector<std::string> LotWriter::slot_ids() const {
  constexpr auto most = std::numeric_limits<std::size_t>::max();
  std::vector<std::string> ids;
  for (auto const* const record : map_.within(::lapwing::map::LayerKind::slots, site_id, std::nullopt, most))
    if (record->feature.account.writer == drone_) ids.push_back(record->feature.id);
  return ids;
}

std::optional<vehicle::SlotCounts> LotWriter::slots() const {
  vehicle::SlotCounts counts;
  auto const ids = slot_ids();
  for (auto const& id : ids) {
    auto const* const record = map_.find(::lapwing::map::LayerKind::slots, id);
    auto const& slot = std::get<::lapwing::map::Slot>(record->feature.content);
    auto& count = slot.state == ::lapwing::map::SlotState::free    ? counts.free
                  : slot.state == ::lapwing::map::SlotState::taken ? counts.taken
                                                                   : counts.unknown;
    ++count;
  }
  return ids.empty() ? std::nullopt : std::optional(counts);
}

}  // namespace lapwing::host
