#pragma once

#include <string_view>
#include <vector>

#include "slam/loops/closure.hpp"
#include "slam/parallel.hpp"
#include "slam/prune/let_go.hpp"

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
  double deviations = 0.0;  ///< of x, y and yaw together
  int witnesses = 0;
  double contradiction = 0.0;      ///< of the map that it would have made
  double was_contradiction = 0.0;  ///< of the same passes before
  bool is_late = false;            ///< looked for after the last scan
  Verdict verdict = Verdict::not_found;
};
[[nodiscard]] std::string_view to_string(LoopRecord::Verdict verdict);

/// Looks for what is around a key frame in what was mapped long before.
class LoopSearch {
 public:
  LoopSearch(LoopOptions const& options, ForEach for_each) : options_(options), for_each_(std::move(for_each)) {}

  /// After each new key frame, the graph's last: makes a submap of the last ones when there are enough.
  void follow(Graph const& graph);
  /// All submaps of a graph of one or several drives; none across a gap between two of them. What is left over at the
  /// end becomes one when the graph grows.
  void know(Graph const& graph);

  /// After key frames of the graph were let go: submaps of what is left, and no record of what is gone. Returns the
  /// records' new numbers, or Renumbering::gone.
  [[nodiscard]] std::vector<int> renumber(Graph const& graph, Renumbering const& renumbering);

  struct Scope {
    double window_sigmas = LoopOptions().window_sigmas;
    double most_deviations =
        LoopOptions().most_deviations;  ///< that a closure may be away from what the drift lets expect
    int most_places = 4;
    bool counts_unseen = false;  ///< looks as far as odometry may have erred where no scan saw a turn
    bool skips_joined = false;   ///< leaves out pairs of places between which there is a loop already
  };
  /// At most one a place. None of them is believed yet.
  [[nodiscard]] std::vector<Closure> look(Graph const& graph, int query, Scope const& scope);

  [[nodiscard]] int searches() const { return static_cast<int>(records_.size()); }
  /// Everything that was looked for, in that order.
  [[nodiscard]] std::vector<LoopRecord> const& records() const { return records_; }
  [[nodiscard]] LoopRecord& record_of(Closure const& closure) { return records_[closure.record]; }

 private:
  /// A submap of what is left over, before the drive that key frame `next` begins.
  void end_drive(Graph const& graph, int next);
  [[nodiscard]] std::optional<Submap> left_of(Submap submap, Graph const& graph, Renumbering const& renumbering) const;
  struct Candidate {
    int submap;
    LoopWindow window;
    Eigen::Matrix3d covariance;
  };
  [[nodiscard]] std::vector<Candidate> candidates(Graph const& graph, int query, Scope const& scope) const;

  LoopOptions options_;
  ForEach for_each_;
  std::vector<Submap> submaps_;
  int next_first_ = 0;  ///< key frame of the submap that is to come
  std::vector<LoopRecord> records_;
};

}  // namespace lapwing::slam
