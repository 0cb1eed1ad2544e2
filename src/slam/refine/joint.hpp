#pragma once

#include "slam/graph.hpp"
#include "slam/parallel.hpp"

namespace lapwing::slam {

struct JointOptions {
  int rounds = 5;
  int neighbours = 8;         ///< key frames that each is aligned with, beside those just before it
  double radius_m = 4.0;      ///< around it
  double first_gate_m = 0.3;  ///< narrowed from round to round
  double last_gate_m = 0.12;
  double first_scale_m = 0.10;
  double last_scale_m = 0.03;
  int first_stride = 2;              ///< every n-th point in all rounds but the last two
  int in_time = 4;                   ///< key frames that overlap as one was taken shortly after the other
  double step_trust = 1.0;           ///< times 5 cm and 1.1 degrees, in the steps that the pose graph made
  double point_information = 250.0;  ///< 1 / m^2; a tenth of what a 2 cm laser has, as beams err together
};

/// Aligns all key frames that overlap with each other at once, point to line, from poses whose loops are closed: what a
/// pose graph forgets, that walls are straight lines through many scans, is what the last centimetres come from.
void refine_jointly(Graph& graph, JointOptions const& options, ForEach const& for_each);

}  // namespace lapwing::slam
