#include "explore/lead/giving_way.hpp"

#include <algorithm>
#include <array>

namespace lapwing::explore {

namespace {

constexpr double stands_s = 4.0;  ///< then it does not just wait for a moment
constexpr double before_m = 1.5;  ///< nearer than this, one stands before the other
constexpr double lasts_s = 15.0;
constexpr float farthest_m = 15.0F;
constexpr double enough_m = 4.0;  ///< more room than this need not be made

}  // namespace

bool GivingWay::send_aside(KnownMap const& map, RoadMap const& roads, std::span<Member const> members, std::size_t who,
                           double radius_m, double time_s) {
  if (aside_[who]) return false;
  auto const root = roads.node_near(map.cell_at(members[who].at));
  if (!root) return false;
  std::vector<Disc> closed;
  for (std::size_t i = 0; i < members.size(); ++i) {
    if (i != who) closed.push_back({members[i].at, 2.0 * radius_m + 0.2});
  }
  auto const tree = roads.from(*root, farthest_m, closed);
  double best = 0.5;
  for (std::size_t node = 0; node < roads.nodes(); ++node) {
    double const way_m = tree.distance_m[node];
    if (way_m > farthest_m || node == *root) continue;
    auto const place = map.middle(roads.place_of(static_cast<RoadMap::Node>(node)));
    double room_m = enough_m;
    for (auto const& disc : closed) room_m = std::min(room_m, distance_m(disc.middle, place));
    double const worth = room_m - 0.3 * way_m;
    if (worth <= best) continue;
    best = worth;
    aside_[who] = Aside{roads.place_of(static_cast<RoadMap::Node>(node)), time_s + lasts_s};
  }
  return aside_[who].has_value();
}

std::vector<std::optional<Cell>> GivingWay::decide(KnownMap const& map, RoadMap const& roads,
                                                   std::span<Member const> members, double radius_m, double time_s) {
  aside_.resize(members.size());
  for (auto& aside : aside_) {
    if (aside && aside->until_s < time_s) aside.reset();
  }
  for (std::size_t i = 0; i < members.size(); ++i) {
    if (!members[i].wants_on || members[i].stood_s < stands_s || aside_[i]) continue;
    for (std::size_t j = 0; j < members.size(); ++j) {
      if (i == j || aside_[j] || distance_m(members[i].at, members[j].at) > before_m) continue;
      bool const is_j_first = !members[j].wants_on || j > i;
      std::array const in_turn = {is_j_first ? j : i, is_j_first ? i : j};
      if (std::ranges::any_of(in_turn,
                              [&](std::size_t who) { return send_aside(map, roads, members, who, radius_m, time_s); }))
        break;
    }
  }
  std::vector<std::optional<Cell>> cells;
  for (auto const& aside : aside_) cells.push_back(aside ? std::optional(aside->to) : std::nullopt);
  return cells;
}

}  // namespace lapwing::explore
