#pragma once

#include <chrono>
#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "map/live/live_map.hpp"
#include "map/store/past/grid_list.hpp"
#include "map/store/past/shade_packing.hpp"

namespace lapwing::map::past {

/// What is kept of how the grids of a map look, moment by moment: of tiles that have changed what is different since
/// the moment before, and lists of which tiles there were. `take` looks at the map, on the loop; `pack` does the work,
/// a pure function for the pool; `done` takes note that it is kept.
class GridKeeper {
 public:
  /// How a tile looked last.
  struct Seen {
    std::shared_ptr<TileShades const> shades = {};
    std::string name = {};
    int steps = 0;                ///< since it was kept whole
    std::size_t whole_bytes = 0;  ///< it had then
  };
  struct TileWork {
    std::shared_ptr<GridTile const> tile = {};  ///< null: nothing is known there any more
    Seen seen = {};
  };
  struct GridWork {
    GridPlace place = {};
    Revision revision = 0;
    bool is_anew = false;
    std::map<TileKey, TileWork> tiles = {};
  };
  struct Work {
    std::map<GridKey, GridWork> grids = {};
    bool is_whole = false;  ///< all grids with all their tiles are listed
  };
  struct Packed {
    std::map<GridKey, std::map<TileKey, Seen>> seen = {};
    std::vector<PackedShades> shades = {};
  };

  /// What has changed since. Nothing: there is nothing to keep.
  [[nodiscard]] std::optional<Work> take(LiveMap const& map, std::string const& session, base::UtcTime now);
  [[nodiscard]] static Packed pack(Work const& work);

  struct Lists {
    std::vector<std::string> frames = {};
    bool is_whole = false;                ///< what was listed before does not count any more
    std::vector<std::string> names = {};  ///< of all that stands in a whole one
  };
  /// What to keep beside the shades.
  [[nodiscard]] Lists done(Work const& work, Packed const& packed);
  /// The lists were not kept: the next ones stand for themselves.
  void has_lost_lists() { listed_ = {}; }

 private:
  struct Grid {
    GridPlace place = {};
    Revision revision = 0;
    std::map<TileKey, Seen> tiles = {};
  };
  struct Listed {
    std::string session = {};
    base::UtcTime at = {};
    std::size_t whole_bytes = 0;  ///< of the last whole list
    std::size_t bytes_since = 0;
  };

  /// What is different from the grid that is known, null for none.
  static std::optional<GridWork> news_of(GridRecord const& record, Grid const* known, GridPlace const& place);
  Lists all_lists();

  std::map<GridKey, Grid> grids_;
  Listed listed_;
};

}  // namespace lapwing::map::past
