#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "base/async/scope.hpp"
#include "base/log.hpp"
#include "map/live/live_map.hpp"
#include "robot/poi/eye.hpp"
#include "robot/poi/tag_book.hpp"
#include "vehicle/registry.hpp"

namespace lapwing::robot {

/// Finds name tags on the way of one robot: looks at each piece of wall that comes before one of its cameras, places
/// what is read there by the robot's pose and map, and puts it on the map as points of interest. It steers nothing.
///
/// Thread-bound; ends with its destruction.
class TagFinder {
 public:
  struct Setup {
    std::string vehicle;
    std::string grid;  ///< what its map is called on the map
    Eyes eyes;
  };
  /// All of these, and what the eyes need, outlive it. What the robot put on the map another time goes.
  TagFinder(base::Loop& loop, vehicle::Registry const& registry, map::LiveMap& live_map, Setup setup, base::Logger log);
  TagFinder(TagFinder const&) = delete;
  TagFinder& operator=(TagFinder const&) = delete;

  [[nodiscard]] TagBook const& book() const { return book_; }
  [[nodiscard]] int pictures() const { return pictures_; }
  /// The texts of those that it is sure enough of to have put them on the map.
  [[nodiscard]] std::vector<std::string> texts() const;

 private:
  /// A piece of wall, as wide as a camera's middle surely shows: its place in such widths, and the quarter it faces.
  using Patch = std::tuple<int, int, int>;

  base::Task<> keep_looking();
  base::Task<> look_with(Eye const& eye, vehicle::SitePose pose);
  [[nodiscard]] std::optional<Patch> patch_before(Eye const& eye, vehicle::SitePose const& pose) const;
  [[nodiscard]] map::OccupancyGrid const* grid_of(vehicle::SitePose const& pose) const;
  void write(TagBook::Entry const& tag, vehicle::SitePose const& pose);
  void forget();

  base::Loop& loop_;
  vehicle::Registry const& registry_;
  map::LiveMap& live_map_;
  Setup setup_;
  base::Logger log_;
  TagBook book_;
  std::map<Patch, int> looks_;  ///< poor ones count for less: see `worth_of`
  int pictures_ = 0;
  base::Scope scope_;
};

}  // namespace lapwing::robot
