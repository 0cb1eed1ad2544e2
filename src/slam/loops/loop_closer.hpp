#pragma once

#include <string_view>
#include <vector>

#include "slam/loops/closure.hpp"
#include "slam/parallel.hpp"

namespace lapwing::slam {

/// What became of looking for one place in another.
struct LoopRecord {
  enum class Verdict { not_found, mismatched, doubted, revoked, closed };
  int query = 0;
  int target = 0;
  LoopWindow window;
  double score = 0.0;
  double rival = 0.0;
  double conflict = 0.0;
  int matches = 0;
  double shift_m = 0.0;  ///< that it would move the query by
  double turn_rad = 0.0;
  int witnesses = 0;
  Verdict verdict = Verdict::not_found;
};
[[nodiscard]] std::string_view to_string(LoopRecord::Verdict verdict);

/// Finds places where the robot has been before and closes the graph there. A closure that is found is a claim; how
/// many others must agree with it before it moves anything depends on how much it moves, how far was searched and
/// whether another place looks as good.
class LoopCloser {
 public:
  LoopCloser(LoopOptions const& options, ForEach for_each) : options_(options), for_each_(std::move(for_each)) {}

  /// After each new key frame, the graph's last. Returns whether the poses have changed.
  bool follow(Graph& graph);
  /// Optimizes the whole graph once more, to the end. It looks for no further loops.
  void finish(Graph& graph);

  struct Counts {
    int searches = 0;
    int closures = 0;  ///< that hold
    int doubted = 0;   ///< found and not believed
    int revoked = 0;   ///< believed until they were seen to contradict the rest
  };
  [[nodiscard]] Counts const& counts() const { return counts_; }
  /// Everything that was looked for, in that order.
  [[nodiscard]] std::vector<LoopRecord> const& records() const { return records_; }

 private:
  struct Candidate {
    int submap;
    LoopWindow window;
  };
  [[nodiscard]] std::vector<Candidate> candidates(Graph const& graph, int query) const;
  [[nodiscard]] std::vector<Closure> search(Graph const& graph, int query);
  [[nodiscard]] std::vector<Closure> witnesses_of(Graph const& graph, Closure const& closure) const;
  [[nodiscard]] bool is_believed(Graph const& graph, Closure const& closure, std::size_t witnesses) const;
  bool close(Graph& graph, std::vector<Closure> const& closures);
  bool look(Graph& graph, int query);

  LoopOptions options_;
  ForEach for_each_;
  std::vector<Submap> submaps_;
  std::vector<Closure> pending_;
  double last_search_m_ = 0.0;
  Counts counts_;
  std::vector<LoopRecord> records_;
};

}  // namespace lapwing::slam
