#pragma once

#include "slam/loops/spread.hpp"

namespace lapwing::slam {

struct LoopOptions {
  double every_m = 1.0;       ///< a search after so many metres
  double least_gap_m = 20.0;  ///< driven between two places; nearer ones the front end has joined already
  int submap_frames = 15;     ///< so many key frames are looked for others in
  int query_frames = 9;       ///< so many are looked for together
  double least_score = 0.5;
  double window_m = 0.6;  ///< least search window; beyond, `window_sigmas` of the drift
  double window_rad = 0.08;
  double window_sigmas = 2.5;
  /// Standard deviations of x, y and yaw together; a window, by each alone, holds much that is farther off than that.
  double most_deviations = 4.5;
  double most_window_m = 40.0;
  int most_branches = 20'000;  ///< of one search: `LoopWindow`
  double most_window_rad = 0.6;
  int most_candidates = 4;        ///< places looked at in one search
  int least_matches = 120;        ///< points of the query on the target's lines
  double most_conflict = 0.2;     ///< of the points that were in sight, the share in free space
  double ambiguous_rival = 0.85;  ///< another place with that share of the score makes a closure doubtful
  double small_shift_m = 0.35;    ///< corrections up to here need few witnesses
  double small_turn_rad = 0.05;
  int small_batch = 5;  ///< so many of these are taken in at once
  int witnesses = 2;    ///< other closures that must agree with a large correction
  /// Of the points of other passes that a closure brings into sight, the share in free space.
  double most_contradiction = 0.25;
  double most_contradiction_in_doubt = 0.12;  ///< where most claims fit elsewhere, too
  double late_sigmas = 4.0;                   ///< of the drift, when everything is looked for again after the last scan
  double late_deviations = 5.0;
  int late_rounds = 3;
  int least_points = 60;  ///< of the query; with fewer nothing is looked for
  int near_submaps = 3;   ///< of submaps nearer to each other in time only one is looked at
  int step_frames = 3;    ///< of a place's key frames every so manieth is aligned
  double point_information = 5.0;
  double tolerance = 20.0;  ///< of the robust optimiser
  DriftRates rates;
};

}  // namespace lapwing::slam
