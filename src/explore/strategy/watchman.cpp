#include "explore/strategy/watchman.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <unordered_map>

#include "explore/floor/ray.hpp"
#include "explore/strategy/open_tour.hpp"

namespace lapwing::explore {

namespace {

using Node = RoadMap::Node;

/// What is wanted, in squares, and which of them each node of the road map sees.
class Views {
 public:
  Views(KnownMap const& map, RoadMap const& roads, DenseGrid<std::uint8_t> const& is_wanted, RoadMap::Tree const& reach,
        WatchmanSettings const& settings)
      : side_(std::max(1, static_cast<int>(std::lround(settings.target_m / map.cell_m())))),
        square_((map.width() + side_ - 1) / side_, (map.height() + side_ - 1) / side_, 0),
        seen_(roads.nodes()) {
    weight_.push_back(0.0);
    for (std::size_t i = 0; i < is_wanted.size(); ++i) {
      if (is_wanted.at_index(i) == 0) continue;
      auto const cell = map.cell_of(i);
      auto& square = square_[{cell.x / side_, cell.y / side_}];
      if (square == 0) {
        square = static_cast<std::uint32_t>(weight_.size());
        weight_.push_back(0.0);
      }
      weight_[square] += 1.0;
    }
    double const range = settings.range_m / map.cell_m();
    auto const ways = beam_ways(0.0, 240);
    std::vector<std::uint32_t> marked(weight_.size(), 0);
    for (std::size_t i = 0; i < roads.nodes(); ++i) {
      auto const node = static_cast<Node>(i);
      if (!reach.reaches(node)) continue;
      nodes_.push_back(node);
      auto const place = roads.place_of(node);
      for (auto const& way : ways) {
        walk_line(place.x + 0.5, place.y + 0.5, way.x(), way.y(), range, [&](Cell cell, double) {
          if (map.at(cell) != Knowledge::free) return false;
          auto const square = square_[{cell.x / side_, cell.y / side_}];
          if (square != 0 && marked[square] != i + 1) {
            marked[square] = static_cast<std::uint32_t>(i + 1);
            seen_[i].push_back(square);
          }
          return true;
        });
      }
    }
  }

  [[nodiscard]] std::vector<Node> const& nodes() const { return nodes_; }
  [[nodiscard]] std::vector<std::uint32_t> const& seen(Node node) const { return seen_[node]; }
  [[nodiscard]] double weight(std::uint32_t square) const { return weight_[square]; }
  [[nodiscard]] std::size_t squares() const { return weight_.size(); }

 private:
  int side_;
  DenseGrid<std::uint32_t> square_;  ///< from 1
  std::vector<double> weight_;
  std::vector<Node> nodes_;
  std::vector<std::vector<std::uint32_t>> seen_;
};

/// How often each square is seen from a set of nodes.
class Cover {
 public:
  explicit Cover(Views const& views) : views_(&views), times_(views.squares(), 0) {}

  void add(Node node) {
    for (auto const square : views_->seen(node)) {
      if (times_[square]++ == 0) sum_ += views_->weight(square);
    }
  }
  void remove(Node node) {
    for (auto const square : views_->seen(node)) {
      if (--times_[square] == 0) sum_ -= views_->weight(square);
    }
  }
  [[nodiscard]] double gain(Node node) const {
    double gain = 0.0;
    for (auto const square : views_->seen(node)) gain += times_[square] == 0 ? views_->weight(square) : 0.0;
    return gain;
  }
  [[nodiscard]] double sum() const { return sum_; }

 private:
  Views const* views_;
  std::vector<std::uint32_t> times_;
  double sum_ = 0.0;
};

class Planner {
 public:
  Planner(KnownMap const& map, RoadMap const& roads, Views const& views, Node start, double enough)
      : map_(map), roads_(roads), views_(views), start_(start), enough_(enough), cover_(views) {}

  void choose() {
    Cover chosen(views_);
    chosen.add(start_);
    std::vector<double> most(roads_.nodes(), std::numeric_limits<double>::infinity());
    while (chosen.sum() < enough_) {
      // Gains only shrink: who was worse before than the best is now need not be looked at.
      double best = 0.0;
      Node next = start_;
      for (auto const node : views_.nodes()) {
        if (most[node] <= best) continue;
        most[node] = chosen.gain(node);
        if (most[node] <= best) continue;
        best = most[node];
        next = node;
      }
      if (best <= 0.0) break;
      chosen.add(next);
      places_.push_back(next);
    }
  }

  void order() {
    TourCosts costs;
    for (auto const a : places_) {
      costs.from_start.push_back(distance(start_, a));
      costs.between.emplace_back();
      for (auto const b : places_) costs.between.back().push_back(distance(a, b));
    }
    costs.end.assign(places_.size(), 0.0);
    std::vector<std::size_t> all(places_.size());
    std::iota(all.begin(), all.end(), std::size_t{0});
    std::vector<Node> ordered;
    for (auto const i : good_tour(costs, all)) ordered.push_back(places_[i]);
    places_ = std::move(ordered);
    cover_ = Cover(views_);
    for (std::size_t i = 0; i < places_.size(); ++i) see(before(i), places_[i], true);
    cover_.add(start_);
  }

  /// Leaves out or moves places while what is seen on the way suffices. False when nothing changed.
  bool shorten() {
    bool has_changed = false;
    for (std::size_t i = 0; i < places_.size();) {
      auto const here = places_[i];
      auto const a = before(i);
      bool const is_last = i + 1 == places_.size();
      auto const b = is_last ? here : places_[i + 1];
      double const now_m = distance(a, here) + (is_last ? 0.0 : distance(here, b));
      see(a, here, false);
      if (!is_last) see(here, b, false);
      if (!is_last) see(a, b, true);
      if (cover_.sum() >= enough_) {
        places_.erase(places_.begin() + static_cast<std::ptrdiff_t>(i));
        has_changed = true;
        continue;
      }
      if (!is_last) see(a, b, false);
      auto const best = nearer_place(here, a, is_last ? std::nullopt : std::optional(b), now_m - 0.05);
      has_changed = has_changed || best != here;
      places_[i] = best;
      see(a, best, true);
      if (!is_last) see(best, b, true);
      ++i;
    }
    return has_changed;
  }

  [[nodiscard]] std::vector<Node> way() {
    std::vector<Node> way = {start_};
    for (std::size_t i = 0; i < places_.size(); ++i) {
      auto leg = nodes_between(before(i), places_[i]);
      way.insert(way.end(), leg.begin() + 1, leg.end());
    }
    return way;
  }
  [[nodiscard]] double seen() const { return cover_.sum(); }

 private:
  /// The place near `here` whose way from `a`, and on to `b` if there is one, is the shortest below `least_m` and shows
  /// enough; `here` if there is none.
  Node nearer_place(Node here, Node a, std::optional<Node> b, double least_m) {
    auto best = here;
    for (auto const node : views_.nodes()) {
      constexpr double moved_m = 2.5;
      if (length_of(roads_.place_of(node) - roads_.place_of(here)) * map_.cell_m() > moved_m) continue;
      double const with_m = tree(a).distance_m[node] + (b ? tree(*b).distance_m[node] : 0.0F);
      if (with_m >= least_m) continue;
      see_from(a, node, true);
      if (b) see_from(*b, node, true);
      if (cover_.sum() >= enough_) {
        best = node;
        least_m = with_m;
      }
      see_from(a, node, false);
      if (b) see_from(*b, node, false);
    }
    return best;
  }

  [[nodiscard]] Node before(std::size_t i) const { return i == 0 ? start_ : places_[i - 1]; }

  RoadMap::Tree const& tree(Node node) {
    auto const found = trees_.find(node);
    return found != trees_.end() ? found->second : trees_.emplace(node, roads_.from(node)).first->second;
  }
  double distance(Node a, Node b) { return static_cast<double>(tree(a).distance_m[b]); }

  /// From `a` on, both included.
  std::vector<Node> nodes_between(Node a, Node b) {
    auto const& from = tree(a);
    std::vector<Node> nodes = {b};
    while (nodes.back() != a) nodes.push_back(from.before[nodes.back()]);
    std::ranges::reverse(nodes);
    return nodes;
  }
  void see_from(Node root, Node node, bool is_added) {
    for (auto const passed : nodes_between(root, node)) is_added ? cover_.add(passed) : cover_.remove(passed);
  }
  void see(Node a, Node b, bool is_added) { see_from(a, b, is_added); }

  KnownMap const& map_;
  RoadMap const& roads_;
  Views const& views_;
  Node start_;
  double enough_;
  Cover cover_;
  std::vector<Node> places_;
  std::unordered_map<Node, RoadMap::Tree> trees_;
};

}  // namespace

WatchmanRoute watchman_route(KnownMap const& map, RoadMap const& roads, DenseGrid<std::uint8_t> const& is_wanted,
                             RoadMap::Node start, WatchmanSettings const& settings) {
  Views const views(map, roads, is_wanted, roads.from(start), settings);
  Cover all(views);
  for (auto const node : views.nodes()) all.add(node);
  Planner planner(map, roads, views, start, settings.enough * all.sum());
  planner.choose();
  planner.order();
  for (int round = 0; round < settings.rounds && planner.shorten(); ++round) planner.order();
  WatchmanRoute route{planner.way(), 0.0, all.sum() > 0.0 ? planner.seen() / all.sum() : 1.0};
  for (std::size_t i = 1; i < route.nodes.size(); ++i)
    route.length_m += length_of(roads.place_of(route.nodes[i]) - roads.place_of(route.nodes[i - 1])) * map.cell_m();
  return route;
}

}  // namespace lapwing::explore
