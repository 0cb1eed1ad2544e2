#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "slam/graph.hpp"
#include "slam/graph/block_system.hpp"
#include "slam/match/point_to_line.hpp"
#include "slam/match/wall_compass.hpp"
#include "slam/parallel.hpp"

namespace lapwing::slam {

/// How far off a step from key frame to key frame may be, as standard deviations: so much, and more by its length and
/// its turn.
struct StepSpread {
  double shift_m = 0.05;
  double shift_per_m = 0.0;
  double turn_rad = 0.02;
  double turn_per_m = 0.0;
  double turn_per_rad = 0.0;
};

struct JointOptions {
  int rounds = 5;
  int neighbours = 8;     ///< key frames that each is aligned with, beside those just before it
  double radius_m = 4.0;  ///< around it
  /// What they are apart from each other at least, a radian counting 0.7 m. Where a place was passed often the nearest
  /// are copies of each other, and what is a little wrong adds up from each to the next.
  double apart_m = 0.0;
  double first_gate_m = 0.3;  ///< narrowed from round to round
  double last_gate_m = 0.12;
  double first_scale_m = 0.10;
  double last_scale_m = 0.03;
  int first_stride = 2;              ///< every n-th point in all rounds but the last two
  int in_time = 4;                   ///< key frames that overlap as one was taken shortly after the other
  StepSpread steps = {};             ///< as the pose graph has them
  double point_information = 250.0;  ///< 1 / m^2; a tenth of what a 2 cm laser has, as beams err together
};

/// Aligns all key frames that overlap with each other at once, point to line, from poses whose loops are closed: what a
/// pose graph forgets, that walls are straight lines through many scans, is what the last centimetres come from. Piece
/// by piece, for who has other things to do meanwhile: however the work is cut, the result is the same.
class JointAlignment {
 public:
  /// `headings`: what is known of some key frames beside what they see of each other.
  JointAlignment(Graph graph, JointOptions const& options, std::vector<HeldHeading> headings = {});

  [[nodiscard]] bool is_done() const { return round_ == options_.rounds; }
  /// Lays at most so many pairs of key frames on each other, some ten microseconds each, and moves all key frames when
  /// those were the last of a round. Precondition: not done.
  void go_on(std::size_t most_pairs, ForEach const& for_each);

  [[nodiscard]] Graph const& graph() const { return graph_; }
  [[nodiscard]] Graph take() && { return std::move(graph_); }

 private:
  struct Pair {
    int source;
    int target;
  };
  [[nodiscard]] static std::vector<Pair> overlapping(Graph const& graph, JointOptions const& options);
  [[nodiscard]] static BlockSystem system_for(Graph const& graph, std::vector<Pair> const& pairs);
  [[nodiscard]] Association association() const;
  void hold_steps();
  void hold_headings();
  void move_all();

  JointOptions options_;
  Graph graph_;
  std::vector<Pose2> before_;
  std::vector<HeldHeading> headings_;
  std::vector<Pair> pairs_;
  std::vector<PairTerm> terms_;  ///< of this round's pairs
  BlockSystem system_;
  int round_ = 0;
  std::size_t next_ = 0;  ///< of the pairs, in this round
};

/// All of it at once.
void refine_jointly(Graph& graph, JointOptions const& options, ForEach const& for_each);

}  // namespace lapwing::slam
