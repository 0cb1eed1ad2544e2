#include "map/live/live_map.hpp"

#include <algorithm>
#include <set>
#include <unordered_map>
#include <utility>

#include <fmt/format.h>

#include "base/text/printable.hpp"
#include "base/text/utc_text.hpp"
#include "map/features/text_fault.hpp"
#include "map/live/internal/layer.hpp"
#include "map/live/merge.hpp"

namespace lapwing::map {

namespace {

using base::ErrorKind;

base::Error of(LayerKind layer, std::string_view id, base::Error error) {
  // An id that is at fault itself may be long and no text.
  auto const name = id_fault(id) ? std::string("a feature") : fmt::format("\"{}\"", id);
  error.message = fmt::format("{} of the layer {}: {}", name, name_of(layer), error.message);
  return error;
}

bool is_same(geo::Transform<geo::SiteFrame, geo::FloorFrame> const& a,
             geo::Transform<geo::SiteFrame, geo::FloorFrame> const& b) {
  return a.origin() == b.origin() && a.yaw_rad() == b.yaw_rad();
}

bool is_same(geo::Floor const& a, geo::Floor const& b) {
  return a.id == b.id && a.name == b.name && a.up_m == b.up_m && is_same(a.site_from_floor, b.site_from_floor);
}

bool has_same_floors(geo::Site const& a, geo::Site const& b) {
  return std::ranges::equal(a.floors(), b.floors(),
                            [](auto const& one, auto const& other) { return is_same(one, other); });
}

bool lies_alike(OccupancyGrid const& a, OccupancyGrid const& b) {
  return a.resolution_m() == b.resolution_m() && a.site_from_grid().origin() == b.site_from_grid().origin() &&
         a.site_from_grid().yaw_rad() == b.site_from_grid().yaw_rad();
}

/// Of which nothing newer is known, each once.
std::vector<TileKey> newer_tiles(GridRecord const* record, std::vector<TileKey> tiles, base::UtcTime at) {
  std::ranges::sort(tiles);
  tiles.erase(std::ranges::unique(tiles).begin(), tiles.end());
  if (record) {
    std::erase_if(tiles, [&](TileKey tile) {
      auto const known = record->tile_times.find(tile);
      return known != record->tile_times.end() && known->second > at;
    });
  }
  return tiles;
}

/// The tile lies on the map of the site.
bool is_near(OccupancyGrid const& grid, TileKey tile) {
  double const side_m = tile_cells * grid.resolution_m();
  geo::Point<GridFrame> const middle((tile.x + 0.5) * side_m, (tile.y + 0.5) * side_m);
  return (grid.site_from_grid() * middle).v.norm() <= farthest_m;  // not for what is no number
}

}  // namespace

/// What a call is about to write: gathered first, so that an error leaves everything as it was.
class LiveMap::Step {
 public:
  explicit Step(LiveMap& map) : map_(map) {}

  [[nodiscard]] std::optional<base::Error> put(Feature feature) {
    if (auto refused = map_.refusal(feature)) return refused;
    auto& item = staged({layer_of(feature.content), feature.id, feature.site, feature.floor});
    if (item.known.feature)
      if (auto other = conflict(*item.known.feature, feature))
        return base::Error{ErrorKind::refused, *std::move(other)};
    if (take(item.known, std::move(feature))) item.is_changed = true;
    return std::nullopt;
  }
  void remove(LayerKind kind, Feature const& feature, Account const& account) {
    auto& item = staged({kind, feature.id, feature.site, feature.floor});
    if (take(item.known, account)) item.is_changed = true;
  }

  /// How many have changed.
  std::size_t write() {
    MapChange change;
    for (auto& item : items_) {
      auto& layer = map_.layer(item.identity.kind);
      if (item.is_changed) {
        change.features.push_back(&layer.write(item.identity, std::move(item.known), ++map_.revision_));
      } else if (item.known.removal) {
        layer.note_removal(item.identity.id, *item.known.removal);
      }
    }
    change.revision = map_.revision_;
    if (!change.features.empty()) map_.tell(change);
    return change.features.size();
  }

 private:
  struct Item {
    internal::Identity identity;
    Known known;
    bool is_changed = false;
  };

  Item& staged(internal::Identity identity) {
    auto const [entry, is_new] =
        index_[static_cast<std::size_t>(identity.kind)].try_emplace(identity.id, items_.size());
    if (is_new) {
      auto known = map_.layer(identity.kind).known(identity.id);
      items_.push_back({.identity = std::move(identity), .known = std::move(known)});
    }
    return items_[entry->second];
  }

  LiveMap& map_;
  std::vector<Item> items_;
  std::array<std::unordered_map<std::string, std::size_t>, all_layers.size()> index_;
};

LiveMap::LiveMap(std::function<base::UtcTime()> now) : now_(std::move(now)) {
  for (auto& layer : layers_) layer = std::make_unique<internal::Layer>();
}

LiveMap::~LiveMap() = default;

internal::Layer& LiveMap::layer(LayerKind kind) const {
  return *layers_[static_cast<std::size_t>(kind)];
}

void LiveMap::put_site(geo::Site site) {
  auto const known = sites_.find(site.id());
  bool const moves = known != sites_.end() && !(known->second.anchor() == site.anchor());
  if (known != sites_.end() && !moves && has_same_floors(known->second, site)) return;
  MapChange change{.site = site.id()};
  sites_.insert_or_assign(site.id(), std::move(site));
  ++revision_;
  if (moves) {
    for (auto const& layer : layers_) {
      auto const touched = layer->touch(change.site, revision_);
      change.features.insert(change.features.end(), touched.begin(), touched.end());
    }
    for (auto& [key, record] : grids_) {
      if (key.site != change.site) continue;
      record.revision = record.made = ++revision_;
      for (auto& [tile, revision] : record.tile_revisions) revision = revision_;
    }
  }
  change.revision = revision_;
  tell(change);
}

geo::Site const* LiveMap::site(std::string_view id) const {
  auto const found = sites_.find(id);
  return found == sites_.end() ? nullptr : &found->second;
}

base::Result<LiveMap::Outcome> LiveMap::put(Feature feature) {
  std::vector<Feature> one;
  one.push_back(std::move(feature));
  auto const changed = put_all(std::move(one));
  if (!changed) return std::unexpected(changed.error());
  return *changed > 0 ? Outcome::changed : Outcome::outdated;
}

base::Result<std::size_t> LiveMap::put_all(std::vector<Feature> features) {
  Step step(*this);
  for (auto& feature : features) {
    auto const kind = layer_of(feature.content);
    auto const id = feature.id;
    if (auto refused = step.put(std::move(feature))) return std::unexpected(of(kind, id, *std::move(refused)));
  }
  return step.write();
}

base::Result<LiveMap::Outcome> LiveMap::remove(LayerKind kind, std::string const& id, Account const& account) {
  auto const* record = find(kind, id);
  if (!record) return std::unexpected(of(kind, id, {ErrorKind::not_found, "it is not known"}));
  if (auto refused = refusal(account)) return std::unexpected(of(kind, id, *std::move(refused)));
  Step step(*this);
  step.remove(kind, record->feature, account);
  return step.write() > 0 ? Outcome::changed : Outcome::outdated;
}

base::Result<> LiveMap::restore(FeatureRecord record) {
  auto const kind = layer_of(record.feature.content);
  auto const id = record.feature.id;
  auto const fault = record.is_removed ? id_fault(id) : feature_fault(record.feature);
  if (fault) return std::unexpected(of(kind, id, {ErrorKind::invalid_input, *fault}));
  if (!record.is_removed && !site(record.feature.site))
    return std::unexpected(
        of(kind, id, {ErrorKind::not_found, fmt::format("there is no site \"{}\"", record.feature.site)}));
  internal::Identity const identity{kind, id, record.feature.site, record.feature.floor};
  Known known = layer(kind).known(id);
  if (record.is_removed) record.removal = record.feature.account;
  if (record.removal) take(known, *record.removal);
  if (!record.is_removed) take(known, std::move(record.feature));
  if (known.feature || known.removal) layer(kind).write(identity, std::move(known), ++revision_);
  return {};
}

base::Result<LiveMap::Outcome> LiveMap::put_tiles(GridKey const& key, OccupancyGrid const& from,
                                                  std::vector<TileKey> const& changed, Account const& account) {
  auto refused = refusal(account);
  if (!refused) refused = refusal(key, from, changed);
  if (refused) {
    refused->message = fmt::format("the grid \"{}\": {}", base::printable(key.name), refused->message);
    return std::unexpected(*std::move(refused));
  }
  auto found = grids_.find(key);
  bool const is_another = found == grids_.end() || !lies_alike(found->second.grid, from);
  if (is_another && found != grids_.end() && account < found->second.account) return Outcome::outdated;
  auto news = newer_tiles(is_another ? nullptr : &found->second, changed, account.at);
  if (news.empty()) return Outcome::outdated;
  ++revision_;
  if (is_another) {
    GridRecord made{.grid = OccupancyGrid(from.resolution_m(), from.site_from_grid()), .made = revision_};
    found = grids_.insert_or_assign(key, std::move(made)).first;
  }
  auto& record = found->second;
  record.revision = revision_;
  record.account = std::max(record.account, account);
  for (auto const tile : news) {
    auto const given = from.tiles().find(tile);
    record.grid.set_tile(tile, given == from.tiles().end() ? nullptr : given->second);
    record.tile_revisions[tile] = revision_;
    record.tile_times[tile] = account.at;
  }
  tell({.revision = revision_, .grid = &record, .grid_key = key, .tiles = std::move(news)});
  return Outcome::changed;
}

FeatureRecord const* LiveMap::find(LayerKind kind, std::string const& id) const {
  return layer(kind).find(id);
}

std::vector<FeatureRecord const*> LiveMap::within(LayerKind kind, std::string const& site,
                                                  std::optional<SiteBox> const& box, std::size_t most) const {
  return box ? layer(kind).within(site, *box, most) : layer(kind).all_in(site, most);
}

std::vector<FeatureRecord const*> LiveMap::changed_since(LayerKind kind, Revision revision, std::size_t most) const {
  return layer(kind).changed_since(revision, most);
}

Revision LiveMap::oldest_remembered(LayerKind kind) const {
  return layer(kind).oldest_remembered();
}

std::size_t LiveMap::size(LayerKind kind) const {
  return layer(kind).size();
}

std::shared_ptr<void> LiveMap::follow(Follower follower) {
  auto handle = std::make_shared<Follower>(std::move(follower));
  followers_.push_back(handle);
  return handle;
}

void LiveMap::tell(MapChange const& change) {
  std::erase_if(followers_, [](auto const& follower) { return follower.expired(); });
  // A copy: whoever is told may end his own following or begin another's.
  for (auto const& follower : std::vector(followers_))
    if (auto const living = follower.lock()) (*living)(change);
}

std::optional<base::Error> LiveMap::refusal(Account const& account) const {
  if (auto const fault = id_fault(account.writer)) return base::Error{ErrorKind::invalid_input, "writer " + *fault};
  if (!is_sane(account.at))
    return base::Error{ErrorKind::invalid_input,
                       fmt::format("at is {}, not from 1990 to 2200", base::utc_text(account.at))};
  auto const now = now_();
  if (account.at <= now + farthest_ahead) return std::nullopt;
  return base::Error{
      ErrorKind::refused,
      fmt::format("{} tells of {}, and here it is {}", account.writer, base::utc_text(account.at), base::utc_text(now)),
      "one of the two clocks is wrong: set it"};
}

std::optional<base::Error> LiveMap::refusal(std::string const& site_id, std::string const& floor_id) const {
  auto const* home = site(site_id);
  if (!home) return base::Error{ErrorKind::not_found, fmt::format("there is no site \"{}\"", base::printable(site_id))};
  if (floor_id.empty() || home->floor(floor_id)) return std::nullopt;
  return base::Error{ErrorKind::not_found,
                     fmt::format("the site {} has no floor \"{}\"", site_id, base::printable(floor_id))};
}

std::optional<base::Error> LiveMap::refusal(Feature const& feature) const {
  if (auto fault = feature_fault(feature)) return base::Error{ErrorKind::invalid_input, *std::move(fault)};
  if (auto refused = refusal(feature.site, feature.floor)) return refused;
  return refusal(feature.account);
}

std::optional<base::Error> LiveMap::refusal(GridKey const& key, OccupancyGrid const& from,
                                            std::vector<TileKey> const& changed) const {
  if (auto const fault = id_fault(key.name)) return base::Error{ErrorKind::invalid_input, "its name " + *fault};
  if (auto refused = refusal(key.site, key.floor)) return refused;
  auto const far = std::ranges::find_if(changed, [&](TileKey tile) { return !is_near(from, tile); });
  if (far != changed.end())
    return base::Error{ErrorKind::invalid_input,
                       fmt::format("its tile {}, {} lies more than {:.0f} km from the site's anchor", far->x, far->y,
                                   farthest_m / 1000.0)};
  auto const known = grids_.find(key);
  auto const count = changed.size() + (known == grids_.end() ? 0 : known->second.tile_revisions.size());
  if (count <= most_grid_tiles) return std::nullopt;
  std::set<TileKey> tiles(changed.begin(), changed.end());
  if (known != grids_.end() && lies_alike(known->second.grid, from))
    for (auto const& [tile, revision] : known->second.tile_revisions) tiles.insert(tile);
  if (tiles.size() <= most_grid_tiles) return std::nullopt;
  return base::Error{ErrorKind::refused,
                     fmt::format("it would have {} tiles of {} by {} cells; at most {} are taken", tiles.size(),
                                 tile_cells, tile_cells, most_grid_tiles),
                     "give it a coarser resolution, or cut it in several"};
}

}  // namespace lapwing::map
