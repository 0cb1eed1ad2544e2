#include "explore/known/road_map.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <queue>

namespace lapwing::explore {

namespace {

constexpr double block_m = 0.8;
/// Ways near walls count longer, as drivers go slower there.
constexpr float near_wall_factor = 1.2F;

/// The one nearest to where they are on the mean.
Cell middle_one(std::vector<Cell> const& cells) {
  double sum_x = 0.0;
  double sum_y = 0.0;
  for (auto const cell : cells) {
    sum_x += cell.x;
    sum_y += cell.y;
  }
  double const middle_x = sum_x / static_cast<double>(cells.size());
  double const middle_y = sum_y / static_cast<double>(cells.size());
  return std::ranges::min(cells, {}, [&](Cell cell) { return std::hypot(cell.x - middle_x, cell.y - middle_y); });
}

}  // namespace

RoadMap::RoadMap(KnownMap const& map)
    : cell_m_(map.cell_m()),
      side_(std::clamp(static_cast<int>(std::lround(block_m / map.cell_m())), 4, 32)),
      label_(map.width(), map.height(), 0),
      parts_((map.width() + side_ - 1) / side_, (map.height() + side_ - 1) / side_, 0),
      mark_(parts_.width(), parts_.height(), 0),
      nodes_(parts_.size() * most_parts) {
  for (int y = -1; y <= 1; ++y) {
    for (int x = -1; x <= 1; ++x) {
      for (int part = 1; part <= most_parts; ++part) {
        // Unsigned numbers wrap: what is added for a block before this one takes away.
        auto const away = static_cast<Node>(y * parts_.width() + x);
        to_joint_[joint_to({x, y}, part)] = static_cast<Node>(part - 1) * static_cast<Node>(parts_.size()) + away;
      }
    }
  }
}

void RoadMap::update(KnownMap const& map, std::vector<std::uint32_t> const& changed) {
  if (changed.empty()) return;
  ++version_;
  std::vector<Cell> divided;
  for (auto const index : changed) {
    auto const block = block_of(map.cell_of(index));
    if (mark_[block] == 1) continue;
    mark_[block] = 1;
    divided.push_back(block);
  }
  for (auto const block : divided) divide(map, block);
  auto joined = divided;
  for (auto const block : divided) {
    for (auto const away : neighbours) {
      auto const beside = block + away;
      if (!mark_.contains(beside) || mark_[beside] != 0) continue;
      mark_[beside] = 2;
      joined.push_back(beside);
    }
  }
  for (auto const block : joined) {
    join(map, block);
    mark_[block] = 0;
  }
}

void RoadMap::divide(KnownMap const& map, Cell block) {
  Cell const least{block.x * side_, block.y * side_};
  Cell const most{std::min(least.x + side_, map.width()), std::min(least.y + side_, map.height())};
  for (int y = least.y; y < most.y; ++y) {
    for (int x = least.x; x < most.x; ++x) label_[{x, y}] = 0;
  }
  std::uint8_t parts = 0;
  std::vector<Cell> cells;
  for (int y = least.y; y < most.y && parts < most_parts; ++y) {
    for (int x = least.x; x < most.x && parts < most_parts; ++x) {
      if (label_[{x, y}] != 0 || !map.is_standable({x, y})) continue;
      ++parts;
      cells.assign(1, {x, y});
      fill(map, block, parts, cells);
      nodes_[node_of(block, parts)].place = middle_one(cells);
    }
  }
  parts_[block] = parts;
  most_used_ = std::max(most_used_, parts);
}

void RoadMap::fill(KnownMap const& map, Cell block, std::uint8_t part, std::vector<Cell>& cells) {
  label_[cells.front()] = part;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    auto const cell = cells[i];
    for (auto const away : neighbours) {
      auto const next = cell + away;
      if (!label_.contains(next) || block_of(next) != block || label_[next] != 0 || !map.is_standable(next)) continue;
      label_[next] = part;
      cells.push_back(next);
    }
  }
}

void RoadMap::join(KnownMap const& map, Cell block) {
  Cell const least{block.x * side_, block.y * side_};
  Cell const most{std::min(least.x + side_, map.width()), std::min(least.y + side_, map.height())};
  for (int part = 1; part <= parts_[block]; ++part) {
    auto& node = nodes_[node_of(block, part)];
    node.joined = 0;
    node.is_near_wall = map.is_near_wall(node.place);
  }
  for (int y = least.y; y < most.y; ++y) {
    for (int x = least.x; x < most.x; ++x) {
      bool const is_border = x == least.x || y == least.y || x == most.x - 1 || y == most.y - 1;
      if (!is_border || label_[{x, y}] == 0) continue;
      auto& node = nodes_[node_of(block, label_[{x, y}])];
      for (auto const away : neighbours) {
        auto const next = Cell{x, y} + away;
        if (label_.or_else(next, 0) == 0 || block_of(next) == block) continue;
        node.joined |= std::uint64_t{1} << joint_to(block_of(next) - block, label_[next]);
      }
    }
  }
}

std::optional<RoadMap::Node> RoadMap::node_at(Cell cell) const {
  if (!label_.contains(cell) || label_[cell] == 0) return {};
  return node_of(block_of(cell), label_[cell]);
}

std::optional<RoadMap::Node> RoadMap::node_near(Cell cell) const {
  if (auto const node = node_at(cell)) return node;
  int const reach = static_cast<int>(0.5 / cell_m_);
  std::optional<Node> best;
  double least = reach + 0.5;
  for (int y = -reach; y <= reach; ++y) {
    for (int x = -reach; x <= reach; ++x) {
      double const far = std::hypot(x, y);
      if (far >= least) continue;
      auto const node = node_at(cell + Cell{x, y});
      if (!node) continue;
      best = node;
      least = far;
    }
  }
  return best;
}

RoadMap::Tree RoadMap::from(Node root, float most_m, std::vector<Disc> const& closed) const {
  return grow(root, most_m, {}, closed);
}

std::vector<RoadMap::Node> RoadMap::way(Node root, Node goal, std::vector<Disc> const& closed) const {
  auto const tree = grow(root, unreachable, goal, closed);
  if (!tree.reaches(goal)) return {};
  std::vector<Node> way = {goal};
  while (way.back() != root) way.push_back(tree.before[way.back()]);
  std::ranges::reverse(way);
  return way;
}

float RoadMap::between_m(NodeData const& a, NodeData const& b) const {
  auto const length_m = static_cast<float>(length_of(b.place - a.place) * cell_m_);
  return a.is_near_wall || b.is_near_wall ? length_m * near_wall_factor : length_m;
}

RoadMap::Tree RoadMap::grow(Node root, float most_m, std::optional<Node> goal, std::vector<Disc> const& closed) const {
  Tree tree;
  tree.distance_m.assign(nodes(), unreachable);
  tree.before.assign(nodes(), root);
  auto const is_closed = [&](Node node) {
    auto const place = middle_of(nodes_[node].place, cell_m_);
    return std::ranges::any_of(closed,
                               [&](Disc const& disc) { return distance_m(disc.middle, place) < disc.radius_m; });
  };
  using Open = std::pair<float, Node>;
  std::priority_queue<Open, std::vector<Open>, std::greater<>> open;
  tree.distance_m[root] = 0.0F;
  open.push({0.0F, root});
  while (!open.empty()) {
    auto const [so_far, node] = open.top();
    open.pop();
    if (so_far > tree.distance_m[node]) continue;
    if (node == goal) break;
    auto const& here = nodes_[node];
    auto const block = node % static_cast<Node>(parts_.size());
    for (auto joined = here.joined; joined != 0; joined &= joined - 1) {
      auto const to = block + to_joint_[static_cast<std::size_t>(std::countr_zero(joined))];
      if (so_far >= tree.distance_m[to]) continue;
      float const length = so_far + between_m(here, nodes_[to]);
      if (length >= tree.distance_m[to] || length > most_m) continue;
      if (!closed.empty() && is_closed(to)) continue;
      tree.distance_m[to] = length;
      tree.before[to] = node;
      open.push({length, to});
    }
  }
  return tree;
}

}  // namespace lapwing::explore
