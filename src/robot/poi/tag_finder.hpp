#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/async/scope.hpp"
#include "base/log.hpp"
#include "map/live/live_map.hpp"
#include "robot/poi/eye.hpp"
#include "robot/poi/tag_book.hpp"
#include "robot/views/look_book.hpp"
#include "robot/views/seen_walls.hpp"
#include "robot/views/viewpoint.hpp"
#include "robot/views/wall_views.hpp"
#include "vehicle/registry.hpp"

namespace lapwing::robot {

/// Finds name tags on the way of one robot: looks at each piece of wall that comes before one of its cameras, places
/// what is read there by the robot's pose and map, and puts it on the map as points of interest. It steers nothing, but
/// says from where it wants to look once more at what it could not read for sure.
///
/// Thread-bound; ends with its destruction.
class TagFinder {
 public:
  struct Setup {
    std::string vehicle;
    std::string grid;  ///< what its map is called on the map
    Eyes eyes;
    /// Gives where the way is clear as its laser sees it at this moment. Without this doors stand as they were mapped.
    std::function<ClearWay()> clear_ways = {};
  };
  /// All of these, and what the eyes need, outlive it. What the robot put on the map another time goes.
  TagFinder(base::Loop& loop, vehicle::Registry const& registry, map::LiveMap& live_map, Setup setup, base::Logger log);
  TagFinder(TagFinder const&) = delete;
  TagFinder& operator=(TagFinder const&) = delete;

  [[nodiscard]] TagBook const& book() const { return book_; }
  [[nodiscard]] int pictures() const { return pictures_; }
  /// The texts of those that were read for sure, or as far as somebody before them can.
  [[nodiscard]] std::vector<std::string> texts() const;

  /// From where it wants to look now: at the nearest of the tags that it is not sure of, and when there are none, at
  /// the nearest wall, of those that are `which`, that it came past and did not see clearly. A tag has two tries, of
  /// which this may be one, and a wall one, so that there is an end. Who drives there stands until `has_looked`.
  /// Nothing: there is no more to be looked at, or nowhere to stand. Walls are compared beside the loop, which may take
  /// half a second. One call at a time.
  [[nodiscard]] base::Task<std::optional<Viewpoint>> next_view(WallChoice which = WallChoice::any);
  /// That there is something which `next_view` would give.
  [[nodiscard]] base::Task<bool> is_any_left(WallChoice which);
  [[nodiscard]] bool has_looked() const { return !retake_; }
  /// The map has moved: what hangs on its walls goes with them.
  void move(MapMove const& moved);
  /// How many were seen and could not be read.
  [[nodiscard]] std::size_t unread() const;

 private:
  using Entry = TagBook::Entry;
  /// What came of looking at a tag again.
  struct Tries {
    int begun = 0;
    int looks = 0;   ///< from before it
    int sights = 0;  ///< in these
  };
  /// That is to be done now.
  struct Retake {
    std::uint32_t tag = 0;  ///< 0: no tag, but a wall that has not been seen clearly
    Viewpoint view;
    int looks = 0;
  };

  base::Task<> keep_looking();
  base::Task<> look_round(double yaw_rad);
  base::Task<> look_again();
  /// Gives what was seen, as the numbers of tags; nothing: there was no look.
  base::Task<std::optional<std::vector<std::uint32_t>>> look_with(Eye const& eye, vehicle::SitePose pose);
  /// Into the books goes what a picture showed that was taken at `pose`; gives the tags on it. `views` and `clear_way`
  /// are of that moment.
  std::vector<std::uint32_t> note(Look const& look, Eye const& eye, vehicle::SitePose const& pose,
                                  std::vector<SeenWall> const& views, ClearWay const& clear_way);
  base::Task<> show(std::uint32_t number, vehicle::SitePose pose);
  [[nodiscard]] std::optional<vehicle::SitePose> pose_now() const;
  void take_in(TagBook::Joined const& joined);
  void note_passed(vehicle::SitePose const& pose);
  [[nodiscard]] std::optional<Retake> next_tag(map::OccupancyGrid const& grid, map::SitePoint const& here);
  base::Task<std::optional<WallView>> nearest_wall(map::OccupancyGrid grid, map::SitePoint here, WallChoice which);
  /// Those that may be looked at once more.
  [[nodiscard]] std::vector<Entry const*> wanted_tags() const;
  [[nodiscard]] std::vector<Viewpoint> views_of(Entry const& tag, map::OccupancyGrid const& grid) const;
  [[nodiscard]] std::vector<CameraMount> mounts() const;
  [[nodiscard]] bool is_there(Retake const& retake, vehicle::SitePose const& pose) const;
  [[nodiscard]] Tries tries_of(std::uint32_t number) const;
  [[nodiscard]] bool is_sure(Entry const& tag) const;
  [[nodiscard]] bool wants_a_look(Entry const& tag) const;
  [[nodiscard]] bool is_unread(Entry const& tag) const;
  [[nodiscard]] map::OccupancyGrid const* grid_of(vehicle::SitePose const& pose) const;
  void write(Entry const& tag, vehicle::SitePose const& pose);
  void forget();

  base::Loop& loop_;
  vehicle::Registry const& registry_;
  map::LiveMap& live_map_;
  Setup setup_;
  base::Logger log_;
  TagBook book_;
  LookBook looks_;
  std::map<std::uint32_t, Tries> tries_;           ///< by the tag's number
  std::map<std::uint32_t, map::SitePoint> shown_;  ///< on the map, and where
  std::optional<Retake> retake_;
  int pictures_ = 0;
  base::Scope scope_;
};

}  // namespace lapwing::robot
