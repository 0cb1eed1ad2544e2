#pragma once

#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <boost/geometry.hpp>  // whole: the index uses more of it than it includes
#include <boost/geometry/index/rtree.hpp>

#include "map/live/live_map.hpp"
#include "map/live/merge.hpp"

namespace lapwing::map::internal {

/// Which feature, and what is kept of it once it is removed.
struct Identity {
  LayerKind kind;
  std::string id;
  std::string site;
  std::string floor;
};

/// The records of one layer, by id, by revision, and by where they lie. References to them last until they are written.
class Layer {
 public:
  [[nodiscard]] FeatureRecord const* find(std::string_view id) const;
  /// Nothing has been heard of it: empty.
  [[nodiscard]] Known known(std::string_view id) const;
  /// Precondition: something is known.
  FeatureRecord const& write(Identity const& identity, Known known, Revision revision);
  /// All that lies in the site has changed at once; each takes the next revision.
  std::vector<FeatureRecord const*> touch(std::string_view site, Revision& revision);
  /// A removal that changes nothing that is seen is remembered all the same.
  void note_removal(std::string_view id, Account const& removal);

  [[nodiscard]] std::vector<FeatureRecord const*> all_in(std::string_view site, std::size_t most) const;
  [[nodiscard]] std::vector<FeatureRecord const*> within(std::string_view site, SiteBox const& box,
                                                         std::size_t most) const;
  [[nodiscard]] std::vector<FeatureRecord const*> changed_since(Revision revision, std::size_t most) const;
  [[nodiscard]] Revision oldest_remembered() const { return oldest_remembered_; }
  [[nodiscard]] std::size_t size() const { return records_.size() - removals_.size(); }

 private:
  using Corner = boost::geometry::model::point<double, 2, boost::geometry::cs::cartesian>;
  using Box = boost::geometry::model::box<Corner>;
  using Place = std::pair<Box, FeatureRecord const*>;
  using Tree = boost::geometry::index::rtree<Place, boost::geometry::index::quadratic<16>>;

  [[nodiscard]] static Box box_of(SiteBox const& box);
  [[nodiscard]] static Place place_of(FeatureRecord const& record);
  void forget_oldest_removals();

  std::map<std::string, FeatureRecord, std::less<>> records_;
  std::map<Revision, FeatureRecord*> by_revision_;
  std::set<Revision> removals_;
  std::map<std::string, Tree, std::less<>> by_place_;  ///< a site
  Revision oldest_remembered_ = 0;
};

}  // namespace lapwing::map::internal
