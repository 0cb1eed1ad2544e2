#pragma once

#include <cstddef>
#include <list>
#include <map>
#include <memory>
#include <set>
#include <string>

#include "base/async/loop.hpp"
#include "base/async/notifier.hpp"
#include "base/async/task.hpp"
#include "map/grid/grid_pyramid.hpp"
#include "map/live/live_map.hpp"
#include "station/map/grids/grid_places.hpp"
#include "station/map/grids/web_mercator.hpp"

namespace lapwing::station {

/// Pictures of grids as web maps tile them: 256 pixels a side, transparent where nothing is known. They are drawn
/// beside the loop, a few at once, and kept until what they show changes. For that each grid is kept ready to be drawn
/// at any size, of which its changed tiles are made anew when somebody looks.
class GridPictures {
 public:
  struct Options {
    std::size_t most_bytes = std::size_t{64} * 1024 * 1024;  ///< of pictures that are kept
    int most_jobs = 2;                                       ///< drawn at once
  };
  /// Loop and map outlive it.
  GridPictures(base::Loop& loop, map::LiveMap const& map, std::shared_ptr<GridPlaces> places, Options options);
  GridPictures(base::Loop& loop, map::LiveMap const& map, std::shared_ptr<GridPlaces> places)
      : GridPictures(loop, map, std::move(places), Options{}) {}

  /// The newest revision of what the picture shows; 0 where it shows nothing. Precondition: there is that grid.
  [[nodiscard]] map::Revision revision_of(map::GridKey const& key, map::XyzTile const& tile) const;
  /// As a PNG. Precondition: there is that grid.
  [[nodiscard]] base::Task<std::shared_ptr<std::string const>> picture(map::GridKey key, map::XyzTile tile);

  /// How many have been drawn so far, and how many bytes are kept.
  [[nodiscard]] std::size_t drawn() const { return drawn_; }
  [[nodiscard]] std::size_t kept_bytes() const { return kept_bytes_; }

 private:
  using Name = std::pair<map::GridKey, map::XyzTile>;
  struct Kept {
    Name name;
    map::Revision revision = 0;
    std::shared_ptr<std::string const> png;
  };
  using Pyramid = std::shared_ptr<map::GridPyramid const>;
  [[nodiscard]] bool has_room(Name const& name) const;
  /// Of the grid as it is now.
  [[nodiscard]] base::Task<Pyramid> pyramid(map::GridKey key);

  [[nodiscard]] std::shared_ptr<std::string const> find(Name const& name, map::Revision revision);
  void keep(Name const& name, map::Revision revision, std::shared_ptr<std::string const> png);

  base::Loop& loop_;
  map::LiveMap const& map_;
  std::shared_ptr<GridPlaces> places_;
  Options options_;
  std::list<Kept> kept_;  ///< the one that was asked for last comes first
  std::map<Name, std::list<Kept>::iterator> index_;
  std::size_t kept_bytes_ = 0;
  struct Ready {
    map::Revision revision = 0;
    Pyramid pyramid;
  };
  std::map<map::GridKey, Ready> ready_;
  std::set<Name> under_way_;
  std::set<map::GridKey> being_made_ready_;
  base::Notifier ended_;
  std::shared_ptr<std::string const> empty_;
  std::size_t drawn_ = 0;
};

}  // namespace lapwing::station
