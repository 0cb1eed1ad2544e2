#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "explore/floor/dense_grid.hpp"
#include "explore/known/known_map.hpp"

namespace lapwing::explore {

/// The standable cells of a map as a graph small enough to be asked often: square blocks, each divided into the parts
/// of it that hang together; a node is a part, an edge joins parts of blocks that touch. Distances are those between
/// the nodes' places, a few percent long. Kept up block by block as the map changes.
class RoadMap {
 public:
  using Node = std::uint32_t;
  static constexpr float unreachable = std::numeric_limits<float>::infinity();

  explicit RoadMap(KnownMap const& map);

  /// `changed`: as `KnownMap::take_changes` gives it.
  void update(KnownMap const& map, std::vector<std::uint32_t> const& changed);

  /// Nothing where nobody can stand.
  [[nodiscard]] std::optional<Node> node_at(Cell cell) const;
  /// A standable cell in the middle of it.
  [[nodiscard]] Cell place_of(Node node) const { return nodes_[node].place; }
  [[nodiscard]] std::size_t nodes() const { return nodes_.size(); }
  /// Grows with every change.
  [[nodiscard]] std::uint64_t version() const { return version_; }

  struct Tree {
    std::vector<float> distance_m;  ///< a node
    std::vector<Node> before;       ///< on the way from the root; the root's is itself
    [[nodiscard]] bool reaches(Node node) const { return distance_m[node] != unreachable; }
  };
  /// Shortest ways from `root` (Dijkstra 1959) to all within `most_m`, not through nodes whose places are in `closed`.
  [[nodiscard]] Tree from(Node root, float most_m = unreachable, std::vector<Disc> const& closed = {}) const;
  /// The shortest way between two, both included, not through nodes whose places are in `closed`; empty: there is none.
  [[nodiscard]] std::vector<Node> way(Node root, Node goal, std::vector<Disc> const& closed) const;
  /// The node of the standable cell nearest to `cell`, within half a metre.
  [[nodiscard]] std::optional<Node> node_near(Cell cell) const;

 private:
  static constexpr int most_parts = 6;
  struct Edge {
    Node to = 0;
    float length_m = 0.0F;
  };
  struct NodeData {
    Cell place = {};
    std::vector<Edge> edges = {};
  };

  [[nodiscard]] Cell block_of(Cell cell) const { return {cell.x / side_, cell.y / side_}; }
  [[nodiscard]] Tree grow(Node root, float most_m, std::optional<Node> goal, std::vector<Disc> const& closed) const;
  void divide(KnownMap const& map, Cell block);
  /// All cells of the block that hang together with the one in `cells`; they are added to it.
  void fill(KnownMap const& map, Cell block, std::uint8_t part, std::vector<Cell>& cells);
  void join(KnownMap const& map, Cell block);
  /// An edge between the parts of two cells that touch.
  void join_cells(KnownMap const& map, Cell cell, Cell next);
  [[nodiscard]] Node first_node(Cell block) const { return static_cast<Node>(parts_.index_of(block) * most_parts); }

  double cell_m_;
  int side_;
  DenseGrid<std::uint8_t> label_;  ///< of cells: part of the block from 1, 0 for none
  DenseGrid<std::uint8_t> parts_;  ///< of blocks: how many
  DenseGrid<std::uint8_t> mark_;   ///< of blocks: 1 changed, 2 beside such a one
  std::vector<NodeData> nodes_;
  std::uint64_t version_ = 0;
};

}  // namespace lapwing::explore
