#pragma once

#include <vector>

#include "slam/loops/loop_search.hpp"

namespace lapwing::slam {

struct LoopCounts {
  int searches = 0;
  int closures = 0;  ///< that hold
  int doubted = 0;   ///< found and not believed
  int revoked = 0;   ///< believed until they were seen to contradict the rest

  LoopCounts& operator+=(LoopCounts const& other) {
    searches += other.searches;
    closures += other.closures;
    doubted += other.doubted;
    revoked += other.revoked;
    return *this;
  }
  LoopCounts& operator-=(LoopCounts const& other) {
    searches -= other.searches;
    closures -= other.closures;
    doubted -= other.doubted;
    revoked -= other.revoked;
    return *this;
  }
  friend bool operator==(LoopCounts const&, LoopCounts const&) = default;
};
[[nodiscard]] LoopCounts counts_of(std::vector<LoopRecord> const& records);

/// Finds places where the robot has been before and closes the graph there. A closure that is found is a claim; how
/// many others must agree with it before it moves anything depends on how much it moves, how far was searched and
/// whether another place looks as good. What a closure does to the rest of the map decides in the end.
class LoopCloser {
 public:
  LoopCloser(LoopOptions const& options, ForEach const& for_each)
      : options_(options), for_each_(for_each), search_(options, for_each) {}

  /// After each new key frame, the graph's last. Returns whether the poses have changed.
  bool follow(Graph& graph);
  /// Takes in a graph that others have made, in place of following it so far.
  void know(Graph const& graph);
  /// After key frames of the graph were let go.
  void renumber(Graph const& graph, Renumbering const& renumbering);
  /// After the last key frame: looks again from every place, as far as places are not joined yet, for now more is
  /// known of where each lies; then optimizes the whole graph to the end. `first`: from that key frame on only.
  void finish(Graph& graph, int first = 0);

  [[nodiscard]] LoopCounts counts() const;
  /// Of the key frames that the graph still has.
  [[nodiscard]] std::vector<LoopRecord> const& records() const { return search_.records(); }

 private:
  /// Closures that stand or fall together.
  using Group = std::vector<Closure>;
  [[nodiscard]] bool is_small(Graph const& graph, Closure const& closure) const;
  [[nodiscard]] Group witnesses_of(Graph const& graph, Closure const& closure) const;
  struct Evidence {
    bool is_enough = false;  ///< to try what it says
    bool is_clear = false;   ///< even without those of its claims that fit elsewhere, too
  };
  [[nodiscard]] Evidence evidence_of(Group const& group) const;
  /// The graph with these loops too.
  void settle_with(Graph& graph, Group const& group) const;
  /// Those of them that the poses bear out.
  [[nodiscard]] Group held_of(Graph const& graph, Group const& group) const;
  /// Tries what moves the graph far; all is as before when the rest of the map contradicts.
  bool close(Graph& graph, Group const& group);
  /// Takes in those that move little, several at once.
  bool close_small(Graph& graph);
  void mark(Group const& group, LoopRecord::Verdict verdict);
  bool look(Graph& graph, int query);
  bool look_everywhere(Graph& graph, int first);
  void drop_open_loops(Graph& graph);
  void note(Graph const& graph, Closure const& closure, int witnesses, LoopRecord::Verdict verdict);

  LoopOptions options_;
  ForEach for_each_;
  LoopSearch search_;
  Group pending_;         ///< found and not believed yet
  Group small_;           ///< that move little and wait for others
  LoopCounts forgotten_;  ///< of key frames that were let go
  double last_search_m_ = 0.0;
};

}  // namespace lapwing::slam
