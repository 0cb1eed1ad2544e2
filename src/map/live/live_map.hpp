#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.hpp"
#include "base/wall_clock.hpp"
#include "geo/site.hpp"
#include "map/features/feature.hpp"
#include "map/grid/occupancy_grid.hpp"

namespace lapwing::map {

namespace internal {
class Layer;
}

/// Grows with every change of the map, over all layers; 0: before any.
using Revision = std::uint64_t;

/// A feature, or the memory that there was one, with the revision of its last change.
struct FeatureRecord {
  Revision revision = 0;
  bool is_removed = false;  ///< `feature` has its id, site, floor, layer and the account of its removal only
  Feature feature = {};
  std::optional<Account> removal = {};  ///< the newest that was heard of, also while a newer account stands
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
  Account account = {};  ///< of the newest change
  Revision made = 0;     ///< anew, or elsewhere than before: what was shown before does not count
  std::map<TileKey, Revision> tile_revisions = {};  ///< also of tiles in which nothing is known any more
  std::map<TileKey, base::UtcTime> tile_times = {};
};

/// What changed in one step, for the store, feeds and whoever else follows. Valid during the call. Each feature has a
/// revision of its own, the last of which is that of the step.
struct MapChange {
  Revision revision = 0;
  std::vector<FeatureRecord const*> features = {};
  GridRecord const* grid = nullptr;
  GridKey grid_key = {};
  std::vector<TileKey> tiles = {};
  std::string site =
      {};  ///< this site was placed or has other floors now; what lies in it is among the features if it moved
};

/// An account that is further ahead of our clock than that is refused: one wrong clock would have the last word until
/// its time comes. Less would refuse good accounts where the station's own clock is a little slow.
inline constexpr std::chrono::minutes farthest_ahead{10};
/// Of a layer. Those before are forgotten: who missed them takes the layer whole, and accounts older than they would be
/// taken.
inline constexpr std::size_t most_removals = 10'000;
/// Of a grid: 256 MiB, eight times 4,000 by 4,000 cells.
inline constexpr std::size_t most_grid_tiles = 2'048;

/// The map of all sites as it is now: what writers say is merged into it by each layer's rule, and every change has a
/// revision. Thread-bound to the loop; what goes to other threads is copied.
class LiveMap {
 public:
  /// Whether it changed anything: what is older than what is known does not.
  enum class Outcome { changed, outdated };

  /// `now`: the clock by which accounts are judged, that of the simulated world where there is one.
  explicit LiveMap(std::function<base::UtcTime()> now = base::wall_now);
  ~LiveMap();
  LiveMap(LiveMap const&) = delete;
  LiveMap& operator=(LiveMap const&) = delete;

  /// New, or moved: what lies in it stays where it is in the site's own frame, and moves on the globe.
  void put_site(geo::Site site);
  [[nodiscard]] geo::Site const* site(std::string_view id) const;
  [[nodiscard]] std::map<std::string, geo::Site, std::less<>> const& sites() const { return sites_; }

  /// Errors: invalid_input with the fault of the feature; not_found for a site or floor that is not known; refused for
  /// what lies ahead of our clock (`farthest_ahead`) or is another thing under a known id (`conflict`).
  [[nodiscard]] base::Result<Outcome> put(Feature feature);
  /// All or none of them: an error names the feature and nothing is written.
  [[nodiscard]] base::Result<std::size_t> put_all(std::vector<Feature> features);
  /// Errors: not_found for what was never heard of; invalid_input and refused as those of `put`.
  [[nodiscard]] base::Result<Outcome> remove(LayerKind layer, std::string const& id, Account const& account);
  /// As it was kept, clocks notwithstanding; followers are not told. Errors: invalid_input and not_found as those of
  /// `put`.
  [[nodiscard]] base::Result<> restore(FeatureRecord record);

  /// Tiles of a grid, as the writer has them now; older ones do not cover newer ones. The grid is made by its first
  /// tiles; a later account with another resolution or place makes it anew. Errors as those of `put`.
  [[nodiscard]] base::Result<Outcome> put_tiles(GridKey const& key, OccupancyGrid const& from,
                                                std::vector<TileKey> const& changed, Account const& account);

  /// This and what else gives records: until the next change. Removed ones are found, too, while they are remembered.
  [[nodiscard]] FeatureRecord const* find(LayerKind layer, std::string const& id) const;
  /// Those that are not removed and whose bounds meet the box, at most `most`, in the order of their ids. Without a
  /// box: all.
  [[nodiscard]] std::vector<FeatureRecord const*> within(LayerKind layer, std::string const& site,
                                                         std::optional<SiteBox> const& box, std::size_t most) const;
  /// In the order of revisions, removed ones among them; the first `most` of them.
  [[nodiscard]] std::vector<FeatureRecord const*> changed_since(
      LayerKind layer, Revision revision, std::size_t most = std::numeric_limits<std::size_t>::max()) const;
  /// Below this a viewer must take the whole: what was removed before is forgotten.
  [[nodiscard]] Revision oldest_remembered(LayerKind layer) const;
  [[nodiscard]] std::size_t size(LayerKind layer) const;
  [[nodiscard]] std::map<GridKey, GridRecord> const& grids() const { return grids_; }

  [[nodiscard]] Revision revision() const { return revision_; }

  /// `follower` is called after each change, on the loop; it must not write. It ends with the handle.
  using Follower = std::function<void(MapChange const&)>;
  [[nodiscard]] std::shared_ptr<void> follow(Follower follower);

 private:
  class Step;

  [[nodiscard]] std::optional<base::Error> refusal(Feature const& feature) const;
  [[nodiscard]] std::optional<base::Error> refusal(Account const& account) const;
  [[nodiscard]] std::optional<base::Error> refusal(std::string const& site_id, std::string const& floor_id) const;
  [[nodiscard]] std::optional<base::Error> refusal(GridKey const& key, OccupancyGrid const& from,
                                                   std::vector<TileKey> const& changed) const;
  [[nodiscard]] internal::Layer& layer(LayerKind kind) const;
  void tell(MapChange const& change);

  std::function<base::UtcTime()> now_;
  std::map<std::string, geo::Site, std::less<>> sites_;
  std::array<std::unique_ptr<internal::Layer>, all_layers.size()> layers_;
  std::map<GridKey, GridRecord> grids_;
  Revision revision_ = 0;
  std::vector<std::weak_ptr<Follower>> followers_;
};

}  // namespace lapwing::map
