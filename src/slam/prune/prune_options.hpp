#pragma once

namespace lapwing::slam {

/// When a place has been seen enough from a viewpoint.
struct PruneOptions {
  /// Later passes from there after which a key frame is let go. Of the logs that the mapper was chosen with, those that
  /// pass a place thrice are not touched.
  int passes = 6;
  double near_m = 0.5;     ///< from one viewpoint: no farther from each other,
  double near_rad = 0.35;  ///< and looking no more differently
  int apart_frames = 20;   ///< key frames between two passes at least
  int fresh_frames = 60;   ///< the last ones, which the front end and loops in doubt still need
  int every_frames = 30;   ///< new ones, it is looked for what can be let go
  int most_loops = 6;      ///< of a key frame, once others have been let go beside it
};

}  // namespace lapwing::slam
