#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "geo/site.hpp"
#include "map/features/feature.hpp"
#include "map/grid/occupancy_grid.hpp"

namespace lapwing::map {

/// Grows with every change of the map, over all layers; 0: before any.
using Revision = std::uint64_t;

/// A feature, or the memory that there was one, with the revision of its last change.
struct FeatureRecord {
  Revision revision = 0;
  bool is_removed = false;  ///< `feature` has its id, layer and account only
  Feature feature;
};

/// One occupancy grid of a floor of a site, by who writes it.
struct GridKey {
  std::string site;
  std::string floor;
  std::string name;  ///< "floor", "robot 1", "parking"
  friend auto operator<=>(GridKey const&, GridKey const&) = default;
};

struct GridRecord {
  Revision revision = 0;
  OccupancyGrid grid;
  Account account;  ///< of the newest change
  std::map<TileKey, Revision> tile_revisions;
};

/// What changed in one step, for the store, feeds and whoever else follows. Valid during the call.
struct MapChange {
  Revision revision = 0;
  std::vector<FeatureRecord const*> features;
  GridRecord const* grid = nullptr;
  GridKey grid_key;
  std::vector<TileKey> tiles;
  std::string site;  ///< this site was placed or has other floors now; empty: none
};

/// The map of all sites as it is now: what writers say is merged into it by each layer's rule, and every change has a
/// revision. Thread-bound to the loop; what goes to other threads is copied.
class LiveMap {
 public:
  /// Whether it changed anything: what is older than what is known does not.
  enum class Outcome { changed, outdated };

  /// New, or moved: what lies in it stays where it is in the site's own frame, and moves on the globe.
  void put_site(geo::Site site);
  [[nodiscard]] geo::Site const* site(std::string_view id) const;
  [[nodiscard]] std::map<std::string, geo::Site, std::less<>> const& sites() const { return sites_; }

  /// Errors: invalid_input with the fault of the feature; not_found for a site or floor that is not known.
  [[nodiscard]] base::Result<Outcome> put(Feature feature);
  /// All or none of them: an error names the feature and nothing is written.
  [[nodiscard]] base::Result<std::size_t> put_all(std::vector<Feature> features);
  /// Error: not_found.
  [[nodiscard]] base::Result<Outcome> remove(LayerKind layer, std::string const& id, Account const& account);
  /// Tiles of a grid, as the writer has them now. The grid is made by its first tiles; a later call with another
  /// resolution or place makes it anew. Errors as those of `put`.
  [[nodiscard]] base::Result<> put_tiles(GridKey const& key, OccupancyGrid const& from,
                                         std::vector<TileKey> const& changed, Account const& account);

  [[nodiscard]] FeatureRecord const* find(LayerKind layer, std::string const& id) const;
  /// Those that are not removed and whose bounds meet the box, at most `most`, in the order of their ids. Without a
  /// box: all.
  [[nodiscard]] std::vector<FeatureRecord const*> within(LayerKind layer, std::string const& site,
                                                         std::optional<SiteBox> const& box, std::size_t most) const;
  /// In the order of revisions, removed ones among them.
  [[nodiscard]] std::vector<FeatureRecord const*> changed_since(LayerKind layer, Revision revision) const;
  /// Below this a viewer must take the whole: what was removed before is forgotten.
  [[nodiscard]] Revision oldest_remembered(LayerKind layer) const;
  [[nodiscard]] std::size_t size(LayerKind layer) const;
  [[nodiscard]] std::map<GridKey, GridRecord> const& grids() const { return grids_; }

  [[nodiscard]] Revision revision() const { return revision_; }

  /// `follower` is called after each change, on the loop; it must not write. It ends with the handle.
  using Follower = std::function<void(MapChange const&)>;
  [[nodiscard]] std::shared_ptr<void> follow(Follower follower);

 private:
  struct Layer;
  std::map<std::string, geo::Site, std::less<>> sites_;
  std::map<LayerKind, std::shared_ptr<Layer>> layers_;
  std::map<GridKey, GridRecord> grids_;
  Revision revision_ = 0;
  std::vector<std::weak_ptr<Follower>> followers_;
};

}  // namespace lapwing::map
