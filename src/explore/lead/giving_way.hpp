#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "explore/known/known_map.hpp"
#include "explore/known/road_map.hpp"

namespace lapwing::explore {

/// Where a robot wants to go on that has a goal, or only a heading: the next metres, as if nobody else were there.
/// Empty where no road leads there.
[[nodiscard]] std::vector<Place> way_ahead(KnownMap const& map, RoadMap const& roads, Place const& from, Cell to);
[[nodiscard]] std::vector<Place> way_ahead(Place const& from, double yaw_rad);

/// Robots that stand before each other where there is no way around: one goes on, and whoever stands in its way makes
/// room, and whoever stands in the way of those (priority inheritance). Where that cannot be, because the only way out
/// leads past the one that wants on, that one makes room for the other first. They take turns in going first. Where
/// they still stand after a minute, ways that seemed free are not: then each in turn backs off, every round farther.
class GivingWay {
 public:
  struct Member {
    Place at;
    double stood_s = 0.0;
    /// Where it wants to go on, from near to far, as if nobody else were there; empty when it does not.
    std::vector<Place> way = {};
  };

  /// Somebody makes room at the moment.
  [[nodiscard]] bool is_busy() const;
  /// Nothing is to be decided before a robot has stood for so long beside another.
  static constexpr double stands_s = 4.0;
  static constexpr double before_m = 1.5;
  /// Whoever was to go first and has stood for so long gets nowhere like this.
  static constexpr double stalls_s = 60.0;
  static constexpr double back_off_every_s = 20.0;

  /// For each robot the cell to go to instead of where it wants, nothing for those that may go on.
  [[nodiscard]] std::vector<std::optional<Cell>> decide(KnownMap const& map, RoadMap const& roads,
                                                        std::span<Member const> members, double radius_m,
                                                        double time_s);

 private:
  /// Stays beside until the one that it made room for has passed.
  struct Aside {
    Cell to = {};
    std::size_t leader = 0;
    Place left = {};  ///< where it stood
    double until_s = 0.0;
  };
  struct Scene {
    KnownMap const& map;
    RoadMap const& roads;
    std::span<Member const> members;
    double apart_m = 0.0;
    double time_s = 0.0;
    std::vector<bool> leads = {};  ///< others make room for it
  };
  using Moves = std::vector<std::optional<Aside>>;

  void end_those_passed(Scene const& scene);
  [[nodiscard]] bool lead(Scene scene, std::size_t leader);
  /// Whoever stands near the leader and makes no room yet.
  [[nodiscard]] std::optional<std::size_t> nearest_before(Scene const& scene, std::size_t leader) const;
  /// Sends all away from `way`; false where somebody finds no place.
  [[nodiscard]] static bool clear(Scene& scene, std::vector<Place> const& way, std::size_t leader,
                                  std::vector<Place>& kept_clear, Moves& moves);
  struct Refuge {
    Cell cell = {};
    std::vector<Place> way = {};
  };
  /// Places that are not in `kept_clear`, the nearest first, and the ways there.
  [[nodiscard]] static std::vector<Refuge> refuges(Scene const& scene, std::size_t who,
                                                   std::vector<Place> const& kept_clear,
                                                   std::vector<Disc> const& closed, std::size_t most);
  void back_off(Scene const& scene);
  /// The nearest that is so far away, off the ways of the others of `group` if there is one; or the farthest.
  [[nodiscard]] static std::optional<Refuge> refuge_far_off(Scene const& scene, std::span<std::size_t const> group,
                                                            std::size_t who, double far_m);
  [[nodiscard]] static bool can_pass(Scene const& scene, Place const& from, Place const& to, Place const& standing);

  std::vector<std::optional<Aside>> aside_;
  std::vector<std::uint32_t> led_;  ///< how often each went first
  std::size_t back_offs_ = 0;
  double next_back_off_s_ = 0.0;
};

}  // namespace lapwing::explore
