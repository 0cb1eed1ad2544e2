#pragma once

#include <array>
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
  /// All nodes are numbers below this, and so long are trees.
  [[nodiscard]] std::size_t nodes() const { return most_used_ * parts_.size(); }
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
  /// The parts of a block and of those around it: so many a node may be joined to.
  static constexpr std::size_t joints = 9 * most_parts;
  static_assert(joints <= 64);
  struct NodeData {
    Cell place = {};
    std::uint64_t joined = 0;  ///< to which of its joints, a bit each
    bool is_near_wall = false;
  };

  [[nodiscard]] Cell block_of(Cell cell) const { return {cell.x / side_, cell.y / side_}; }
  [[nodiscard]] Tree grow(Node root, float most_m, std::optional<Node> goal, std::vector<Disc> const& closed) const;
  void divide(KnownMap const& map, Cell block);
  /// All cells of the block that hang together with the one in `cells`; they are added to it.
  void fill(KnownMap const& map, Cell block, std::uint8_t part, std::vector<Cell>& cells);
  void join(KnownMap const& map, Cell block);
  [[nodiscard]] float between_m(NodeData const& a, NodeData const& b) const;
  /// The number of the joint to a part of the block that lies `away`, at most one to each side.
  [[nodiscard]] static std::size_t joint_to(Cell away, int part) {
    return static_cast<std::size_t>(((away.y + 1) * 3 + away.x + 1) * most_parts + part - 1);
  }
  /// The first parts of all blocks lie side by side in memory, as few blocks have others.
  [[nodiscard]] Node node_of(Cell block, int part) const {
    return static_cast<Node>(static_cast<std::size_t>(part - 1) * parts_.size() + parts_.index_of(block));
  }

  double cell_m_;
  int side_;
  DenseGrid<std::uint8_t> label_;  ///< of cells: part of the block from 1, 0 for none
  DenseGrid<std::uint8_t> parts_;  ///< of blocks: how many
  std::uint8_t most_used_ = 1;     ///< parts of any block
  DenseGrid<std::uint8_t> mark_;   ///< of blocks: 1 changed, 2 beside such a one
  std::vector<NodeData> nodes_;
  std::array<Node, joints> to_joint_ = {};  ///< from the first part of a block, by the number of the joint
  std::uint64_t version_ = 0;
};

}  // namespace lapwing::explore
