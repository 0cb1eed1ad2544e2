#pragma once

#include <cstddef>
#include <list>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "base/async/loop.hpp"
#include "base/async/notifier.hpp"
#include "base/async/task.hpp"
#include "base/error.hpp"
#include "map/grid/grid_tiles.hpp"
#include "map/store/store.hpp"
#include "station/past/moment.hpp"

namespace lapwing::station {

/// Grids as they were shown, and what has changed in them, read from the store and drawn beside the loop. What has been
/// read lately is kept: a page asks for some dozens of pictures of one moment, and then for those of the next.
class PastGrids {
 public:
  struct Options {
    std::size_t most_moments = 16;
    std::size_t most_tiles = 768;  ///< 64 MiB of shades
  };
  /// Loop and store outlive it.
  PastGrids(base::Loop& loop, map::Store& store, Options options);
  PastGrids(base::Loop& loop, map::Store& store) : PastGrids(loop, store, Options{}) {}

  struct Picture {
    std::string png;
    std::string tag;  ///< the same for what looks the same
  };
  /// Errors: not_found for a grid that was not there then; those of the store.
  [[nodiscard]] base::Task<base::Result<Picture>> picture(Moment moment, map::GridKey key, map::XyzTile tile);
  /// Cells that are taken now and were not are green, those that are not any more red, other ones amber.
  [[nodiscard]] base::Task<base::Result<Picture>> changes(Moment from, Moment to, map::GridKey key, map::XyzTile tile);

  struct Difference {
    map::GridKey key;
    map::GridPlace place;   ///< now, or where it was last
    bool is_anew = false;   ///< its cells are not those of before: all are compared with nothing
    std::size_t taken = 0;  ///< cells that are taken now
    std::size_t freed = 0;  ///< that were taken
    std::size_t other = 0;  ///< that were free, or not known, and are the other now
    std::vector<map::TileKey> tiles = {};
  };
  /// Of grids in which something has changed, in order.
  [[nodiscard]] base::Task<base::Result<std::vector<Difference>>> compare(Moment from, Moment to);

 private:
  using Moments = std::shared_ptr<map::PastGrids const>;
  using Tile = std::shared_ptr<map::GridPyramid::Tile const>;
  using Names = std::map<map::TileKey, std::string>;
  struct Pair {
    map::GridPlace place;
    bool is_anew = false;
    Names before;  ///< of tiles that differ
    Names after;
  };
  [[nodiscard]] base::Task<base::Result<Moments>> grids(Moment moment);
  [[nodiscard]] base::Task<base::Result<map::GridPyramid::Tiles>> tiles(Names names);
  [[nodiscard]] base::Task<base::Result<>> read(std::set<std::string> missing, std::map<std::string, Tile>& found);
  [[nodiscard]] static Pair pair_of(map::PastGrid const* before, map::PastGrid const* after);
  void keep(Moment const& moment, Moments grids);
  void keep(std::string const& name, Tile tile);

  base::Loop& loop_;
  map::Store& store_;
  Options options_;
  std::list<std::pair<Moment, Moments>> moments_;  ///< the one that was asked for last comes first
  std::list<std::string> used_;                    ///< likewise
  struct Kept {
    Tile tile;
    std::list<std::string>::iterator used;
  };
  std::map<std::string, Kept> tiles_;
  std::set<Moment> being_read_;
  bool reads_tiles_ = false;
  base::Notifier ended_;
};

}  // namespace lapwing::station
