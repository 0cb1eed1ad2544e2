#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "geo/site.hpp"
#include "map/live/live_map.hpp"
#include "map/store/sql/database.hpp"

/// Features as rows of their layer's table, and back.
namespace lapwing::map::rows {

using Sites = std::map<std::string, geo::Site, std::less<>>;

/// The columns of the layer's table but for its key, in the order of the values below.
[[nodiscard]] std::vector<std::string> feature_columns(LayerKind layer);
/// Precondition: sound, and not removed.
[[nodiscard]] sql::Row row_of(Feature const& feature, geo::Site const& site, Revision revision);
/// Of a row of those columns. Error, io: it holds no feature; the message says which and why.
[[nodiscard]] base::Result<Feature> feature_of(LayerKind layer, sql::Row const& row, Sites const& sites);

/// Puts those that are there, takes out those that are removed, and remembers when they were taken away.
[[nodiscard]] base::Result<> write_features(sql::Database& database, std::vector<FeatureRecord> const& records,
                                            Sites const& sites, Revision revision);

/// A rectangle on the globe, in degrees.
struct LonLatBox {
  double least_lon_deg;
  double most_lon_deg;
  double least_lat_deg;
  double most_lat_deg;
};
[[nodiscard]] base::Result<std::vector<Feature>> features_within(sql::Database& database, LayerKind layer,
                                                                 Sites const& sites, LonLatBox const& box,
                                                                 std::size_t most);

/// What stands in the tables, a piece at a time.
struct FeaturePage {
  std::vector<Feature> features;
  std::vector<std::string> faults;  ///< rows that hold no feature
  std::int64_t last_fid = 0;        ///< the next page begins behind it
  bool is_last = false;
};
[[nodiscard]] base::Result<FeaturePage> read_page(sql::Database& database, LayerKind layer, Sites const& sites,
                                                  std::int64_t behind_fid, std::size_t most);

/// When something was taken away, which may be there again since.
struct Removal {
  LayerKind layer;
  std::string id;
  std::string site;
  std::string floor;
  Account account;
};
[[nodiscard]] base::Result<std::vector<Removal>> removals_since(sql::Database& database, Revision since);

/// What has been written since.
struct Changes {
  std::vector<Feature> features;
  std::vector<Removal> removals;
  std::vector<std::string> faults;  ///< rows that hold no feature
};
[[nodiscard]] base::Result<Changes> changes_since(sql::Database& database, Sites const& sites, Revision since);

}  // namespace lapwing::map::rows
