#pragma once

#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "map/live/live_map.hpp"
#include "map/store/past/shade_packing.hpp"
#include "map/store/rows/feature_rows.hpp"
#include "map/store/rows/grid_rows.hpp"
#include "map/store/sql/database.hpp"
#include "map/store/store.hpp"

namespace lapwing::map::write {

using FeatureKey = std::pair<LayerKind, std::string>;
using TileName = std::pair<GridKey, TileKey>;

/// What is written together: copies, for another thread.
struct Batch {
  rows::Sites sites = {};  ///< those that the features lie in, and those that changed
  std::vector<std::string> changed_sites = {};
  std::vector<FeatureRecord> features = {};
  std::map<GridKey, rows::GridPart> grids = {};
  std::optional<Store::Session> session = {};
  std::vector<Store::Shown> frames = {};
  std::vector<past::PackedShades> shades = {};  ///< of grids
  std::vector<std::string> listed_shades = {};  ///< that are still seen
  base::UtcTime shades_at = {};

  [[nodiscard]] bool changes_map() const { return !changed_sites.empty() || !features.empty() || !grids.empty(); }
  [[nodiscard]] bool is_empty() const { return !changes_map() && !session && frames.empty() && shades.empty(); }
};

/// What other stations have written.
struct News {
  rows::Sites sites = {};
  rows::Changes changes = {};
  std::map<GridKey, rows::GridPart> grids = {};
};

/// Others have written these since we looked: what we have is not written before it has been merged with theirs.
struct PassedOver {
  std::set<FeatureKey> features = {};
  std::set<TileName> tiles = {};
};

struct Written {
  Revision seen = 0;  ///< all up to here has been read or written by us
  std::optional<News> news = {};
  PassedOver passed_over = {};
};

/// Writes all of it or, with an error, nothing. `seen`: what this station knows of the store.
///
/// Those who write one store do it one after the other: the row with its revision is held until the commit. So what
/// others have written since `seen` can be read first, and nothing of it is covered unseen; which of two accounts
/// counts, is then the live map's to say.
[[nodiscard]] base::Result<Written> write_batch(sql::Database& database, Batch const& batch, Revision seen);
/// The same with nothing to write.
[[nodiscard]] base::Result<Written> read_news(sql::Database& database, Revision seen);
[[nodiscard]] base::Result<Revision> revision_of(sql::Database& database);

}  // namespace lapwing::map::write
