#include "station/map/grids/grid_pictures.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "base/async/pool.hpp"
#include "map/grid/grid_tiles.hpp"
#include "map/grid/png.hpp"
#include "station/map/grids/tile_range.hpp"
#include "station/map/grids/under_way.hpp"

namespace lapwing::station {

namespace {

using Pyramid = std::shared_ptr<map::GridPyramid const>;

Pyramid make_ready(map::OccupancyGrid const& grid, Pyramid const& before) {
  return before ? std::make_shared<map::GridPyramid const>(grid, *before)
                : std::make_shared<map::GridPyramid const>(grid);
}

std::string draw(Pyramid const& pyramid, geo::Site const& site, map::XyzTile tile, std::string const& grid) {
  auto shades = map::render(*pyramid, site, tile);
  if (!shades) shades.emplace(std::size_t{map::tile_px} * map::tile_px);
  return map::png_of(*shades, map::tile_px, map::palette_for(grid));
}

}  // namespace

GridPictures::GridPictures(base::Loop& loop, map::LiveMap const& map, std::shared_ptr<GridPlaces> places,
                           Options options)
    : loop_(loop),
      map_(map),
      places_(std::move(places)),
      options_(options),
      ended_(loop),
      empty_(std::make_shared<std::string const>(map::png_of(
          std::vector<map::Shade>(std::size_t{map::tile_px} * map::tile_px), map::tile_px, map::scale_palette()))) {}

map::Revision GridPictures::revision_of(map::GridKey const& key, map::XyzTile const& tile) const {
  auto const& record = map_.grids().at(key);
  auto const range = tiles_under(record.grid.resolution_m(), record.grid.site_from_grid(), *map_.site(key.site), tile);
  map::Revision newest = 0;
  if (!range) return newest;
  for (auto const& [at, revision] : record.tile_revisions)
    if (range->contains(at)) newest = std::max(newest, revision);
  places_->look();
  return newest == 0 ? 0 : std::max(newest, places_->since(key));
}

bool GridPictures::has_room(Name const& name) const {
  return !under_way_.contains(name) && under_way_.size() < static_cast<std::size_t>(options_.most_jobs);
}

base::Task<std::shared_ptr<std::string const>> GridPictures::picture(map::GridKey key, map::XyzTile tile) {
  Name const name{key, tile};
  for (;;) {
    // Again after each wait: the map has changed meanwhile, or somebody else has had the same drawn.
    auto const revision = revision_of(key, tile);
    if (revision == 0) co_return empty_;
    if (auto known = find(name, revision)) co_return known;
    if (has_room(name)) break;
    co_await ended_.wait();
  }
  UnderWay const entry(under_way_, name, ended_);
  auto const revision = revision_of(key, tile);
  auto ready = co_await pyramid(key);
  auto png = co_await loop_.on_pool(draw, std::move(ready), *map_.site(key.site), tile, key.name);
  ++drawn_;
  auto shared = std::make_shared<std::string const>(std::move(png));
  keep(name, revision, shared);
  co_return shared;
}

base::Task<GridPictures::Pyramid> GridPictures::pyramid(map::GridKey key) {
  while (being_made_ready_.contains(key)) co_await ended_.wait();
  auto const& record = map_.grids().at(key);
  auto const revision = record.revision;
  auto& ready = ready_[key];
  if (ready.revision == revision) co_return ready.pyramid;
  UnderWay const entry(being_made_ready_, key, ended_);
  auto made = co_await loop_.on_pool(make_ready, record.grid, ready.pyramid);
  ready = {revision, made};
  co_return made;
}

std::shared_ptr<std::string const> GridPictures::find(Name const& name, map::Revision revision) {
  auto const known = index_.find(name);
  if (known == index_.end() || known->second->revision != revision) return nullptr;
  kept_.splice(kept_.begin(), kept_, known->second);
  return known->second->png;
}

void GridPictures::keep(Name const& name, map::Revision revision, std::shared_ptr<std::string const> png) {
  if (auto const known = index_.find(name); known != index_.end()) {
    kept_bytes_ -= known->second->png->size();
    kept_.erase(known->second);
    index_.erase(known);
  }
  kept_bytes_ += png->size();
  kept_.push_front({name, revision, std::move(png)});
  index_.emplace(name, kept_.begin());
  while (kept_bytes_ > options_.most_bytes && kept_.size() > 1) {
    kept_bytes_ -= kept_.back().png->size();
    index_.erase(kept_.back().name);
    kept_.pop_back();
  }
}

}  // namespace lapwing::station
